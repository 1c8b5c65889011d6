#!/bin/sh
# Builds Swell on a fresh Debian 12 and runs its tests: all but the slow ones, or what the arguments
# say, which go to ctest (-R NAME, -L slow for the others, ...).
set -eu
cd "$(dirname "$0")/.."

scripts/setup.sh viewer tests python gazebo film browser cluster docs release
cmake --preset release
cmake --build --preset release
[ $# -gt 0 ] || set -- -LE slow
ctest --preset release --no-tests=error "$@" </dev/null
