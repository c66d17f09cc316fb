navvi_world() {
  local word words=() csv="" file=""
  for word in "$@"; do
    [[ $word != *.@(sdf|bt|ot) ]] || file=$word
    case ${1:-}$word in
      *--csv) csv=yes ;;
      write-o | map-o) ;;  # as for the pictures, though there is nothing else to name
      *) words+=("$word") ;;
    esac
  done
  set -- "${words[@]}"
  [[ -z $csv || ${1:-} == list || ${1:-} == check ]] || fail "--csv is for \"world list\" and \"world check\"." 2
  case ${1:-} in
    check)
      build_workspace world_tool navmesh_tool
      if [[ -z $csv ]]; then verdict default "${@:2}"; else verdict default "${@:2}" | world_rows; fi
      ;;
    show)
      build_workspace world_tool navmesh_tool
      picture_of "${@:2}"
      ;;
    list)
      build_workspace world_tool
      "$(program navvi_sim world_tool)" "$@" | list_rows "$csv"
      ;;
    *)
      build_workspace world_tool
      draw "$(program navvi_sim world_tool)" "$@"
      [[ ${1:-} != write && ${1:-} != map ]] || say "the world is in $file."
      ;;
  esac
}

list_rows() {
  if [[ -n $1 ]]; then
    echo "name,meaning"
    sed 's/"/""/g; s/^\([^ ]*\)  *\(.*\)/\1,"\2"/'
  else
    sed 's/^\([^ ]*\)  */\1: /'
  fi
}

# "6 forklift on routes" as "forklift on routes",6; the sentences after the counts likewise by their first words.
world_rows() {
  echo "what,value"
  sed 's/^\([0-9][0-9]*\) \(.*\)/"\2",\1/; s/^\(.*\), seed \([^,]*\), world \(.*\)/"world","\1"\n"seed",\2\n"world hash","\3"/
       s/^floor at z = \(.*\) m$/"floor z m",\1/
       s/^start \(.*\) goal \(.*\)/"start x m, y m, yaw rad","\1"\n"goal x m, y m","\2"/; s/^\(shortest way\|guide path\) \(.*\) m$/"\1 m",\2/'
}
