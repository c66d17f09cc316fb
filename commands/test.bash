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
# "12/40 Test #7: ..." and "test/entry_test.py::test_... PASSED [ 45%]"
tests_percent() { sed -n 's/^ *\([0-9]*\)\/\([0-9]*\) Test .*/\1 \2/p' "$1" | tail -n 1 | awk '{print int(100 * $1 / $2)}'; }
files_percent() { sed -n 's/^File \([0-9]*\) of \([0-9]*\)$/\1 \2/p' "$1" | tail -n 1 | awk '{print int(100 * ($1 - 1) / $2)}'; }

# Each file in a process of its own: rospy knows one master in its life.
system_tests() {  # FILTER RESULTS
  local file number=0 files=("$tests"/*_test.py)
  for file in "${files[@]}"; do
    echo "File $((++number)) of ${#files[@]}"
    /usr/bin/python3 -m pytest -v --color=no "$file" -k "$1" --junitxml="$2/$(basename "$file" .py).xml" -p no:cacheprovider || true
  done
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
