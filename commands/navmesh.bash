navvi_navmesh() {
  (($# > 0)) || fail "which map? Files that end in .bt, .ot (OctoMap) and .yaml (map_server) are allowed." 2
  build_workspace
  draw "$(program navvi_nav navmesh_tool)" "$@"
}
