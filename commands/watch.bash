navvi_watch() {
  local trial=""
  if [[ -n ${1:-} && $1 != *:=* ]]; then
    trial_folder "$1"
    shift
  fi
  watch_words "$@"
  build_workspace navvi_msgs_generate_messages_py
  [[ -n $trial ]] || running_session
  exec "$(script navvi_study watch_session)" "${arg[pace]}" "${arg[speech]}" ${trial:+"$trial"}
}

watch_words() {
  local word name known="pace port speech"
  for word in "$@"; do
    name=${word%%:=*}
    [[ $word == *:=* ]] || fail "\"$word\" is no argument; arguments look like name:=value." 2
    [[ " $known " == *" $name "* ]] || fail "\"$name\" is unknown; known are: $known" 2
    [[ ! -v arg[$name] ]] || fail "\"$name\" is given twice; once is allowed." 2
    arg[$name]=${word#*:=}
  done
  arg[speech]=${arg[speech]:-false} arg[pace]=${arg[pace]:-180} allowed[speech]="true false"
  one_of speech
  number pace
  number port
}

# One that cannot be opened is nothing that could be watched.
lock_is_free() { (exec <"$1" && flock -n 0) 2>/dev/null || [[ ! -r $1 ]]; }  # FILE
# Nobody listens while a session begins; ss names no user where that is root.
ours() {  # PORT
  local listener user=0
  listener=$(listeners "$1") || exit 2
  [[ ! $listener =~ uid:([0-9]+) ]] || user=${BASH_REMATCH[1]}
  [[ -z $listener ]] || ((user == UID))
}
# The session of this user that has the lock of a port (loopback_network).
running_session() {
  local file port ports=()
  for file in "$port_locks"-*.lock; do
    port=${file##*-} port=${port%.lock}
    [[ ! -f $file ]] || lock_is_free "$file" || ! ours "$port" || ports+=("$port")
  done
  [[ -z ${arg[port]:-} ]] || ports=("${arg[port]}")
  ((${#ports[@]})) || fail "no session runs on this machine; start one with \"./navvi run\", or name a trial's folder, such as trials/trial-20260101T120000Z." 2
  ((${#ports[@]} == 1)) || fail "several sessions run; one of these is allowed: ${ports[*]/#/port:=}" 2
  export ROS_MASTER_URI=http://127.0.0.1:${ports[0]} ROS_IP=127.0.0.1
  unset ROS_HOSTNAME
}
