navvi_calibrate() {
  local word
  for word in "$@"; do [[ $word != person:=?* ]] || give_lesson calibrate "$@" && return; done
  fail "whose settings are these? person:=NAME is needed, such as person:=anna." 2
}
