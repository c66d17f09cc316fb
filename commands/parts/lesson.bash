# What glossary and calibrate share: feedback_node alone, until it ends.

give_lesson() {  # NAME WORD...
  local log given=("${@:2}")
  read_args "$launch_files/lesson.launch" "${given[@]/#person:=/feedback/person:=}"
  arg[lesson]=$1
  resolve_hands
  allowed[speech]="true false"
  arg[speech]=${arg[speech]:-true} arg[profile]=${arg[profile]:-default}
  one_of speech profile
  build_workspace feedback_node navvi_loopback
  check_parameters
  loopback_network
  log=$(mktemp)
  say "$1 begins in some seconds, with the ${arg[operator]}; what to press is spoken. Ctrl-C in this terminal ends it, too."
  launch "$launch_files/lesson.launch" "$log" || [[ -n $interrupted ]] || fail "it broke off; the log $log says why."
  sed -n 's/.*Found: /Found and saved: /p' "$log"
  rm -f "$log"
}

resolve_hands() {
  allowed[operator]="auto pad keyboard"
  arg[operator]=${arg[operator]:-auto}
  one_of operator
  if [[ ${arg[operator]} == auto ]]; then has_pad && arg[operator]=pad || arg[operator]=keyboard; fi
  [[ ${arg[operator]} != pad ]] || has_pad || fail "operator:=pad needs a game controller, and none is connected; operator:=keyboard needs none." 2
  [[ ${arg[operator]} != keyboard ]] || has_display || fail "there is neither a game controller nor a display for the keyboard; a lesson needs one of them, such as a pad at USB." 2
}
