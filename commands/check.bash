navvi_check() {
  local trial
  trial_folder "$@"
  (($# == 1)) || fail "\"$2\" is too much; check takes one trial's folder." 2
  build_workspace check_trial
  "$(program navvi_study check_trial)" "$trial"
}
