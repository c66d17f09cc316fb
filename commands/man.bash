# The manual, made of the help texts.
navvi_man() {
  local file
  case ${1:-} in
    --write)
      [[ -n ${2:-} ]] || fail "--write needs the name of a file, such as navvi.1." 2
      manual 2>/dev/null >"$2" || fail "\"$2\" cannot be written; name a place that can be." 2
      say "the manual is in $2; man -l $2 shows it."
      ;;
    "")
      if [[ -t 1 && ${TERM:-dumb} != dumb && -z ${ACCESSIBLE:-}${NO_COLOR:-} ]] && command -v man >/dev/null; then
        man -l <(manual)
      else
        for file in help $(command_list | cut -d: -f1); do help_text "$file" && echo; done
      fi
      ;;
    *) fail "\"$1\" is no option of man; --write is allowed." 2 ;;
  esac
}

manual() {
  local command
  echo '.TH NAVVI 1 "" "NavVI" "NavVI"'
  echo '.SH NAME'
  echo 'navvi \- drive a robot through a warehouse by touch, sound and what sight there is'
  for command in help $(command_list | cut -d: -f1); do
    printf '.SH %s\n.in 0\n.nf\n' "${command^^}"
    # Every line of a help text stands for itself, also here.
    help_text "$command" | sed 's/\\/\\e/g; s/-/\\-/g; s/^\([.'\'']\)/\\\&\1/'
    echo ".fi"
  done
}
