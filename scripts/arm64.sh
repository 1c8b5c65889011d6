#!/bin/sh
# Builds swell-render, the wheel and tests of kernels for 64-bit Arm, runs all under qemu and compares pictures and labels
# with those of the release build, bit for bit: over an hour on two cores. Goes on where it was stopped.
#   scripts/arm64.sh [SCENE ...]   names in scenes/, as lagoon; default: all
#   scripts/arm64.sh --short       two scenes, and tests of a minute: ten minutes with the build
# Needs build/release/bin/swell-render, and root or sudo for packages that are missing.
set -eu
cd "$(dirname "$0")/.."
export SWELL_CACHE=off
[ -x build/release/bin/swell-render ] || { echo "error: build/release/bin/swell-render, got none, allowed one" >&2; exit 2; }
scripts/setup.sh viewer tests arm64 release
# shellcheck source=scripts/arm64_sysroot.sh
. scripts/arm64_sysroot.sh

tests="math_test texture_test raster_test terrain_test lod_test sky_test"
# What the address checks leave out, other cases running the same code, these leave out too. The other programs of render
# draw pictures, which under qemu takes hours; what is below compares such pictures to the bit.
larger_tests="math_parallel_test ocean_open_sea_test ocean_coast_test ocean_below_test ocean_maps_test shapes_test
  scene_file_test scene_things_test render_parts_test render_lidar_test door_test sim_test"
# What qemu does not have for programs: filters of system calls, advice on memory.
without='LargeArray.AsksForHugePages:*ReplacedFile*:*AbandonedFile*:ImageFilesDeathTest.*:Workers.ThatGetTooFewThreads*'
if [ "${1:-}" = --short ]; then
  set -- ripple buoys
  tests="math_test raster_test sky_test"
  larger_tests=""
  without="$without:*TargetBits*:ElementaryExhaustive*"
fi
cmake --preset arm64
# shellcheck disable=SC2086 # a list of words
cmake --build build/arm64 --target swell-render swell_package $tests $larger_tests

# left_out TEST: the cases that its CMakeLists.txt leaves out under qemu.
left_out() {
  ctest --test-dir build/arm64 --show-only=json-v1 -R "^$1\$" | sed -n 's/.*"--gtest_filter=-\(.*\)".*/\1/p'
}
for test in $tests $larger_tests; do
  filter=$without
  case " $tests " in *" $test "*) ;; *) filter=$filter:$(left_out "$test") ;; esac
  passed=build/arm64/$test.$(echo "$filter" | cksum | cut -d' ' -f1).passed
  if [ ! -e "$passed" ] || [ -n "$(find "build/arm64/bin/$test" -newer "$passed")" ]; then
    qemu-aarch64-static -L "$root" "build/arm64/bin/$test" --gtest_brief=1 --gtest_filter="-$filter"
    touch "$passed"
  fi
done

# The wheel, by the root's Python.
SWELL_BUILD=build/arm64 SWELL_RENDER='' python3 -B tests/python/wheel_test.py Contents
wheel=$(python3 -B scripts/write_wheel.py build/arm64 build/arm64/wheel)
python3 -m zipfile -e "$wheel" build/arm64/wheel/files
drawn=$(PYTHONHOME=$root/usr PYTHONPATH=build/arm64/wheel/files:$root/usr/lib/python3/dist-packages \
  qemu-aarch64-static -L "$root" "$root/usr/bin/python3.11" -B -c \
  'import swell; print("frame 0 xxh3", swell.World("scenes/buoys.toml").render(5.0, (96, 54)).hash)')
[ "$drawn" = "$(build/release/bin/swell-render --scene scenes/buoys.toml --size 96x54 --time 5 --hash)" ]
exec python3 -B scripts/same_pictures.py "$@"
