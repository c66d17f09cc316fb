navvi_bench() {
  local filter=${1:-} found="" bench name
  build_workspace
  build_workspace benchmarks
  for bench in "$devel"/lib/navvi_*/*_bench; do
    name=${bench#"$devel"/lib/navvi_}
    [[ -x $bench && $name == *"$filter"* ]] || continue
    found=yes
    echo "$name"
    "$bench" "${@:2}"
  done
  [[ -n $found ]] || fail "no benchmark's name contains \"$filter\"; sim, nav and trials do." 2
}
