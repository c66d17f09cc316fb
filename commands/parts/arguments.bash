# Words such as seed:=7 of a command, checked against what a launch file takes.

declare -A arg
parameters=()
declare -A allowed=(
  [operator]="auto pad keyboard simulated" [speech]="auto true false" [profile]="default paper" [once]="true false" [lesson]="none tutorial" [rviz]="auto true false"
  [sensing]="truth lidar robot" [vision]="high_contrast yellow_on_black large color_blind paper" [view]="chase top forward"
)

# The names that a launch file takes from a person; some are set here, so that the record tells the truth.
argument_names() { sed -n 's/.*<arg name="\([a-z_]*\)".* doc=.*/\1/p' "$1" | grep -vx -e '.*parameters' -e version -e bag | sort; }

# Parameters such as sim/seed that a launch file, or one that it includes, gives to a node as <param>: these win.
fixed_parameters() {  # FILE
  local files
  # shellcheck disable=SC2016  # of roslaunch
  readarray -t files < <(sed -n 's/.*<include .*file="$(dirname)\/\([a-z]*\.launch\)".*/\1/p' "$1")
  files=("$1" "${files[@]/#/$launch_files/}")
  # shellcheck disable=SC2016  # of awk
  awk '
    /<node / { part = ""; if (match($0, /name="[a-z]*_node"/)) part = substr($0, RSTART + 6, RLENGTH - 12) }
    /<\/node>/ { part = "" }
    part != "" && match($0, /<param name="[^"]*"/) { print part "/" substr($0, RSTART + 13, RLENGTH - 14) }' "${files[@]}"
}

# read_args FILE WORD...: turns name:=value words into a variable each in `arg`, and words such as
# feedback/haptics/enabled:=false, parameters of nodes, into words in `parameters`; refuses names that the launch file lacks.
read_args() {
  local word name known parts fixed
  known=$(argument_names "$1")
  fixed=$(fixed_parameters "$1")
  parts=$(sed -n 's/.*<arg name="\([a-z]*\)_parameters".*/\1/p' "$1" | sort -u)
  shift
  for word in "$@"; do
    name=${word%%:=*}
    [[ $word == *:=* ]] || fail "\"$word\" is no argument; arguments look like name:=value." 2
    # shellcheck disable=SC2016  # roslaunch would put in what stands between such brackets
    [[ $word != *'$('* ]] || fail "\"$word\" holds \"\$(\"; allowed are values without it." 2
    if [[ $name == */* ]]; then
      grep -qxF -e "${name%%/*}" <<<"$parts" ||
        fail "\"${name%%/*}\" has no parameters here; those of ${parts//$'\n'/ } can be given." 2
      if grep -qxF -e "$name" <<<"$fixed"; then
        grep -qxF -e "${name##*/}" <<<"$known" ||
          fail "\"$name\" cannot be given: the session itself sets it." 2
        fail "\"$name\" would have no effect; allowed is ${name##*/}:=${word#*:=}." 2
      fi
      parameters+=("$word")
      continue
    fi
    grep -qxF -e "$name" <<<"$known" || fail "\"$name\" is unknown; known are: ${known//$'\n'/ }" 2
    [[ ! -v arg[$name] ]] || fail "\"$name\" is given twice; once is allowed." 2
    arg[$name]=${word#*:=}
  done
}

# Checks `parameters` as the nodes would, and hands each node its own as YAML.
check_parameters() {
  local -A by_part=()
  local word part node own
  for word in "${parameters[@]}"; do by_part[${word%%/*}]+=${word#*/}$'\n'; done
  for part in "${!by_part[@]}"; do
    node=$(echo "$devel"/lib/navvi_*/"${part}_node")
    readarray -t own <<<"${by_part[$part]%$'\n'}"
    arg[${part}_parameters]=$("$node" --parameters "${own[@]}") || exit 2
  done
  arg[parameters]="${parameters[*]//:=/=}"  # roslaunch ignores a value with := in it
  arg[version]=$(sed -n 's/.*<version>\(.*\)<.*/\1/p' "$(share navvi_study)/package.xml")
  arg[version]+=$(git -C "$root" describe --always --dirty --abbrev=12 --exclude='*' 2>/dev/null | sed 's/^/+/' || true)
}

one_of() {  # NAME...
  local name
  for name in "$@"; do
    [[ " ${allowed[$name]} " == *" ${arg[$name]} "* && ${arg[$name]} != *" "* ]] ||
      fail "$name:=${arg[$name]} is not allowed; allowed are: ${allowed[$name]}" 2
  done
}
number() {  # NAME
  [[ ! -v arg[$1] || ${arg[$1]} =~ ^[0-9]+(\.[0-9]+)?$ ]] || fail "$1:=${arg[$1]} is not allowed; allowed are numbers, 0 or more." 2
}

# trial_folder WORD...: sets `trial` to the folder that the first word names.
trial_folder() {
  (($# > 0)) || fail "which trial? Name its folder, such as trials/trial-20260101T120000." 2
  trial=$(readlink -m -- "$1")
  [[ -f $trial/trial.bag ]] || fail "$1 holds no trial.bag; a trial's folder is allowed." 2
}
