# The manual, made of the help texts.

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
