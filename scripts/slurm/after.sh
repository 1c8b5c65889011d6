#!/bin/sh
# after.sh TRY TRIES STATE TASKS PROGRAM ARGUMENTS: the job that follows an array of submit.sh. Submits again what failed,
# or collects.
set -eu
scripts=$(cd "$(dirname "$0")/.." && pwd)
# shellcheck source=scripts/cluster/arguments.sh
. "$scripts/cluster/arguments.sh"
try=$1 tries=$2
shift 2
state=$1
# say NAME: the input into STATE/NAME, which is there only whole: who waits for it reads it at once.
say() {
  tee "$state/$1.part"
  mv "$state/$1.part" "$state/$1"
}
missing=$(missing_tasks "$1" "$2")
if [ -n "$missing" ] && [ "$try" -lt "$tries" ]; then
  echo "try $try: the tasks $missing failed"
  SWELL_TRY=$((try + 1)) SWELL_TRIES=$tries "$scripts/slurm/submit.sh" "$@"
elif reason=$("$scripts/cluster/collect.sh" "$@" 2>&1); then
  echo complete | say complete
else
  { echo "$reason" && logs_of "$1" "$missing" | sed 's/^/log: /'; } | say failed
  exit 1
fi
