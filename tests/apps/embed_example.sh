#!/bin/sh
# Installs the build into a fresh prefix, builds examples/embed against it as a stranger would, and
# runs it. Usage: embed_example.sh CMAKE BUILD_FOLDER SOURCE_FOLDER
set -eu
cmake=$1
build=$2
source=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

"$cmake" --install "$build" --prefix "$scratch/prefix" >"$scratch/log"
# A copy, so that nothing beside the example is found by a relative path.
cp -r "$source/examples/embed" "$scratch/embed"
"$cmake" -G Ninja -S "$scratch/embed" -B "$scratch/build" -DCMAKE_PREFIX_PATH="$scratch/prefix" \
  -DCMAKE_BUILD_TYPE=Release
"$cmake" --build "$scratch/build"
"$scratch/build/embed" "$source/scenes/open_ocean.toml" "$scratch/embed.png"

# The same picture as the program's.
"$scratch/prefix/bin/swell-render" --scene "$source/scenes/open_ocean.toml" --size 640x360 \
  --out "$scratch/render.png"
cmp "$scratch/embed.png" "$scratch/render.png"
