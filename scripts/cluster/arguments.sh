# What the scripts for clusters read from the arguments of swell-dataset and swell-render. To be sourced.

fail() {
  echo "error: $*" >&2
  exit 2
}

# value_of OPTION ARGUMENTS: the option's value; nothing where it is not given.
value_of() {
  wanted=$1
  shift
  while [ $# -gt 0 ]; do
    case $1 in
      "$wanted") printf '%s\n' "${2-}" && return ;;
      "$wanted"=*) printf '%s\n' "${1#*=}" && return ;;
    esac
    shift
  done
}

# check_arguments STATE TASKS PROGRAM ARGUMENTS
check_arguments() {
  [ $# -ge 4 ] || fail "arguments, got $#, allowed STATE TASKS swell-dataset|swell-render ARGUMENTS"
  case $2 in
    '' | *[!0-9]* | 0*) fail "TASKS, got '$2', allowed 1, 2, ..." ;;
  esac
  tasks=$2 program=$(basename "$3")
  shift 3
  [ -n "$(value_of --out "$@")" ] || fail "--out, got none, allowed the place of the files"
  case $program in
    swell-dataset)
      [ -z "$(value_of --shard "$@")" ] || fail "--shard, got one, allowed none: each task has its own" ;;
    swell-render)
      case $(value_of --frames "$@") in
        [0-9]*-[0-9]*) ;;
        *) fail "--frames, got '$(value_of --frames "$@")', allowed A-B" ;;
      esac
      for option in --stream --json --expect; do
        [ -z "$(value_of $option "$@")" ] || fail "$option, got one, allowed only without tasks"
      done ;;
    *) fail "program, got '$program', allowed swell-dataset or swell-render" ;;
  esac
}

# check_recipe STATE TASKS PROGRAM ARGUMENTS: ends where the recipe of a data set cannot be drawn, with swell-dataset's line.
# Where the program cannot run at all, as on some login nodes, the tasks will tell.
check_recipe() {
  shift 2
  [ "$(basename "$1")" = swell-dataset ] || return 0
  code=0
  "$@" --quiet --try || code=$?
  [ "$code" -ne 2 ] || exit 2
}

# logs_of STATE MISSING: the logs of tasks with commas, or of the collecting where none is missing.
logs_of() {
  [ -n "$2" ] || { printf '%s\n' "$1/log/collect.txt" && return; }
  printf '%s\n' "$2" | tr ',' '\n' | sed "s|.*|$1/log/task_&.txt|" | head -n 5
}

# missing_tasks STATE TASKS: those that are not done, with commas.
missing_tasks() {
  missing="" task=0
  while [ "$task" -lt "$2" ]; do
    [ -e "$1/done/$task" ] || missing=$missing${missing:+,}$task
    task=$((task + 1))
  done
  printf '%s\n' "$missing"
}

# files_of_frame FRAME ARGUMENTS: what swell-render has written of a frame, one a line.
files_of_frame() {
  frame=$1
  shift
  for option in --out --labels-out --depth --ids; do
    pattern=$(value_of $option "$@")
    [ -n "$pattern" ] || continue
    # shellcheck disable=SC2059 # the pattern has the place of the number
    file=$(printf "$pattern" "$frame")
    for beside in "${file%.*}".*; do  # f_0003.png: also f_0003.labels.exr, f_0003.labels.json
      [ ! -e "$beside" ] || printf '%s\n' "$beside"
    done
  done | sort -u
}
