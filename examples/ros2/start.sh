#!/bin/sh
# Builds the programs and runs the boat with its sensors: start.sh [FOLDER [SECONDS [SCENE]]]
# FOLDER (seen) gets the pictures that its camera publishes and seen.txt, for check.py; SECONDS: 10. swell-sim is the
# one in PATH, or that of the variable SWELL_SIM.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
seen=${1:-seen}
seconds=${2:-10}
scene=${3:-$here/sea.toml}

build() { cmake -S "$here" -B "$here/build" -DCMAKE_BUILD_TYPE=Release && cmake --build "$here/build"; }
said=$(build 2>&1) || { echo "$said" >&2; exit 1; }
mkdir -p "$seen"
rm -f "$seen"/picture_*.ppm

"$here/build/watch" "$seen" &
watch=$!
"${SWELL_SIM:-swell-sim}" --scene "$scene" --rig "$here/boat.toml" --dds on --clock input &
sim=$!
trap 'kill $watch $sim 2>/dev/null || true' EXIT
"$here/build/boat" "$seconds"
kill $sim
wait $sim
wait $watch
trap - EXIT
echo "$seen has $(find "$seen" -name 'picture_*.ppm' | wc -l) pictures; check.py $seen tells whether they are right"
