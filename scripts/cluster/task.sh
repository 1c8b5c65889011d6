#!/bin/sh
# Draws one part of a data set or a sequence, as a task of any scheduler:
#   scripts/cluster/task.sh STATE TASKS swell-dataset|swell-render ARGUMENTS
# STATE is a folder for what the tasks have to say to each other; the number of the part, from 0 on, comes from the
# scheduler (Slurm, Kubernetes) or from SWELL_TASK. What an earlier try has drawn is kept; once all is drawn, and not before, there
# is STATE/done/NUMBER, with the hashes of a sequence's files.
set -eu
# shellcheck source=scripts/cluster/arguments.sh
. "$(dirname "$0")/arguments.sh"
check_arguments "$@"
state=$1 tasks=$2 run=$3
shift 3
task=${SWELL_TASK:-${SLURM_ARRAY_TASK_ID:-${JOB_COMPLETION_INDEX:-}}}
case $task in
  '' | *[!0-9]*) fail "number of the task, got '$task', allowed 0 to $((tasks - 1)) in SWELL_TASK" ;;
esac
[ "$task" -lt "$tasks" ] || fail "number of the task, got $task, allowed 0 to $((tasks - 1))"
mkdir -p "$state/done"
marks=$state/done/.$task.$$
trap 'rm -f "$marks"' EXIT

# A dispatcher may give less than the machine has.
threads=${SLURM_CPUS_PER_TASK:-}
[ -z "$threads" ] || [ -n "$(value_of --threads "$@")" ] || set -- "$@" --threads "$threads"

if [ "$(basename "$run")" = swell-dataset ]; then
  "$run" "$@" --quiet --shard "$task/$tasks"
  : >"$marks"
else
  frames=$(value_of --frames "$@")
  every=$(value_of --every "$@")
  every=${every:-1}
  first=$((${frames%-*} + task * every)) last=${frames#*-} step=$((every * tasks))
  # The options again without those of the frames.
  given=$#
  while [ "$given" -gt 0 ]; do
    case $1 in
      --frames | --every) shift && given=$((given - 1)) ;;
      --frames=* | --every=* | --quiet | --skip-existing) ;;
      *) set -- "$@" "$1" ;;
    esac
    shift
    given=$((given - 1))
  done
  [ "$first" -gt "$last" ] ||
    "$run" "$@" --quiet --skip-existing --frames "$first-$last" --every "$step"
  frame=$first
  while [ "$frame" -le "$last" ]; do
    files_of_frame "$frame" "$@"
    frame=$((frame + step))
  done | tr '\n' '\0' | xargs -0r sha256sum >"$marks"
fi
mv "$marks" "$state/done/$task"
