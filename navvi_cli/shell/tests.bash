# The tests' tiers, each with those before it.
tiers=(quick whole release)

# Refuses a word before anything is installed or built.
is_a_test() {  # FILTER
  /usr/bin/python3 "$root/test/find_tests.py" "$1" >/dev/null 2>&1 ||
    fail "no test's name contains \"$1\"; \"./navvi test --slowest\" lists those of the last run." 2
}

tests() {  # TIER [FILTER]
  local tier=$1 filter=${2:-.} labels="" results=$workspace/build/test_results log=$workspace/test.log name status=0
  is_a_test "$filter"
  install_packages all
  if [[ $tier == quick ]]; then
    build_workspace all core_tests
  elif [[ $tier == release && $filter == . ]]; then
    build_workspace all tests benchmarks
  else
    build_workspace all tests
  fi
  rm -rf "$results" "$results.xml"
  mkdir -p "$results"
  export ROS_IP=127.0.0.1
  unset ROS_HOSTNAME
  for name in "${tiers[@]}"; do
    labels+=${labels:+|}$name
    [[ $name != "$tier" ]] || break
  done
  cd "$workspace/build"
  local selected=(-L "^($labels)\$" -R "$filter")
  if ! ctest -N "${selected[@]}" | grep -q 'Total Tests: [1-9]'; then
    # No program has that name; cases may. Each kind of program is told by a variable which of its cases to run.
    selected[3]="^($(/usr/bin/python3 "$root/test/find_tests.py" "$filter" | paste -sd '|'))\$"
    ctest -N "${selected[@]}" | grep -q 'Total Tests: [1-9]' ||
      fail "no test of the tier $tier has \"$filter\" in its name; another tier may." 2
    export NAVVI_TEST_CASE=$filter GTEST_FILTER="*${filter//|/*:*}*" PYTEST_ADDOPTS="-k '${filter//|/ or }'"
  fi
  # Twice as many as there are processors: what computes counts as two (PROCESSORS).
  with_progress "testing" "$log" tests_percent /usr/bin/python3 "$root/test/run_tests.py" "$results.xml" -j"$((2 * $(nproc)))" "${selected[@]}" || true
  sed -n '/^run again, alone: /,/^Test project /{/^Test project /!p}; /^left out: /p' "$log"
  if [[ $tier == release && $filter == . ]]; then
    sanitized_tests "" || status=$?
  fi
  echo "The output of the tests is in $log."
  /usr/bin/python3 "$root/test/count_results.py" "$results.xml" "$results" || status=$?
  return "$status"
}

# The tests of a row of doc/faults.md, or of all rows, once more; prints what all such runs since the build have measured.
fault_rows() {  # [ROW]
  local rows status=0
  rows=$(grep -oP '^\| \K[A-Z]\d+(?= )' "$root/doc/faults.md" | grep -x "${1:-.*}" | sort -u | sed 's/$/_/' | paste -sd '|') || true
  [[ -n $rows ]] || fail "doc/faults.md has no row \"$1\"." 2
  tests release "$rows" || status=$?
  /usr/bin/python3 "$root/test/fault_rows.py" "$workspace/build/fault_rows.csv" "$workspace/build/test_results"
  return "$status"
}

# Damaged bytes to all readers, with sanitizers, beside whatever else runs, until so many hours of the processor were given since ever.
fuzz_hours() {  # [HOURS]
  install_packages all
  build_workspace --asan core_tests
  exec nice -n 19 /usr/bin/python3 "$root/test/fuzz_hours.py" "$workspace/build_asan" "$root/doc/evidence/fuzz.csv" "$@"
}

# "12/40 Test #7: NAME ...": a part of a package, such as navvi_sim/live/world, takes a twentieth of the time of others.
tests_percent() {
  ctest -N "${selected[@]}" | awk 'function cost(name) { return name ~ "/" ? 1 : 20 }
    FNR == NR { if ($1 == "Test") all += cost($NF); next }
    $2 == "Test" { done += cost($4) }
    END { if (all) print int(100 * done / all) }' - "$1"
}

slowest() {
  [[ -d $workspace/build/test_results ]] || fail "no tests have run yet; \"./navvi test\" runs them."
  /usr/bin/python3 "$root/test/count_results.py" --slowest "$workspace/build/test_results.xml" "$workspace/build/test_results"
}

# The tests of the cores with sanitizers; without a filter also the comparison of types between the libraries.
sanitized_tests() {
  local filter=${1:-} results=$workspace/build_asan/test_results log=$workspace/test_asan.log targets=(core_tests) selected
  selected=(-R "^navvi_.*/.*$filter")
  is_a_test "${filter:-.}"
  install_packages all
  [[ -n $filter ]] || targets+=(odr_check)
  build_workspace --asan "${targets[@]}"
  cd "$workspace/build_asan"
  rm -rf "$results" "$results.xml"
  # Libraries that are not ours keep memory to the end of the program.
  export ASAN_OPTIONS=detect_leaks=0:detect_stack_use_after_return=1:strict_string_checks=1
  export UBSAN_OPTIONS=print_stacktrace=1
  export NAVVI_FUZZ=${NAVVI_FUZZ:-3000}
  with_progress "testing with sanitizers" "$log" tests_percent ctest -j"$((2 * $(nproc)))" "${selected[@]}" --output-on-failure --output-junit "$results.xml" || true
  echo "The output of the tests is in $log."
  /usr/bin/python3 "$root/test/count_results.py" "$results.xml" "$results"
}
