#!/bin/sh
# parallel_test.sh BIN SOURCE: a data set by GNU parallel, one task killed, and by tasks as Kubernetes numbers them, against
# one machine alone. 77: there is no GNU parallel.
set -eu
bin=$1 source=$2
# shellcheck source=tests/apps/cluster/small_recipe.sh
. "$(dirname "$0")/small_recipe.sh"
if ! parallel --version 2>/dev/null | grep -q '^GNU parallel'; then
  echo "skipped: no GNU parallel (packages of the group cluster)"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
wrong() {
  echo "wrong: $*"
  exit 1
}
small_recipe "$source" 6 >recipe.toml
"$bin/swell-dataset" --recipe recipe.toml --out alone

# The first time that it draws part 2 it is killed.
mkdir once
cat >once/swell-dataset <<PROGRAM
#!/bin/sh
case "\$*" in *"--shard 2/4"*) mkdir $work/killed 2>/dev/null && kill -KILL \$\$ ;; esac
exec "$bin/swell-dataset" "\$@"
PROGRAM
chmod +x once/swell-dataset
command="state 4 once/swell-dataset --recipe recipe.toml --out by_parallel --threads 1"
# shellcheck disable=SC2086 # words
seq 0 3 | HOME=$work parallel --retries 3 --joblog log -j 2 SWELL_TASK={} "$source/scripts/cluster/task.sh" $command 2>errors ||
  wrong "$(cat errors)"
[ -d killed ] || wrong "no task was killed"
# shellcheck disable=SC2086
"$source/scripts/cluster/collect.sh" $command
diff -r alone by_parallel || wrong "the data set of GNU parallel is not that of one machine"

# What Kubernetes sets in the pods of an indexed job; no mark before a part is done.
command="pods 2 $bin/swell-dataset --recipe recipe.toml --out by_pods"
# shellcheck disable=SC2086
JOB_COMPLETION_INDEX=1 "$source/scripts/cluster/task.sh" $command
# shellcheck disable=SC2086
! "$source/scripts/cluster/collect.sh" $command 2>line || wrong "half a data set is collected"
grep -q "not done: 0" line || wrong "the missing task is not named: $(cat line)"
# shellcheck disable=SC2086
JOB_COMPLETION_INDEX=0 "$source/scripts/cluster/task.sh" $command
# shellcheck disable=SC2086
"$source/scripts/cluster/collect.sh" $command
diff -r alone by_pods || wrong "the data set of pods is not that of one machine"

# What is wrong with a command is one line.
refused() {
  if SWELL_TASK=0 "$source/scripts/cluster/task.sh" "$@" 2>line; then wrong "taken: $*"; fi
  [ "$(wc -l <line)" -eq 1 ] || wrong "not one line: $(cat line)"
}
refused
refused state 0 "$bin/swell-dataset" --recipe recipe.toml --out x
refused state 4 "$bin/swell-dataset" --recipe recipe.toml
refused state 4 "$bin/swell-dataset" --recipe recipe.toml --out x --shard 0/2
refused state 4 "$bin/swell-render" --scene s.toml --out 'f_%d.png'
refused state 4 "$bin/swell-render" --scene s.toml --frames 0-3 --out 'f_%d.png' --stream y4m
refused state 4 "$bin/swell-bench" --frames 0-3 --out x
echo "GNU parallel and numbered pods: the same bytes as one machine"
