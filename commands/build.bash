navvi_build() {
  local option=${1:-}
  [[ -z $option || $option == --asan || $option == --odr ]] ||
    fail "\"$option\" is no option of build; --asan and --odr are allowed." 2
  (($# < 2)) || fail "\"$2\" is too much; build takes one option." 2
  build_workspace "$@"
  say "the build is done. \"./navvi run\" starts a session."
}
