navvi_bench() {
  local filter=${1:-} file name targets=(session) scripts=() programs=()
  for file in "$workspace"/src/navvi_*/bench/*_bench.cpp "$workspace"/src/navvi_*/scripts/*_bench; do
    [[ $file =~ navvi_([a-z]+)/(bench|scripts)/([a-z_]+)(\.cpp)?$ ]] || continue
    name=${BASH_REMATCH[1]}/${BASH_REMATCH[3]}
    [[ $name == *"$filter"* && ($name != build/* || $filter == build) ]] || continue
    if [[ $file == *.cpp ]]; then targets+=("${name#*/}") programs+=("$name"); else scripts+=("$name"); fi
  done
  ((${#programs[@]} + ${#scripts[@]})) || fail "no benchmark's name contains \"$filter\"; build, sim, nav, latency, loop and trials do." 2
  install_packages all
  build_workspace "${targets[@]}"
  for name in "${programs[@]}"; do
    echo "$name"
    "$(program "navvi_${name%/*}" "${name#*/}")" "${@:2}"
  done
  for name in "${scripts[@]}"; do
    echo "$name"
    "$(script "navvi_${name%/*}" "${name#*/}")" "${@:2}"
  done
}
