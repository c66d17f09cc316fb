navvi_bench() {
  local filter=${1:-} found="" bench name
  build_workspace
  build_workspace benchmarks
  for bench in "$devel"/lib/navvi_*/*_bench "$workspace"/src/navvi_study/scripts/*_bench; do
    [[ -x $bench && $bench =~ navvi_([a-z]+)/(scripts/)?([a-z_]+)$ ]] || continue
    name=${BASH_REMATCH[1]}/${BASH_REMATCH[3]}
    [[ $name == *"$filter"* ]] || continue
    found=yes
    echo "$name"
    "$bench" "${@:2}"
  done
  [[ -n $found ]] || fail "no benchmark's name contains \"$filter\"; sim, nav, latency, loop and trials do." 2
}
