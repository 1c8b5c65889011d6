#!/bin/sh
# submit_test.sh BIN SOURCE: what submit.sh queues and refuses, and what after.sh says of failures. A stub stands for sbatch.
set -eu
bin=$1 source=$2
# shellcheck source=tests/apps/cluster/small_recipe.sh
. "$(dirname "$0")/small_recipe.sh"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
wrong() {
  echo "wrong: $*"
  exit 1
}
mkdir stub
cat >stub/sbatch <<STUB
#!/bin/sh
echo "\$*" >>$work/queued
echo 7
STUB
chmod +x stub/sbatch
PATH=$work/stub:$PATH
submit=$source/scripts/slurm/submit.sh

# A recipe with a typo is not queued.
small_recipe "$source" 2 | sed 's/number = /numbre = /' >typo.toml
code=0
"$submit" state 2 "$bin/swell-dataset" --recipe typo.toml --out out >said 2>line || code=$?
[ "$code" -eq 2 ] || wrong "code $code for a recipe with a typo"
[ "$(wc -l <line)" -eq 1 ] || wrong "not one line: $(cat line)"
grep -q "typo.toml:.*number" line || wrong "the typo is not named: $(cat line)"
[ ! -e queued ] || wrong "a recipe with a typo is queued"
[ ! -e out ] && [ ! -e state ] || wrong "a folder is made for a recipe with a typo"

# A right one is, and its failure names the logs.
small_recipe "$source" 2 >recipe.toml
"$submit" state 2 "$bin/swell-dataset" --recipe recipe.toml --out out >said
[ "$(wc -l <queued)" -eq 2 ] || wrong "not two jobs: $(cat queued)"
# While it is written it is not there yet.
cat >stub/sed <<PROGRAM
#!/bin/sh
sleep 0.2
[ ! -e state/failed ] || touch early
exec $(command -v sed) "\$@"
PROGRAM
chmod +x stub/sed
! "$source/scripts/slurm/after.sh" 3 3 state 2 "$bin/swell-dataset" --recipe recipe.toml --out out >said || wrong "complete"
[ ! -e early ] || wrong "STATE/failed is there before it is whole"
grep -q "not done: 0,1" state/failed || wrong "the tasks are not named: $(cat state/failed)"
grep -q "^log: state/log/task_1.txt" state/failed || wrong "the log is not named: $(cat state/failed)"
echo "submit.sh tries a recipe, and STATE/failed names the logs"
