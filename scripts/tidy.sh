#!/bin/sh
# Reads sources with clang-tidy, by the checks of .clang-tidy, two files at a time. Ends with 1 if it finds something.
#   scripts/tidy.sh                                  all .cpp files, with the headers that they include
#   scripts/tidy.sh --changed [BASE] [--at-most N]   what differs from BASE: origin/main, or the commit before
#                                                    this one where that is not there or this; at most N files
#   scripts/tidy.sh FILE ...
# It reads them as Clang would compile them for AVX2 alone; that build is configured in build/tidy, and only made headers are built.
set -eu
cd "$(dirname "$0")/.."

most=1000000 files=""
case ${1:-} in
  --changed)
    shift
    base=origin/main
    case ${1:-} in '' | -*) ;; *) base=$1 && shift ;; esac
    if [ "${1:-}" = --at-most ]; then
      most=${2:?"--at-most: a number of files"}
      shift 2
    fi
    [ "$(git rev-parse --verify --quiet "$base^{commit}" || git rev-parse HEAD)" != "$(git rev-parse HEAD)" ] || base=HEAD~1
    start=$(git merge-base "$base" HEAD 2>/dev/null || git rev-parse HEAD)
    files=$(git diff --name-only --diff-filter=d "$start" && git ls-files --others --exclude-standard)
    [ -n "$files" ] || files=none
    ;;
  -*)
    echo "error: option, got '$1', allowed --changed" >&2
    exit 2
    ;;
  *) files="$*" ;;
esac
[ -n "$files" ] || files=$(git ls-files '*.cpp')

scripts/setup.sh viewer tests tidy
if ! command -v clang-tidy-16 >/dev/null || ! command -v clang++-16 >/dev/null; then
  echo "note: nothing is checked, for want of clang-tidy-16"
  exit 0
fi
# Each file by itself, without GCC's precompiled header, which Clang cannot read.
cmake --preset clang -B build/tidy -DSWELL_SIMD=avx2 -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DCMAKE_UNITY_BUILD=OFF >/dev/null
cmake --build build/tidy --target swell_commit >/dev/null  # a header that is made

# to_read FILES: sources that are compiled; headers as they are, but those of vector code, of tests, of boats and of
# C++'s door in a source that includes them.
to_read() {
  for file in "$@"; do
    case $file in
      *-inl.h) file=$(git grep -l --fixed-strings "#include \"$file\"" -- '*.cpp' | head -n 1) ;;
      tests/*.h | examples/ros2/*.h | examples/gazebo/*.h | *.hpp) file=$(git grep -l "#include \".*$(basename "$file")\"" -- 'tests/*.cpp' | head -n 1) ;;
    esac
    case $file in
      *.h) echo "$file" ;;
      *.cpp) ! grep -qF "\"file\": \"$PWD/$file\"" build/tidy/compile_commands.json || echo "$file" ;;
    esac
  done | sort -u
}
# shellcheck disable=SC2086 # a list of words
list=$(to_read $files)
count=$(printf '%s' "$list" | grep -c . || true)
[ "$count" -le "$most" ] || echo "note: of $count files the first $most"

# Each file's findings at once, with the paths of the sources in place of the links to them that headers are found by.
# shellcheck disable=SC2016 # the inner shell's variables
printf '%s\n' "$list" | head -n "$most" | xargs -P 2 -I FILE sh -c '
  found=$(clang-tidy-16 -p build/tidy --quiet "$1" 2>&1) && status=0 || status=1
  [ $status -eq 0 ] || printf "%s\n" "$found" | sed -E "/^[0-9]+ warnings? (generated|treated)|^Suppressed/d; s#$2/(build/tidy/include/[a-z_]+/)?##g"
  exit $status' sh FILE "$PWD" || {
  echo "clang-tidy: the findings above are to be mended, or marked by a NOLINT(CHECK) that says why" >&2
  exit 1
}
