#!/bin/sh
# Builds swell-render, tests and what is given out for 64-bit Arm, runs all under qemu and compares pictures and labels
# with those of the release build, bit for bit: hours on two cores. Goes on where it was stopped.
#   scripts/arm64.sh [SCENE ...]   names in scenes/, as lagoon; default: all
#   scripts/arm64.sh --short       two scenes, tests of a minute, the wheel: ten minutes with the build
# Needs the release build, of it --short bin/swell-render alone; and root, or sudo for packages that are missing.
set -eu
cd "$(dirname "$0")/.."
export SWELL_CACHE=off
[ -x build/release/bin/swell-render ] || { echo "error: build/release/bin/swell-render, got none, allowed one" >&2; exit 2; }
scripts/setup.sh viewer tests arm64 release
# shellcheck source=scripts/arm64_sysroot.sh
. scripts/arm64_sysroot.sh
# shellcheck source=scripts/debian_root.sh
. scripts/debian_root.sh

short=""
if [ "${1:-}" = --short ]; then
  short=--short
  set -- ripple buoys
else
  run_by_qemu arm64  # what tests start
fi
cmake --preset arm64
# shellcheck disable=SC2046 # a list of words
cmake --build build/arm64 --target swell-render swell_package $(python3 -B scripts/arm64_tests.py --targets $short)
python3 -B scripts/arm64_tests.py $short

# The wheel, by the root's Python.
SWELL_BUILD=build/arm64 SWELL_RENDER='' python3 -B tests/python/wheel_test.py Contents
wheel=$(python3 -B scripts/write_wheel.py build/arm64 build/arm64/wheel)
python3 -m zipfile -e "$wheel" build/arm64/wheel/files
drawn=$(PYTHONHOME=$root/usr PYTHONPATH=build/arm64/wheel/files:$root/usr/lib/python3/dist-packages \
  qemu-aarch64-static -L "$root" "$root/usr/bin/python3.11" -B -c \
  'import swell; print("frame 0 xxh3", swell.World("scenes/buoys.toml").render(5.0, (96, 54)).hash)')
[ "$drawn" = "$(build/release/bin/swell-render --scene scenes/buoys.toml --size 96x54 --time 5 --hash)" ]
python3 -B scripts/same_pictures.py "$@"

# The packages and the image, in an empty Debian.
if [ ! "$short" ]; then
  scripts/package.sh --arm64
  tests/apps/packages_root.sh "$PWD/build/release" "$PWD" "$PWD/build/packages_arm64"
  tests/apps/cluster/image_test.sh "$PWD/build/release" "$PWD" "$PWD/build/arm64"
fi
