#!/bin/sh
# Prints what the viewer's governor comes to in 3, 10 and 40 s, for four scenes in two sizes, under
# Xvfb: size of the picture, triangles, share of the budget, sharpness against full quality. For an
# idle machine; seven minutes.
#   tests/apps/view/governed_views.sh [BUILD]   default build/release
set -eu
cd "$(dirname "$0")/../../.."
build=${1:-build/release}
for scene in lagoon beach open_ocean harbour; do
  for size in "1280 720" "960 540"; do
    # shellcheck disable=SC2086 # two words
    SWELL_TEST_SCREEN=1280x720x24 tests/apps/view/run_under_xvfb.sh \
      "$build/bin/governed_view" scenes/$scene.toml $size 3 10 40
  done
done
