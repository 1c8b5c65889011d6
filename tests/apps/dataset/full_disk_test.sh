#!/bin/sh
# full_disk_test.sh BIN SOURCE: a data set and a sequence on a disk that fills up, which grows then, against a roomy one.
# 77: no disk of a test's own can be mounted.
set -eu
bin=$1 source=$2
if [ -z "${SWELL_OWN_MOUNTS:-}" ]; then
  unshare --user --map-root-user --mount true 2>/dev/null ||
    { echo "skipped: no name space of its own for mounts"; exit 77; }
  export SWELL_OWN_MOUNTS=1
  exec unshare --user --map-root-user --mount "$0" "$@"
fi
# shellcheck source=tests/apps/cluster/small_recipe.sh
. "$(dirname "$0")/../cluster/small_recipe.sh"
work=$(mktemp -d)
trap 'umount "$work/disk" 2>/dev/null || true; rm -rf "$work"' EXIT
cd "$work"
wrong() {
  echo "wrong: $*"
  exit 1
}
mkdir disk whole
mount -t tmpfs -o size=64k tmpfs disk || { echo "skipped: no tmpfs"; exit 77; }

# fills_up WHAT COMMAND: the command, with --out disk/WHAT..., ends with one line while the disk is small and leaves whole
# files alone; with more room it goes on to what is in whole/WHAT.
fills_up() {
  what=$1
  shift
  mount -o remount,size=64k disk
  if "$@" 2>line; then wrong "done on a full disk: $*"; fi
  [ "$(wc -l <line)" -eq 1 ] && grep -q '^error: .*No space left' line || wrong "not one line: $(cat line)"
  (cd "disk/$what" && find . -type f) >files
  while read -r file; do
    cmp "disk/$what/$file" "whole/$what/$file" || wrong "half a file: $file"
  done <files
  mount -o remount,size=64m disk
  "$@"
  diff -r "whole/$what" "disk/$what" || wrong "$what: not what a roomy disk has"
  rm -r "disk/$what"
}

small_recipe "$source" 4 >recipe.toml
"$bin/swell-dataset" --recipe recipe.toml --out whole/set
fills_up set "$bin/swell-dataset" --recipe recipe.toml --out disk/set

sequence="--scene $source/scenes/sea_state_3.toml --size 96x54 --frames 0-7 --labels depth --skip-existing"
mkdir whole/frames disk/frames
# shellcheck disable=SC2086 # words
"$bin/swell-render" $sequence --out whole/frames/f_%d.png
# shellcheck disable=SC2086
fills_up frames "$bin/swell-render" $sequence --out disk/frames/f_%d.png
echo "A full disk: one line each, no half file, and the same bytes once there is room"
