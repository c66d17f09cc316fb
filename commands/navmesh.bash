navvi_navmesh() {
  local word words=() csv=""
  for word in "$@"; do
    if [[ $word == --csv ]]; then csv=yes; else words+=("$word"); fi
  done
  ((${#words[@]})) || fail "which map? Files that end in .bt, .ot (OctoMap) and .yaml (map_server) are allowed." 2
  build_workspace navmesh_tool
  if [[ -z $csv ]]; then
    draw "$(program navvi_nav navmesh_tool)" "${words[@]}"
  else
    echo "what,value"
    draw "$(program navvi_nav navmesh_tool)" "${words[@]}" | sed -n 's/^\([^ ]*\( [^ ]*\)*\)   *\(.*\)/"\1","\3"/p'
  fi
}
