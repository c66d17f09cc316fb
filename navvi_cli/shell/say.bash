# What a person reads: plain lines, without colour, and none is written over.

say() { echo "navvi: $1"; }
aside() { echo "navvi: $1" >&2; }  # what is not the command's result

# fail SENTENCE [EXIT_CODE]: what is wrong, where, and what to do, in one line.
fail() {
  echo "navvi: $1" >&2
  exit "${2:-1}"
}

# stopped [SIGNAL]: Ctrl-C by default. Nothing of the work is left behind.
job="" sleeper=""
stopped() {
  [[ -z $sleeper ]] || kill "$sleeper" 2>/dev/null || true
  # As root where that works: as_root is install_packages's.
  [[ -z $job ]] || "${as_root[@]+"${as_root[@]}"}" bash -c "kill -TERM -- -$job" 2>/dev/null || true
  echo "navvi: stopped by ${1:-Ctrl-C}, before it was done. The same command goes on from here." >&2
  exit 130
}
stopped_by_signals() {
  trap stopped INT
  trap 'stopped "a signal"' TERM HUP
}

in_words() {  # seconds
  if (($1 < 100)); then echo "$1 seconds"; else echo "$((($1 + 30) / 60)) minutes"; fi
}

# with_progress WHAT LOG PERCENT COMMAND...: runs the command with all it says in the file LOG. Every 10 s a line tells how
# long it has run and how much is done, by what the function PERCENT makes of the log. Steps differ too much in length for an
# estimate of the time left.
with_progress() {
  local what=$1 log=$2 percent=$3 begin=$SECONDS status=0 share
  shift 3
  set -m  # a process group of its own, which Ctrl-C ends as a whole
  "$@" >"$log" 2>&1 </dev/null &
  job=$!
  set +m
  while
    sleep 10 >/dev/null 2>&1 &
    sleeper=$!
    wait -n "$job" "$sleeper" || true
    kill -0 "$job" 2>/dev/null
  do
    share=$("$percent" "$log")
    ((${share:-0} > 0 && share < 100)) && share="$share percent done, " || share=""
    aside "$what: $share$(in_words $((SECONDS - begin))) so far."
  done
  kill "$sleeper" 2>/dev/null || true
  wait "$job" || status=$?
  job="" sleeper=""
  return "$status"
}
