#!/bin/sh
# slurm_test.sh BIN SOURCE: a data set and a sequence on a Slurm of one node, one task killed, against one machine alone.
# 77: there is no Slurm.
set -eu
bin=$1 source=$2
# shellcheck source=tests/apps/cluster/small_recipe.sh
. "$(dirname "$0")/small_recipe.sh"
PATH=$PATH:/usr/sbin:/sbin
for tool in slurmctld slurmd sbatch munged; do
  command -v $tool >/dev/null || { echo "skipped: no $tool (packages of the group cluster)"; exit 77; }
done
# shellcheck source=tests/apps/cluster/one_node_slurm.sh
. "$(dirname "$0")/one_node_slurm.sh"
work=$(mktemp -d)
trap 'stop_slurm; rm -rf "$work"' EXIT
wrong() {
  echo "wrong: $*"
  tail -n 20 "$work"/*/log/*.txt "$work"/slurm/*.log 2>/dev/null || true
  exit 1
}
start_slurm "$work/slurm" 4 || wrong "Slurm does not start"
submit=$source/scripts/slurm/submit.sh
cd "$work"

# wait_for COMMAND: until it succeeds, at most a minute.
wait_for() {
  for _ in $(seq 600); do
    "$@" && return
    sleep 0.1
  done
  wrong "waited a minute for $*"
}
ended() { [ -e "$1/complete" ] || [ -e "$1/failed" ]; }

# ---- A data set in four tasks, one of which is killed half-way.
small_recipe "$source" 12 >recipe.toml
"$bin/swell-dataset" --recipe recipe.toml --out alone

# The first time that it draws part 2 it stops, and waits to be killed.
mkdir once
cat >once/swell-dataset <<PROGRAM
#!/bin/sh
case "\$*" in *"--shard 2/4"*)
  if [ ! -e $work/stopped ]; then
    "$bin/swell-dataset" "\$@" &
    while [ ! -e $work/cluster/records/000002.json ]; do sleep 0.01; done
    kill -STOP \$!
    echo "\$SLURM_ARRAY_JOB_ID" >$work/stopped.part
    mv $work/stopped.part $work/stopped
    wait
  fi ;;
esac
exec "$bin/swell-dataset" "\$@"
PROGRAM
chmod +x once/swell-dataset
SWELL_TRIES=2 "$submit" state 4 once/swell-dataset --recipe recipe.toml --out cluster --threads 1
wait_for test -e stopped
array=$(cat stopped)
scancel --signal=KILL --full "${array}_2"
wait_for ended state
[ -e state/complete ] || wrong "$(cat state/failed)"
diff -r alone cluster || wrong "the data set of the cluster is not that of one machine"
grep -q "the tasks 2 failed" state/log/collect.txt || wrong "task 2 was not submitted again"
finished() { [ "$(wc -l <slurm/jobs.txt)" -ge 7 ]; }
wait_for finished  # four tasks, one once more, two that collect
echo "Slurm's record of its jobs:"
sed -E 's/ (UserId|GroupId|WorkDir|Partition|TimeLimit|Reservation|NodeList|Tres|Account|QOS|WcKey|Cluster|DerivedExitCode)[^ ]*//g' \
  slurm/jobs.txt | sed -E 's/ +/ /g'
[ "$(grep -c 'Name=swell .*JobState=COMPLETED' slurm/jobs.txt)" -eq 4 ] || wrong "not four tasks completed"
[ "$(grep -c 'Name=swell .*JobState=\(FAILED\|CANCELLED\)' slurm/jobs.txt)" -eq 1 ] || wrong "not one task was killed"

# ---- A sequence in three tasks, of which one draws a frame less.
sequence() { echo "--scene $source/scenes/sea_state_3.toml --size 64x36 --frames 2-12 --every 2 --labels depth --out $1/f_%04d.png"; }
mkdir a b
# shellcheck disable=SC2046 # words
"$bin/swell-render" $(sequence a)
rm b/* 2>/dev/null || true
# shellcheck disable=SC2046
"$submit" frames 4 "$bin/swell-render" $(sequence b)
wait_for ended frames
[ -e frames/complete ] || wrong "$(cat frames/failed)"
diff -r a b || wrong "the sequence of the cluster is not that of one machine"
[ "$(wc -l <frames/manifest.sha256)" -eq 18 ] || wrong "the manifest does not have six frames with their labels"
sha256sum --check --quiet frames/manifest.sha256
# The same command again draws nothing; what another program changed is seen.
touch -d 2001-01-01 b/f_0004.png
echo >>b/f_0006.png
# shellcheck disable=SC2046
"$submit" frames 4 "$bin/swell-render" $(sequence b)
wait_for ended frames
grep -q f_0006.png frames/failed || wrong "a changed file is not noticed"
[ "$(date -r b/f_0004.png +%Y)" = 2001 ] || wrong "a frame was drawn twice"

# ---- What never works ends, with the reason.
# shellcheck disable=SC2046
SWELL_TRIES=2 "$submit" bad 2 "$bin/swell-render" $(sequence b) --set wind.speed_mps=-1
wait_for ended bad
grep -q "not done: 0,1" bad/failed || wrong "tasks that fail are not named: $(cat bad/failed)"
grep -q "allowed 0 to" bad/log/task_0.txt || wrong "the reason is not in the log"
grep -q "^log: bad/log/task_0.txt" bad/failed || wrong "the log is not named: $(cat bad/failed)"
! "$submit" bad 2 "$bin/swell-render" $(sequence b) 2>line || wrong "a folder of another command is taken"
[ "$(wc -l <line)" -eq 1 ] || wrong "not one line: $(cat line)"
echo "Slurm: the same bytes as one machine"
