#!/bin/sh
# Builds Swell on a fresh Debian 12, with its Python package (PYTHONPATH=build/release/python), and
# shows it: opens the viewer if there is a display, else draws out/open_ocean.png and measures 120
# frames against the 17 ms budget.
set -eu
cd "$(dirname "$0")/.."

scripts/setup.sh viewer python
cmake --preset release
cmake --build --preset release --target swell-render swell-bench swell-view swell-dataset swell-sim swell_package

bin=build/release/bin
scene=scenes/open_ocean.toml
if [ -n "${DISPLAY:-}" ] || [ -n "${WAYLAND_DISPLAY:-}" ]; then
  exec $bin/swell-view --scene $scene
fi
mkdir -p out
$bin/swell-render --scene $scene --size 1280x720 --out out/open_ocean.png
echo "Wrote out/open_ocean.png"
$bin/swell-bench frame --scene $scene --size 1280x720 --frames 120
