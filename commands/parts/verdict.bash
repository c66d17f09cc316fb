# What the simulator and navigation make of a world: they know each other's work by the OctoMap alone.

nav_words=()
# plan_in PROFILE WORLD [-o FILE.bt] [OPTION|name:=value ...]: sets what is said of the world, from, to, and what of the
# way between them; status is 0 if there is one. -o keeps the OctoMap.
plan_in() {
  local map kept="" nav_config last="" word floor
  nav_config=$(config_of navvi_nav "$1")
  shift
  for word in "$@"; do
    [[ $last != -o ]] || kept=$word
    last=$word
  done
  map=${kept:-$(mktemp --suffix=.bt)}
  # shellcheck disable=SC2064  # the name as it is now
  [[ -n $kept ]] || trap "rm -f '$map'" EXIT
  said=$("$(program navvi_sim world_tool)" check "$@" -o "$map") || exit 2
  read -r from to <<<"$(tail -n 1 <<<"$said" | sed 's/^start \([^,]*,[^,]*\),.* goal /\1 /')"
  floor=$(sed -n 's/^floor at z = \([-0-9.]*\) m$/\1/p' <<<"$said" | tail -n 1)
  [[ " ${nav_words[*]}" == *" mesh/climb:="* ]] || nav_words+=(mesh/climb:=0)
  [[ " ${nav_words[*]}" == *" mesh/floor_height:="* ]] || nav_words+=("mesh/floor_height:=$floor")
  status=0
  way=$("$(program navvi_nav navmesh_tool)" "$map" --config "$nav_config" "${nav_words[@]}" \
    --from "$from" --to "$to" 2>&1) || status=$?
  [[ -n $kept ]] || rm -f "$map"
  why="no session from $from to $to: $(tail -n 1 <<<"$way" | sed 's/^navmesh: //; s/^[^ ]*\.[bo]t: //')"
}

# verdict PROFILE WORLD [OPTION|name:=value ...]
verdict() {
  local said from to way why status
  plan_in "$@"
  echo "$said"
  ((status == 0)) || fail "$why" 2
  sed -n 's/^shortest *\([0-9]*\.[0-9]\)[0-9]* m$/shortest way \1 m/p; s/^guide path *\([0-9]*\.[0-9]\)[0-9]* m:.*/guide path \1 m/p' <<<"$way"
}

# picture_of WORLD [OPTION|name:=value ...]: as world_tool's show, with the path that a person is led along.
picture_of() {
  local said from to way why status words=() guide=() i
  for ((i = 1; i <= $#; ++i)); do
    if [[ ${!i} == -o ]]; then ((++i)); else words+=("${!i}"); fi
  done
  plan_in default "${words[@]}"
  if ((status == 0)); then
    guide=(--path "$(sed -n 's/^guide path .* m: //p' <<<"$way")" --turns "$(sed -n 's/^turns .*: *//p' <<<"$way")")
  fi
  draw "$(program navvi_sim world_tool)" show "$@" "${guide[@]}"
  ((status == 0)) || say "$why"
}
