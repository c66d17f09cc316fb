navvi_parameters() {
  local form=words filter="" word node name
  for word in "$@"; do
    case $word in
      --csv) form=csv ;;
      -*) fail "\"$word\" is no option of parameters; --csv is allowed." 2 ;;
      *) filter=$word ;;
    esac
  done
  build_workspace
  [[ $form == words ]] || echo "node,parameter,default,allowed,meaning"
  for node in "$devel"/lib/navvi_*/{*_node,cue_player,world_tool}; do
    name=$(basename "$node")
    [[ -x $node && $name == *"$filter"* ]] || continue
    [[ $form == csv ]] || printf '\n%s\n' "$name"
    "$node" --parameters | parameter_rows "$form" "$name"
  done
}

# A table of Markdown as sentences or as CSV.
parameter_rows() {
  awk -F' [|] ' -v form="$1" -v node="$2" '
    function quoted(cell) { gsub(/"/, "\"\"", cell); return "\"" cell "\"" }
    NR > 2 {
      sub(/^[|] /, ""); sub(/ [|]$/, "")
      if (form == "csv") print node "," quoted($1) "," quoted($2) "," quoted($3) "," quoted($4)
      else print $1 ": " $4 ". It is " $2 "; allowed: " $3 "."
    }'
}
