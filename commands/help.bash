navvi_help() {
  if [[ -z ${1:-} ]]; then help_text help; return; fi
  [[ $1 =~ ^[a-z]+$ && -f $commands/$1.txt ]] || fail "\"$1\" is no sub-command; \"./navvi help\" lists them." 2
  help_text "$1"
}
