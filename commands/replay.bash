navvi_replay() {
  local trial status=0 log
  trial_folder "$@"
  shift
  read_args "$launch_files/replay.launch" "$@"
  arg[speech]=${arg[speech]:-true} allowed[speech]="true false"
  one_of speech
  number rate
  number skip
  arg[speaker]=${arg[speaker]:-$(speaker_of "$trial/journal.csv")}
  arg[mesh]=${arg[mesh]:-$(mesh_of "$trial/journal.csv")}
  resolve_rviz
  resolve_view
  build_session scene_player summary_from_bag cue_player
  loopback_network
  "$(program navvi_study summary_from_bag)" "$trial" || status=$?
  ((status <= 1)) || fail "this trial cannot be replayed; see above. rosbag reindex may mend a bag that was cut off."
  log=$trial/replay.log
  [[ -w $trial ]] || log=/dev/null
  say "replaying $trial; Ctrl-C stops it. For ROS tools, in a second terminal: $(second_terminal)"
  arg[bag]=$trial/trial.bag
  launch "$launch_files/replay.launch" "$log" || [[ -n $interrupted ]] || fail "the replay broke off; the log $log says why."
  ((status == 0)) || fail "the bag and the summary of this trial do not agree, as said at the start."
  say "the replay has ended."
}

# The voice of a record (%3d is its "="), as cue_player's parameters; what older records do not tell is left to it.
speaker_of() {  # JOURNAL
  local start name voice=""
  start=$(grep -m 1 ',TRIAL_START,' "$1") || true
  [[ ! $start =~ \;voice=([A-Za-z0-9/_+-]+) || ${BASH_REMATCH[1]} == unknown ]] || voice="voice: '${BASH_REMATCH[1]}'"
  for name in rate pitch volume; do
    [[ ! $start =~ feedback/speaker/$name%3d([0-9.]+) ]] || voice+=${voice:+, }"$name: ${BASH_REMATCH[1]}"
  done
  echo "{$voice}"
}

# The parameters of a record's mesh, as nav_node's.
mesh_of() {  # JOURNAL
  echo "{$(grep -m 1 ',TRIAL_START,' "$1" | grep -o 'nav/mesh/[a-z_]*%3d[^ ;]*' | sed 's,nav/mesh/,,; s/%3d/: /' | paste -sd,)}"
}
