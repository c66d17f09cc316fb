# navvi_completion: a script for bash. navvi_completion LINE: the words that the last one of the line may become.
navvi_completion() {
  if (($#)); then
    possible_words "$1" | sort -u
    return
  fi
  cat <<T
_navvi() {
  local word=\${COMP_LINE:0:COMP_POINT} known
  word=\${word##* }
  # For bash a word also ends at : and =, so what stands before the last of them is left out.
  local before=\${word%"\${word##*[:=]}"}
  COMPREPLY=()
  while IFS= read -r known; do
    [[ \$known != "\$word"* ]] || COMPREPLY+=("\${known#"\$before"}")
  done < <("$root/navvi" completion "\${COMP_LINE:0:COMP_POINT}")
  [[ \${#COMPREPLY[@]} != 1 || \${COMPREPLY[0]} == *= ]] || COMPREPLY[0]+=" "
}
complete -o default -o nospace -F _navvi ./navvi navvi "$root/navvi"
T
}

possible_words() {
  local line=$1 word name
  word=${line##* }
  read -ra words <<<"$line"
  if [[ ${#words[@]} -le 1 || (${#words[@]} == 2 && -n $word) ]]; then
    command_list | cut -d: -f1
    return
  fi
  case ${words[1]} in
    run | tutorial) file=live.launch && echo person:= ;;
    glossary | calibrate) file=lesson.launch && echo person:= ;;
    replay) file=replay.launch ;;
    watch) printf '%s\n' speech:= pace:= port:= ;;
    build) printf '%s\n' --asan --odr ;;
    test) echo --asan ;;
    parameters) echo --csv ;;
    world) printf '%s\n' list check show write map && world_names ;;
    help) command_list | cut -d: -f1 ;;
  esac
  echo --help
  case ${words[1]} in
    replay | check | watch) compgen -G "${trials#"$PWD"/}/trial-*" || true ;;
  esac
  [[ -v file ]] || return 0
  name=${word%%:=*}
  case $word in
    world:=*) world_names | sed 's/^/world:=/' ;;
    *:=*) [[ ! -v allowed[$name] ]] || sed "s/[^ ]*/$name:=&/g; s/ /\n/g" <<<"${allowed[$name]}" ;;
    *) argument_names "$launch_files/$file" | sed 's/$/:=/' ;;
  esac
}
world_names() { "$(program navvi_sim world_tool)" list 2>/dev/null | cut -d' ' -f1; }
