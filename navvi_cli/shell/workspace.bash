# Builds the workspace and makes its programs known.

source_ros() {
  set +u
  # shellcheck disable=SC1091
  [[ -f /opt/ros/noetic/setup.bash ]] && source /opt/ros/noetic/setup.bash
  # shellcheck disable=SC1091
  [[ -f $1/setup.bash ]] && source "$1/setup.bash"
  set -u
}

# Flags that also keep, in the objects, what the compiler knows of each type; the target odr_check compares that. With
# sanitizers GCC takes members of the standard library's regex for uninitialized.
with_sanitizers=(-DCMAKE_BUILD_TYPE=None -DNAVVI_ODR_CHECK=ON
  "-DCMAKE_CXX_FLAGS=-O1 -g1 -fsanitize=address,undefined -fno-sanitize-recover=all -Wno-error=maybe-uninitialized -flto -ffat-lto-objects"
  -DCMAKE_EXE_LINKER_FLAGS=-fno-lto -DCMAKE_SHARED_LINKER_FLAGS=-fno-lto)

# build_workspace [--asan|--odr] [TARGET ...]: builds the targets, or the whole product. Nothing is asked, locked or
# printed where they are up to date.
build_workspace() {
  if [[ -z $workspace ]]; then
    source_ros "$devel"
    return
  fi
  local variant="" flags=(-DCMAKE_BUILD_TYPE=RelWithDebInfo) log lock found
  if [[ ${1:-} == --asan || ${1:-} == --odr ]]; then
    variant=_asan flags=("${with_sanitizers[@]}")
    if [[ $1 == --odr ]]; then set -- odr_check; else shift; fi
  fi
  (($#)) || set -- all
  if ! is_built "$workspace/build$variant" "$@"; then
    install_packages
    for found in /opt/ros/*/share/octomap_msgs /usr/share/octomap_msgs; do
      [[ -d $found ]] && flags+=(-DCATKIN_BLACKLIST_PACKAGES=octomap_msgs)
    done
    log=$workspace/build$variant.log
    exec {lock}>"$workspace/.lock"
    flock -n "$lock" || { aside "waiting for another build to end."; flock "$lock"; }
    with_progress "building" "$log" built_percent cmake_build "$variant" "${flags[@]}" -- "$@" ||
      { grep -E -A6 'error|Error' "$log" | head -n 40 >&2; fail "the build failed; the whole log is in $log. Mend the error above and build again."; }
    exec {lock}>&-
  fi
  source_ros "$devel$variant"
}

# is_built FOLDER TARGET...: whether no source of the targets is newer than they are. What genmsg checks with every build
# does not count.
is_built() {
  local steps
  is_configured "$1" && steps=$(ninja -C "$1" -n "${@:2}" 2>/dev/null) && [[ -z $(sed -n '/genmsg_check_deps/d; /^\[/p' <<<"$steps") ]]
}
# Whether no source file was added or removed since cmake looked for them.
is_configured() {  # FOLDER
  [[ -f $1/configured && -z $(find "$workspace/src" -type d -newer "$1/configured" -print -quit) ]]
}
# "[12/345] ..."
built_percent() { sed -n 's/^\[\([0-9]*\)\/\([0-9]*\)\] .*/\1 \2/p' "$1" | tail -n 1 | awk '{print int(100 * $1 / $2)}'; }

# cmake_build VARIANT FLAG... -- TARGET...
cmake_build() {
  local build=$workspace/build$1 flags=(-DCATKIN_DEVEL_PREFIX="$devel$1" -DCMAKE_INSTALL_PREFIX="$workspace/install" -DPYTHON_EXECUTABLE=/usr/bin/python3
    -DPython3_EXECUTABLE=/usr/bin/python3 -DNAVVI_WARNINGS_ARE_ERRORS="${NAVVI_WARNINGS_ARE_ERRORS:-OFF}" -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  shift
  while [[ $1 != -- ]]; do flags+=("$1") && shift; done
  shift
  source_ros /nonexistent
  # Nodes are C++ and Python; of the other languages of messages Debian has Lisp alone.
  export ROS_LANG_DISABLE=genlisp
  # Without these ccache would keep nothing that is compiled with precompiled headers. By the compiler's own list of
  # headers (depend mode) it need not preprocess a file to find what it keeps.
  export CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime CCACHE_DEPEND=1
  if ! is_configured "$build" || [[ $(<"$build/configured") != "${flags[*]}" ]]; then
    ln -sfn "$(catkin_toplevel)" "$workspace/src/CMakeLists.txt"
    cmake -S "$workspace/src" -B "$build" -G Ninja "${flags[@]}" && echo "${flags[*]}" >"$build/configured" || return
  fi
  cmake --build "$build" -j "$(nproc)" --target "$@"
}
# Catkin's CMakeLists.txt of a whole workspace.
catkin_toplevel() {
  local file
  for file in /opt/ros/*/share/catkin/cmake/toplevel.cmake /usr/share/catkin/cmake/toplevel.cmake; do
    [[ ! -f $file ]] || { echo "$file"; return; }
  done
}

# environment DEVEL: that of the workspace, each variable ended by a zero.
environment() {
  source_ros "$1" >&2
  env -0
}
