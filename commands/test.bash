navvi_test() {
  if [[ ${1:-} == --asan ]]; then
    sanitized_tests "${@:2}"
    return
  fi
  local filter=${1:-} results=$workspace/build/test_results log=$workspace/test.log
  build_workspace
  build_workspace tests benchmarks
  rm -rf "$results"
  export ROS_IP=127.0.0.1
  unset ROS_HOSTNAME
  cd "$workspace/build"
  # Cores two at a time, nodes one at a time; each test's own result is counted below.
  with_progress "tests of the cores" "$log" tests_percent ctest -j2 -R "_gtest_.*$filter" --output-on-failure || true
  with_progress "tests of the nodes" "$log.nodes" tests_percent ctest -R "_rostest_.*$filter" --output-on-failure || true
  with_progress "tests of the whole" "$log.whole" files_percent system_tests "$filter" "$results/system" || true
  cat "$log.nodes" "$log.whole" >>"$log"
  rm -f "$log.nodes" "$log.whole"
  echo "What the tests said is in $log."
  /usr/bin/python3 "$tests/count_results.py" "$results"
}
# "12/40 Test #7: ..."; "18 files" and "entry_test has ended"
tests_percent() { sed -n 's/^ *\([0-9]*\)\/\([0-9]*\) Test .*/\1 \2/p' "$1" | tail -n 1 | awk '{print int(100 * $1 / $2)}'; }
files_percent() { awk '/ files$/ {files = $1} / has ended$/ {++ended} END {if (files) print int(100 * ended / files)}' "$1"; }

# Each file in a process of its own, for rospy knows one master in its life; one at a time, for keys and pictures need the machine.
system_tests() {  # FILTER RESULTS
  local files=("$tests"/*_test.py)
  mkdir -p "$2"
  echo "${#files[@]} files"
  export -f system_test
  printf '%s\0' "${files[@]}" | xargs -0 -P 1 -I {} bash -c 'system_test "$@"' bash {} "$1" "$2"
  cat "$2"/*.log
}
system_test() {  # FILE FILTER RESULTS
  local name
  name=$(basename "$1" .py)
  /usr/bin/python3 -m pytest -v --color=no "$1" -k "$2" --junitxml="$3/$name.xml" -p no:cacheprovider >"$3/$name.log" 2>&1 || true
  echo "$name has ended"
}

# The tests of the cores with sanitizers; without a filter also the comparison of types between the libraries.
sanitized_tests() {
  local filter=${1:-} results=$workspace/build_asan/test_results log=$workspace/test_asan.log targets
  build_workspace --asan cmake_check_build_system
  cd "$workspace/build_asan"
  readarray -t targets < <(ctest -N -R "_gtest_.*$filter" | sed -n 's/.*_gtest_//p')
  ((${#targets[@]})) || fail "no core test's name contains \"$filter\"; \"ctest -N\" in $PWD lists them." 2
  [[ -n $filter ]] || targets+=(odr_check)
  build_workspace --asan "${targets[@]}"
  rm -rf "$results"
  # Libraries that are not ours keep memory to the end of the program.
  export ASAN_OPTIONS=detect_leaks=0:detect_stack_use_after_return=1:strict_string_checks=1
  export UBSAN_OPTIONS=print_stacktrace=1
  with_progress "tests with sanitizers" "$log" tests_percent ctest -j2 -R "_gtest_.*$filter" --output-on-failure || true
  echo "What the tests said is in $log."
  /usr/bin/python3 "$tests/count_results.py" "$results"
}
