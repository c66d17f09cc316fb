navvi_run() {
  read_args "$launch_files/live.launch" "${@/#person:=/feedback/person:=}"
  resolve_operator
  resolve_rviz
  resolve_view
  check_words
  build_session
  check_parameters
  check_world
  loopback_network
  local begin log
  log=${arg[out]}/session-$(date -u +%Y%m%dT%H%M%SZ)-${ROS_MASTER_URI##*:}.log
  begin=$(mktemp)
  announce "$log"
  launch "$launch_files/live.launch" "$log" || true
  report "$begin" "$log"
}

resolve_operator() {
  arg[operator]=${arg[operator]:-auto}
  one_of operator
  if [[ ${arg[operator]} == auto ]]; then
    if has_pad; then arg[operator]=pad; elif has_display; then arg[operator]=keyboard; else arg[operator]=simulated; fi
  fi
  [[ ${arg[operator]} != pad ]] || has_pad ||
    fail "operator:=pad needs a game controller, and none is connected; operator:=keyboard and operator:=simulated need none." 2
  [[ ${arg[operator]} != keyboard ]] || has_display ||
    fail "operator:=keyboard needs a display, and DISPLAY is not set; operator:=simulated needs none." 2
  [[ ${arg[operator]} != simulated ]] || arg[once]=${arg[once]:-true} arg[limit]=${arg[limit]:-600}
}

# What can be refused before anything is built.
check_words() {
  local folder
  arg[speech]=${arg[speech]:-auto} arg[profile]=${arg[profile]:-default} arg[once]=${arg[once]:-false} arg[lesson]=${arg[lesson]:-none} arg[sensing]=${arg[sensing]:-truth}
  one_of speech profile once lesson sensing
  [[ ${arg[lesson]} == none || ${arg[operator]} != simulated ]] ||
    fail "the tutorial needs a person: a game controller, or a display for the keyboard, such as with operator:=keyboard." 2
  [[ ${arg[speech]} != false || ${arg[operator]} != simulated ]] ||
    fail "the simulated person drives by what it hears, and with speech:=false that is nothing; leave speech out, or drive yourself, such as with operator:=keyboard." 2
  number limit
  [[ ${arg[participant]:-n/a} =~ ^([A-Za-z0-9_-]{1,32}|n/a)$ ]] ||
    fail "participant:=${arg[participant]} is not allowed; allowed are up to 32 letters, digits, - and _, such as sub-01." 2
  arg[out]=$(readlink -m -- "${arg[out]:-$trials}")
  mkdir -p -- "${arg[out]}" 2>/dev/null || fail "the folder ${arg[out]} cannot be made; out:=FOLDER names another." 2
  local folders=()
  IFS=: read -ra folders <<<"${arg[models]:-}"
  for folder in "${folders[@]}"; do
    [[ -d $folder ]] || fail "models:=$folder is no folder; folders that exist are allowed, separated by colons." 2
  done
}

# The nodes would refuse the same, but only when all have started. Nodes run elsewhere: paths become absolute.
check_world() {
  local name folder folders words=()
  arg[world]=${arg[world]:-warehouse}
  for name in world classes; do
    [[ ! -f ${arg[$name]:-} ]] || arg[$name]=$(readlink -f -- "${arg[$name]}")
  done
  if [[ -n ${arg[models]:-} ]]; then
    IFS=: read -ra folders <<<"${arg[models]}"
    arg[models]=""
    for folder in "${folders[@]}"; do arg[models]+=${arg[models]:+:}$(readlink -m -- "$folder"); done
  fi
  for name in models classes seed start goal; do
    [[ ! -v arg[$name] ]] || words+=("$name:=${arg[$name]}")
  done
  for name in "${parameters[@]}"; do
    case $name in
      sim/*) words+=("${name#sim/}") ;;
      nav/*) nav_words+=("${name#nav/}") ;;
    esac
  done
  verdict "${arg[profile]}" "${arg[world]}" --config "$(config_of navvi_sim "${arg[profile]}")" "${words[@]}" >/dev/null
}

# Six lines: what begins, what to press, where the record goes, how to stop.
announce() {
  local -A drive=(
    [pad]="press start; then the left stick of the pad drives, up for forward."
    [keyboard]="press enter; then the arrow keys drive, with Shift slowly, while the picture or NavVI's small window has the focus."
    [simulated]="nothing to do; a simulated person drives."
  ) ask=(
    [pad]="the lower button repeats the direction, the right one tells the goal, the left one what is near."
    [keyboard]="space repeats the direction, G tells the goal, A what is near."
    [simulated]="what it hears is in the log below, and in \"./navvi watch\"."
  )
  [[ ${arg[lesson]} != tutorial ]] || drive[${arg[operator]}]="listen; each step of the tutorial is spoken."
  [[ "${parameters[*]}" != *feedback/buttons/* ]] || ask[pad]="as your feedback/buttons say."
  say "a session begins in some seconds: world ${arg[world]}, seed ${arg[seed]:-1}, profile ${arg[profile]}, operator ${arg[operator]}."
  echo "To drive: ${drive[${arg[operator]}]}"
  echo "To hear more: ${ask[${arg[operator]}]}"
  echo "The record: a new folder in ${arg[out]}; what the programs say: $1"
  echo "To stop: Ctrl-C in this terminal."
  echo "In a second terminal: ./navvi watch tells it in words; for ROS tools: $(second_terminal)"
}

# The last word of a session comes from the trial's own summary.
report() {  # FILE_FROM_BEFORE LOG
  local begin=$1 log=$2 summary
  "$(program navvi_study close_trials)" "${arg[out]}"
  summary=$(find "${arg[out]}" -name summary.csv -newer "$begin" -printf '%T@ %p\n' | sort -n | tail -n 1 | cut -d' ' -f2-)
  rm -f "$begin"
  [[ -n $summary ]] ||
    fail "the session ended without a trial; the log $log says why. $(sed 's/.*\]: //; s/\x1b\[[0-9;]*m//g' "$fatal" | tail -n 1)"
  "$(script navvi_study show_summary)" "$(dirname "$summary")"
}
