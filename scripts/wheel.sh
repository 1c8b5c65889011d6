#!/bin/sh
# Writes the Python package as a wheel into out/, for machines without a compiler: pip install out/swell-*.whl
#   scripts/wheel.sh [BUILD]   a build folder that is configured; default build/release, which is made
set -eu
cd "$(dirname "$0")/.."

scripts/setup.sh python release
build=${1:-build/release}
[ $# -gt 0 ] || cmake --preset release
cmake --build "$build" --target swell_package
exec python3 -B scripts/write_wheel.py "$build" out
