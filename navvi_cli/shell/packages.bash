# What NavVI needs of Debian 12 or 13, and how it gets there.

# Without these no session runs; netbase writes /etc/hosts, where roslaunch looks for localhost.
run_packages=(
  netbase rosbash rosout espeak-ng-data libopenal-data iproute2 python3-rosbag python3-roslaunch python3-rosnode
  python3-rosservice python3-rostopic python3-rospy python3-geometry-msgs python3-nav-msgs
  python3-sensor-msgs python3-std-msgs python3-visualization-msgs python3-diagnostic-msgs python3-move-base-msgs python3-std-srvs python3-tf2-msgs
  python3-yaml
)
# Without these a session runs, but without its picture, screen readers in it, drawings, `watch speech:=true` or the Tab key.
comfort_packages=(
  rviz libgl1-mesa-dri at-spi2-core dbus-bin x11-utils python3-matplotlib python3-argcomplete fonts-dejavu-core python3-numpy python3-pil
  python3-speechd speech-dispatcher speech-dispatcher-espeak-ng
)
session_packages=(
  build-essential ccache cmake ninja-build catkin ros-core-dev librviz-dev libactionlib-dev libmove-base-msgs-dev libtf2-msgs-dev libtf2-ros-dev liblaser-geometry-dev libompl-dev
  liboctomap-dev libbullet-dev libsdl2-dev libespeak-ng-dev librecast-dev libyaml-cpp-dev libopenal-dev libx11-dev libtinyxml2-dev libassimp-dev libeigen3-dev
  zlib1g-dev pkg-config libgtest-dev librostest-dev
  "${run_packages[@]}" "${comfort_packages[@]}"
)
# A study's report draws and counts with these; a session does not need them.
report_packages=(python3-jinja2 python3-pandas python3-scipy python3-statsmodels)
test_packages=(
  libbenchmark-dev pocketsphinx pocketsphinx-en-us python3-pytest python3-rostest
  shellcheck xvfb imagemagick sox openbox xdotool lintian catkin-lint
  python3-pyatspi dbus-daemon procps zsh
  "${report_packages[@]}"
)
# Tests that need one of these are skipped, and counted, where the release of Debian lacks it.
optional_packages=(libsdformat-dev)

missing_packages() {  # PACKAGE...
  local installed
  installed=$(dpkg-query -W -f '${db:Status-Abbrev} ${Package}\n' "$@" 2>/dev/null | awk '$1 == "ii" {print $2}' || true)
  comm -23 <(printf '%s\n' "$@" | sort -u) <(sort -u <<<"$installed")
}
# qt_packages [build]: what draws icons in RViz, or is also needed to build its plug-in, of the Qt that apt's RViz is linked to. Two
# versions of Qt in one process end it by signal 11. apt needs a second for what dpkg knows of an RViz that is installed.
qt_packages() {
  local depends
  depends=$(dpkg-query -W -f '${Depends}' rviz 2>/dev/null) || true
  case ${depends:-$(apt-cache depends rviz 2>/dev/null)} in
    *libqt6*) echo qt6-svg-plugins "${1:+qt6-base-dev}" ;;
    *libqt5*) echo libqt5svg5 "${1:+qtbase5-dev}" ;;
  esac
}
available() {  # PACKAGE...: those that apt can install
  apt-cache policy "$@" 2>/dev/null | awk '/^[^ ]/ {name = $1} /Candidate: [^(]/ {sub(":$", "", name); print name}'
}

elsewhere() {
  fail "NavVI needs Debian 12 or 13, where ROS is part of the system; run it there, or in a container: \"podman build -t navvi $root\", then \"podman run -it --rm navvi\"."
}

# Half the way is the download, half the installation; apt-get reports how far it is in each.
installed_percent() {
  awk -F: '/^dlstatus:/ {done = $3 / 2} /^pmstatus:/ {done = 50 + $3 / 2} END {print int(done)}' "$1"
}

# install_packages [report|benchmarks|all]: what a session needs, and what a study's report, the benchmarks or the tests need as well.
install_packages() {
  [[ -f /opt/ros/noetic/setup.bash ]] && return  # on Ubuntu, rosdep installs what package.xml names
  local needed=("${session_packages[@]}") missing as_root=() log=$root/.setup.log optional=() qt=()
  read -ra qt < <(qt_packages build) || true  # none where apt knows no RViz before its first update
  needed+=("${qt[@]}")
  [[ ${1:-} != report ]] || needed+=("${report_packages[@]}")
  [[ ${1:-} != @(benchmarks|all) ]] || needed+=("${test_packages[@]}")
  [[ ${1:-} != all ]] || optional=("${optional_packages[@]}")
  command -v apt-get >/dev/null || elsewhere
  missing=$(missing_packages "${needed[@]}")
  if [[ -z $missing && -n ${optional[*]} ]]; then
    readarray -t optional < <(missing_packages "${optional[@]}")
    missing=$(available "${optional[@]}")
  fi
  [[ -n $missing ]] || return 0
  if ((EUID != 0)); then
    command -v sudo >/dev/null ||
      fail "these packages are missing, and only root can install them; ask root to run \"./navvi setup\": ${missing//$'\n'/ }"
    if [[ -t 0 ]]; then sudo -v; fi || fail "the packages need root; run \"./navvi setup\" as root or with a password for sudo."
    sudo -n true 2>/dev/null || fail "sudo would ask for a password and there is no terminal; run \"./navvi setup\" in one, or as root."
    as_root=(sudo -n)
  fi
  aside "installing $(wc -l <<<"$missing") packages of Debian (all together 1.5 GB); this takes some minutes."
  # shellcheck disable=SC2086  # one word a package
  with_progress "installing" "$log" installed_percent apt_get $missing ||
    {
      [[ -n $(available ros-core-dev) ]] || elsewhere
      tail -n 20 "$log" >&2
      fail "apt-get could not install the packages; the whole log is in $log. Mend what it says and run \"./navvi setup\" again."
    }
  rm -f "$log"
  aside "the packages are installed."
}
# apt closes its status descriptor before dpkg, whose scripts print: so it is not standard output, as
# on Debian 13 packages then fail with "I/O error".
apt_get() {  # PACKAGE...
  local more=() qt=()
  "${as_root[@]}" dpkg --configure -a || return  # what Ctrl-C may have left behind
  "${as_root[@]}" apt-get update -q || return
  ((${#optional[@]} == 0)) || readarray -t more < <(available "${optional[@]}")
  read -ra qt < <(qt_packages build) || true
  # shellcheck disable=SC2016  # the inner shell's: sudo hands no other descriptor on
  "${as_root[@]}" sh -c 'exec "$@" 3>&1' sh env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends -o Dpkg::Use-Pty=0 -o APT::Status-Fd=3 "$@" "${qt[@]}" "${more[@]}"
}
