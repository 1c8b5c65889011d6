#!/bin/sh
# Builds swell-render for AVX2 with each compiler and prints its warnings and the hashes of four pictures, and of their
# labels: they must be those of the release build. Ends with 1 if a compiler warns or draws something else. Ten minutes
# for a compiler on two cores. Needs root, mmdebstrap and build/release/bin.
#   scripts/compilers.sh [COMPILER ...]   default: all
# COMPILER: clang++-16 here; g++-14, clang++-17, clang++-18, clang++-19 in a root of Debian 13, build/debian13.
set -eu
cd "$(dirname "$0")/.."
all="clang++-16 g++-14 clang++-17 clang++-18 clang++-19"
# shellcheck disable=SC2086 # a list of words
[ $# -gt 0 ] || set -- $all
for compiler in "$@"; do
  case " $all " in *" $compiler "*) ;; *) echo "error: compiler, got '$compiler', allowed $all" >&2 && exit 2 ;; esac
done
release=build/release/bin/swell-render
[ -x $release ] || { echo "error: $release, got none, allowed one" >&2; exit 2; }

here() { "$@"; }
there() { inside sh -c 'cd /swell && exec "$@"' sh "$@"; }
case $* in *clang++-16*) scripts/setup.sh clang >&2 ;; esac
if [ "$*" != clang++-16 ]; then
  # shellcheck source=scripts/debian_root.sh
  . scripts/debian_root.sh
  make_root build/debian13 trixie "$(dpkg --print-architecture)"
  copy_tree
  there scripts/setup.sh compilers >&2
fi

# build COMPILER: as far as it goes.
# shellcheck disable=SC2016 # the inner shell's variables
build='cmake --preset release -B build/compilers/$0 -DCMAKE_CXX_COMPILER=$0 -DSWELL_SIMD=avx2 -DSWELL_BUILD_TESTS=OFF &&
  cmake --build build/compilers/$0 --target swell-render -- -k 0'
# draw PROGRAM: the hashes of pictures, and one of all labels: 54 rows of 96 pixels, without what EXR has before them.
# shellcheck disable=SC2016
draw='files=$(mktemp -d) && for scene in open_ocean lagoon river everything; do
    $0 --scene scenes/$scene.toml --size 96x54 --hash --out $files/picture.png --labels all --exr-compression none \
      --labels-out $files/$scene.exr | cut -d" " -f4
    tail -c $((54 * (8 + 96 * 72))) $files/$scene.exr >>$files/labels
  done && sha256sum <$files/labels | cut -c1-16 && rm -r $files'

# row NAME WARNINGS HASHES
row() {
  # shellcheck disable=SC2086 # a list of words
  printf '%-10s %8s  %-16s %-16s %-16s %-16s %-16s\n' "$1" "$2" $3
}
row compiler warnings "open_ocean lagoon river everything labels"
expected=$(here sh -c "$draw" $release)
row release 0 "$expected"
differ=0
mkdir -p build/compilers
for compiler in "$@"; do
  place=there
  [ "$compiler" != clang++-16 ] || place=here
  log=build/compilers/$compiler.log
  $place sh -c "$build" "$compiler" >"$log" 2>&1 || echo "$compiler: error: it does not build" >>"$log"
  warnings=$(grep -cE ': (fatal )?(error|warning): ' "$log" || true)
  hashes=$($place sh -c "$draw" "build/compilers/$compiler/bin/swell-render" 2>>"$log") || hashes="none"
  row "$compiler" "$warnings" "$hashes"
  [ "$warnings$hashes" = "0$expected" ] || { differ=1; echo "note: $log has what it said"; }
done
exit $differ
