#!/bin/sh
# Collects what the tasks of task.sh have drawn, with the same arguments, and checks it:
#   scripts/cluster/collect.sh STATE TASKS swell-dataset|swell-render ARGUMENTS
# A data set gets its annotations, contact sheet and manifest; of a sequence there is STATE/manifest.sha256. Fails if a task is
# not done, or a file is not what its task wrote.
set -eu
# shellcheck source=scripts/cluster/arguments.sh
. "$(dirname "$0")/arguments.sh"
check_arguments "$@"
state=$1 tasks=$2 run=$3
shift 3
missing=$(missing_tasks "$state" "$tasks")
[ -z "$missing" ] || { echo "error: $state: tasks that are not done: $missing" >&2; exit 1; }
if [ "$(basename "$run")" = swell-dataset ]; then
  "$run" "$@" --quiet --shard "0/$tasks"  # all samples are there: this one writes the rest
  "$run" "$@" --check
else
  task=0
  while [ "$task" -lt "$tasks" ]; do
    cat "$state/done/$task"
    task=$((task + 1))
  done | LC_ALL=C sort -k 2 >"$state/manifest.part"
  [ -s "$state/manifest.part" ] || { echo "error: $state: no frames" >&2; exit 1; }
  sha256sum --check --quiet "$state/manifest.part"
  mv "$state/manifest.part" "$state/manifest.sha256"
fi
