#!/bin/sh
# Runs fuzz targets under the sanitizers and says how many inputs each has tried.
#   scripts/fuzz.sh TARGET|all SECONDS [AT_ONCE]
# TARGET: the name of a tests/fuzz/TARGET_fuzz.cpp; SECONDS: how long each one runs; AT_ONCE: how many run beside each
# other, 1 unless given. What is learnt stays in
# build/fuzz/corpus/TARGET for the next time. Ends with 1 if an input was found that a target fails at; it lies
# in build/fuzz/findings then: mend the fault and put the input into tests/fuzz/corpus/TARGET.
set -eu
cd "$(dirname "$0")/.."
if [ $# -lt 2 ] || [ $# -gt 3 ]; then
  echo "usage: scripts/fuzz.sh TARGET|all SECONDS [AT_ONCE]" >&2
  exit 2
fi
seconds=$2
at_once=${3:-1}

targets=""
for source in tests/fuzz/*_fuzz.cpp; do
  name=$(basename "$source" _fuzz.cpp)
  [ "$1" != all ] && [ "$1" != "$name" ] || targets="$targets $name"
done
if [ -z "$targets" ]; then
  echo "error: target, got '$1', allowed all or$(ls tests/fuzz | sed -n 's/_fuzz.cpp$//p' | tr '\n' ' ' | sed 's/^/ /')" >&2
  exit 2
fi

scripts/setup.sh viewer tests clang
cmake --preset fuzz >/dev/null
# shellcheck disable=SC2086 # a list of words
cmake --build --preset fuzz --target fuzz_dictionary $(printf ' fuzz_%s' $targets) >&2
mkdir -p build/fuzz/findings
build/fuzz/bin/fuzz_dictionary >build/fuzz/scene.dict

# The longest input of a target, in bytes.
most_bytes() {
  case $1 in
    scene | recipe | form | rig) echo 4096 ;;
    c_calls) echo 1024 ;;
    *) echo 16384 ;;
  esac
}

# The most that it may ask for at once. OpenEXR asks for a line of blocks of the size that a file
# claims before anybody can look at the claim: 2 GB. Assimp believes a GLB's chunk of 4 GB; the importer's
# process has a limit of its own.
most_megabytes() {
  case $1 in
    image | height_map | wave_map) echo 2560 ;;
    mesh) echo 8192 ;;
    *) echo 1024 ;;
  esac
}

# Files of ours that are inputs of a target too.
examples() {
  case $1 in
    scene) echo scenes tests/scenes ;;
    form) echo scenes/forms ;;
    rig) echo scenes/rigs ;;
  esac
}

# stat NAME LOG: a number of libFuzzer's last lines.
stat() { sed -n "s/^stat::$1: *//p" "$2"; }

# fuzz TARGET: one line; false if there is a finding.
fuzz() {
  corpus=build/fuzz/corpus/$1
  log=build/fuzz/findings/$1.log
  mkdir -p "$corpus"
  status=0
  # Memory and time are far over what an input of this size may take; so is time where targets share processors.
  # shellcheck disable=SC2046 # a list of words
  UBSAN_OPTIONS=print_stacktrace=1 build/fuzz/bin/fuzz_"$1" "$corpus" "tests/fuzz/corpus/$1" $(examples "$1") \
    -max_total_time="$seconds" -max_len="$(most_bytes "$1")" -timeout=$((60 * at_once)) -rss_limit_mb=8192 \
    -malloc_limit_mb="$(most_megabytes "$1")" -dict=build/fuzz/scene.dict -artifact_prefix="build/fuzz/findings/$1-" \
    -print_final_stats=1 -close_fd_mask=1 >"$log" 2>&1 || status=$?
  runs=$(stat number_of_executed_units "$log")
  if [ $status -ne 0 ]; then
    echo "$1: a finding after ${runs:-no} executions:"
    grep -E 'ERROR: |runtime error|^finding|what\(\)|Test unit written' "$log" | sed 's/^/  /'
    echo "  all of it: $log"
    return 1
  fi
  echo "$1: $runs executions in $seconds s, $(stat average_exec_per_sec "$log") a second, no finding"
}

running=""
failed=0
# wait_for_all: until what runs has ended.
wait_for_all() {
  for process in $running; do wait "$process" || failed=1; done
  running=""
}
for target in $targets; do
  fuzz "$target" &
  running="$running $!"
  [ "$(echo "$running" | wc -w)" -lt "$at_once" ] || wait_for_all
done
wait_for_all
exit $failed
