navvi_replay() {
  local trial status=0 log
  trial_folder "$@"
  shift
  read_args "$launch_files/replay.launch" "$@"
  arg[speech]=${arg[speech]:-true} allowed[speech]="true false"
  one_of speech
  number rate
  number skip
  resolve_rviz
  resolve_view
  build_workspace
  loopback_network
  "$(program navvi_study summary_from_bag)" "$trial" || status=$?
  ((status <= 1)) || fail "this trial cannot be replayed; see above. rosbag reindex may mend a bag that was cut off."
  log=$trial/replay.log
  [[ -w $trial ]] || log=/dev/null
  say "replaying $trial; Ctrl-C stops it."
  arg[bag]=$trial/trial.bag
  launch "$launch_files/replay.launch" "$log" || [[ -n $interrupted ]] || fail "the replay broke off; the log $log says why."
  ((status == 0)) || fail "the bag and the summary of this trial do not agree, as said at the start."
  say "the replay has ended."
}
