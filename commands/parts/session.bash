# What run and replay share: the network, the launch file, what is shown of it.

has_display() { [[ -n ${DISPLAY:-}${WAYLAND_DISPLAY:-} ]]; }
has_pad() {
  compgen -G '/dev/input/js*' >/dev/null || compgen -G '/dev/input/by-id/*-event-joystick' >/dev/null || grep -qsi 'HID_ID=.*054C.*0CE6' /sys/class/hidraw/*/device/uevent
}
resolve_rviz() {
  arg[rviz]=${arg[rviz]:-auto}
  one_of rviz
  if [[ ${arg[rviz]} == auto ]]; then has_display && arg[rviz]=true || arg[rviz]=false; fi
  [[ ${arg[rviz]} == false ]] || has_display || fail "rviz:=true needs a display, and DISPLAY is not set; rviz:=false needs none." 2
}
resolve_view() {
  local name
  for name in vision view; do [[ ! -v arg[$name] ]] || one_of "$name"; done
}

# build_session [TARGET ...]: what a session starts, and the targets.
build_session() {
  local targets=(session "$@")
  [[ ${arg[rviz]} == false ]] || targets+=(navvi_rviz)
  [[ ${arg[sensing]:-truth} == truth ]] || targets+=(perception_node)
  build_workspace "${targets[@]}"
}

# A master of its own on the loopback interface. Nodes would also open a port on every interface, which the preloaded
# library prevents; it also lets rosmaster, rosout and RViz end with roslaunch.
loopback_network() {
  local port=11311
  until claim_port "$port"; do
    ((++port < 11411)) || fail "no port from 11311 to 11410 is free for a master; end sessions that are not needed, \"ss -ltnp\" lists them."
  done
  export ROS_IP=127.0.0.1 ROS_MASTER_URI=http://127.0.0.1:$port
  unset ROS_HOSTNAME
  export LD_PRELOAD=$devel/lib/libnavvi_loopback.so
}
# The lock of a port keeps a second session that starts now from it until this one's master listens there, and `watch`
# finds running sessions by it. It is one file for all users of the machine, locked through a descriptor that only reads: the
# file may be another user's. A port whose lock cannot be opened, or on which anything listens, is not ours.
port_locks=${TMPDIR:-/tmp}/navvi-port  # -PORT.lock
listeners() { ss -ltnHe "sport = :$1" || fail "ss of iproute2 cannot say whether port $1 is free, and without that no session starts." 2; }  # PORT
claim_port() {  # PORT
  local file=$port_locks-$1.lock lock taken
  [[ -e $file ]] || (umask 022 && : >>"$file") 2>/dev/null || true
  { exec {lock}<"$file"; } 2>/dev/null || return 1
  if flock -n "$lock"; then
    taken=$(listeners "$1") || exit 2
    [[ -n $taken ]] || return 0
  fi
  exec {lock}<&-
  return 1
}
second_terminal() { echo "$([[ ! -f $devel/setup.bash ]] || echo "source ${devel#"$PWD"/}/setup.bash; ")export ROS_MASTER_URI=$ROS_MASTER_URI ROS_IP=127.0.0.1"; }

# Of all that roslaunch and the nodes say, which goes to the log, a person reads on the screen: warnings, errors, which
# trial begins and ends, and which node ended. roslaunch frames the end of a required node as a death, also where it has
# done its work.
no_controls='s/\x1b\[[0-9;]*m//g; s/\x1b\][^\x07]*\x07//g; s/[\r\x07]//g'
for_the_screen='
  s/^\[ *FATAL\] \[[^]]*\]: /navvi: error: /p
  s/^\[ *ERROR\] \[[^]]*\]: /navvi: error: /p
  s/^\[ *WARN\] \[[^]]*\]: /navvi: warning: /p
  s/^\[ *INFO\] \[[^]]*\]: \(Trial [^ ]* has begun\|Trial ended\)/navvi: \1/p
  s/.*REQUIRED process \[\([a-z_]*\)[^]]*\] has died!.*/navvi: \1 has ended, and the session with it./p
  s/^\[\([a-z_]*\)-[0-9]*\] process has died \[.*exit code \([-0-9]*\).*/navvi: warning: \1 has ended with exit code \2 and is started anew./p
  s/^RLException: /navvi: error: /p'

# launch FILE LOG: runs a launch file with `arg`. What ended it is in the file $fatal as well.
launch() {
  local name args=()
  for name in "${!arg[@]}"; do args+=("$name:=${arg[$name]}"); done
  export ROSCONSOLE_STDOUT_LINE_BUFFERED=1 PYTHONUNBUFFERED=1
  fatal=$(mktemp)
  interrupted=""
  trap 'rm -f "$fatal"' EXIT
  trap 'interrupted=yes' INT
  # Programs end with the roslaunch that has this number, however it ends (launcher.hpp).
  (export NAVVI_LAUNCHER=$BASHPID && exec roslaunch "$1" "${args[@]}") 2>&1 | {
    trap 'say "stopped by Ctrl-C; what was recorded is kept."' INT
    sed -u -n -e "$no_controls" -e "w $2" -e "/FATAL\|RLException/w $fatal" -e "$for_the_screen" <&0 &
    while kill -0 $! 2>/dev/null; do wait $! || true; done
  }
  local status=${PIPESTATUS[0]}
  trap stopped INT
  return "$status"
}
