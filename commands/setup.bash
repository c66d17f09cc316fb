navvi_setup() {
  (($# == 0)) || fail "\"$1\" is no argument; setup takes none." 2
  install_packages all
  say "everything that NavVI needs of Debian is installed. \"./navvi run\" builds it and starts a session."
}
