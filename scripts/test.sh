#!/bin/sh
# Builds Swell on a fresh Debian 12 and runs every test. Arguments go to ctest (-R NAME, ...).
set -eu
cd "$(dirname "$0")/.."

scripts/setup.sh
cmake --preset release
cmake --build --preset release
ctest --preset release --no-tests=error "$@" </dev/null
