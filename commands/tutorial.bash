# A session in the training hall. How each step went goes to the trial's folder, or beside it where there was no trial.
navvi_tutorial() {
  local word out=$trials record begin folder status=0 given=()
  for word in world:=training start:=-6.5,-5,1.57 goal:=0.2,-1; do
    [[ " $*" == *" world:="* || " $*" == *" ${word%%:=*}:="* ]] || given+=("$word")
  done
  for word in "$@"; do [[ $word != out:=* ]] || out=${word#out:=}; done
  record=$(mktemp) begin=$(mktemp)
  trap : INT
  "$root/navvi" run "${given[@]}" lesson:=tutorial "feedback/record:=$record" "$@" || status=$?
  if [[ -s $record ]]; then
    folder=$(find "$out" -name summary.csv -newer "$begin" -printf '%h\n' | sort | tail -n 1)
    word=${folder:+$folder/tutorial.csv}
    word=${word:-$out/tutorial-$(date -u +%Y%m%dT%H%M%SZ).csv}
    cat "$record" >"$word"
    tutorial_in_words "$word"
  fi
  rm -f "$record" "$begin"
  return "$status"
}

tutorial_in_words() {  # FILE
  say "how the steps of the tutorial went is in $1:"
  awk -F, 'NR > 1 {
    gsub("_", " ", $1)
    print $1 ($5 == "yes" ? ", once more" : "") ": " ($4 == "yes" ? "passed" : "not passed") ", tries " $2 ", " $3 " seconds."
  }' "$1"
}
