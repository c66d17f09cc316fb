# Builds the workspace and makes its programs known.

source_ros() {
  set +u
  # shellcheck disable=SC1091
  [[ -f /opt/ros/noetic/setup.bash ]] && source /opt/ros/noetic/setup.bash
  # shellcheck disable=SC1091
  [[ -f $1/setup.bash ]] && source "$1/setup.bash"
  set -u
}

# with_sanitizers: flags that also keep, in the objects, what the compiler knows of each type; the target odr_check compares
# that. With sanitizers GCC takes members of the standard library's regex for uninitialized.
with_sanitizers=(-DCMAKE_BUILD_TYPE=None -DNAVVI_ODR_CHECK=ON
  "-DCMAKE_CXX_FLAGS=-O0 -g1 -fsanitize=address,undefined -fno-sanitize-recover=all -Wno-error=maybe-uninitialized -flto -ffat-lto-objects"
  -DCMAKE_EXE_LINKER_FLAGS=-fno-lto -DCMAKE_SHARED_LINKER_FLAGS=-fno-lto)

# build_workspace [--asan|--odr] [target ...]
build_workspace() {
  if [[ -z $workspace ]]; then
    source_ros "$devel"
    return
  fi
  install_packages
  local variant="" flags=(-DCMAKE_BUILD_TYPE=RelWithDebInfo) log lock found
  if [[ ${1:-} == --asan || ${1:-} == --odr ]]; then
    variant=_asan flags=("${with_sanitizers[@]}")
    if [[ $1 == --odr ]]; then set -- odr_check; else shift; fi
  fi
  for found in /opt/ros/*/share/octomap_msgs /usr/share/octomap_msgs; do
    [[ -d $found ]] && flags+=(-DCATKIN_BLACKLIST_PACKAGES=octomap_msgs)
  done
  log=$workspace/build$variant.log
  exec {lock}>"$workspace/.lock"
  flock -n "$lock" || { aside "waiting for another build to end."; flock "$lock"; }
  [[ -f $workspace/build$variant/CMakeCache.txt ]] || aside "building; the first time takes about 6 minutes, more on few cores."
  with_progress "building" "$log" built_percent catkin_build "$variant" "${flags[@]}" "$@" ||
    { grep -E -A6 'error|Error' "$log" | head -n 40 >&2; fail "the build failed; the whole log is in $log. Mend the error above and build again."; }
  exec {lock}>&-
  source_ros "$devel$variant"
}
built_percent() { grep -o '^\[ *[0-9]*%\]' "$1" | tail -n 1 | tr -dc 0-9 || true; }
catkin_build() {
  local variant=$1
  shift
  source_ros /nonexistent
  cd "$workspace" || return
  # Nodes are C++ and Python; of the other languages of messages Debian has Lisp alone.
  export ROS_LANG_DISABLE=genlisp
  # Without these ccache would keep nothing that is compiled with precompiled headers.
  export CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
  PATH=/usr/lib/ccache:$PATH catkin_make --build "build$variant" -j"$(nproc)" -DCATKIN_DEVEL_PREFIX="$devel$variant" \
    -DPYTHON_EXECUTABLE=/usr/bin/python3 -DPython3_EXECUTABLE=/usr/bin/python3 "$@"
}
