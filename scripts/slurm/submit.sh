#!/bin/sh
# Draws a data set or a sequence on a Slurm cluster, as a job array of TASKS tasks:
#   scripts/slurm/submit.sh STATE TASKS swell-dataset|swell-render ARGUMENTS
# STATE and the places of the files are on a disk that all nodes share. A job after the array submits again what failed, up to
# SWELL_TRIES times (3) in all, then collects and checks everything; in the end there is STATE/complete, or STATE/failed with
# the reason. SWELL_CPUS: how many CPUs a task gets. Other options of sbatch come from its environment: SBATCH_PARTITION,
# SBATCH_TIMELIMIT, ... The same command once more goes on where the last one ended.
set -eu
scripts=$(cd "$(dirname "$0")/.." && pwd)
# shellcheck source=scripts/cluster/arguments.sh
. "$scripts/cluster/arguments.sh"
check_arguments "$@"
state=$1 tasks=$2
try=${SWELL_TRY:-1}  # of after.sh

[ "$try" -gt 1 ] || check_recipe "$@"
mkdir -p "$state/done" "$state/log"
shift
printf '%s\n' "$@" >"$state/command.$$"
if [ -e "$state/command" ] && ! cmp -s "$state/command" "$state/command.$$"; then
  rm "$state/command.$$"
  fail "$state, got a folder of another command, allowed one of this command, or none"
fi
mv "$state/command.$$" "$state/command"
rm -f "$state/complete" "$state/failed"

# submit OPTIONS: the number of the job.
submit() {
  id=$(sbatch --parsable --open-mode=append ${SWELL_CPUS:+--cpus-per-task="$SWELL_CPUS"} "$@")
  printf '%s\n' "${id%%;*}"
}

dependency=""
missing=$(missing_tasks "$state" "$tasks")
if [ -n "$missing" ]; then
  array=$(submit --job-name=swell --array="$missing" --output="$state/log/task_%a.txt" \
    "$scripts/slurm/run.sh" "$scripts/cluster/task.sh" "$state" "$@")
  echo "try $try: job $array draws the tasks $missing"
  dependency=--dependency=afterany:$array
fi
# shellcheck disable=SC2086 # nothing, or one word
follower=$(submit --job-name=swell-collect $dependency --output="$state/log/collect.txt" \
  "$scripts/slurm/run.sh" "$scripts/slurm/after.sh" "$try" "${SWELL_TRIES:-3}" "$state" "$@")
echo "try $try: job $follower collects"
