# draw PROGRAM WORD...: runs a tool that draws; it writes SVG, of which librsvg makes the PNG that -o may ask for.
draw() {
  local words=("$@") i picture="" png="" svg status=0
  for ((i = 1; i < ${#words[@]} - 1; ++i)); do
    [[ ${words[i]} == -o ]] || continue
    picture=${words[i + 1]}
    case $picture in
      *.svg) ;;
      *.png) png=$picture svg=$(mktemp --suffix=.svg) words[i + 1]=$svg ;;
      *) fail "\"$picture\" is no picture; .svg and .png are allowed." 2 ;;
    esac
  done
  "${words[@]}" || status=$?
  if [[ -n $png ]]; then
    if [[ -s $svg ]]; then rsvg-convert -o "$png" "$svg" 2>/dev/null || status=3; fi
    rm -f "$svg"
    ((status != 3)) || fail "the picture \"$png\" cannot be written; name a place that can be." 2
  fi
  ((status != 0)) || [[ -z $picture ]] || say "the picture is in $picture."
  return "$status"
}
