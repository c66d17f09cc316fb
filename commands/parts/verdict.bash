# What the simulator and navigation make of a world: they know each other's work by the OctoMap alone.

nav_words=()
# verdict PROFILE WORLD [OPTION|name:=value ...]
verdict() {
  local map said from to way status=0 nav_config
  nav_config=$(config_of navvi_nav "$1")
  shift
  map=$(mktemp --suffix=.bt)
  # shellcheck disable=SC2064  # the name as it is now
  trap "rm -f '$map'" EXIT
  said=$("$(program navvi_sim world_tool)" check "$@" -o "$map") || exit 2
  echo "$said"
  read -r from to <<<"$(tail -n 1 <<<"$said" | sed 's/^start \([^,]*,[^,]*\),.* goal /\1 /')"
  [[ " ${nav_words[*]}" == *" mesh/climb:="* ]] || nav_words+=(mesh/climb:=0)
  way=$("$(program navvi_nav navmesh_tool)" "$map" --config "$nav_config" "${nav_words[@]}" \
    --from "$from" --to "$to" 2>&1) || status=$?
  rm -f "$map"
  ((status == 0)) || fail "no session from $from to $to: $(tail -n 1 <<<"$way" | sed 's/^navmesh: //; s/^[^ ]*\.bt: //')" 2
  sed -n 's/^shortest *\([0-9]*\.[0-9]\)[0-9]* m$/shortest way \1 m/p; s/^guide path *\([0-9]*\.[0-9]\)[0-9]* m:.*/guide path \1 m/p' <<<"$way"
}
