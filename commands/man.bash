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
