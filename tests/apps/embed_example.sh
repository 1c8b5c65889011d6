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
# But for notes, which come before it.
tail -c +34 "$scratch/embed.png" >"$scratch/rest"
tail -c "$(stat -c %s "$scratch/rest")" "$scratch/render.png" | cmp - "$scratch/rest"

# The C interface, by CMake and by pkg-config.
cp -r "$source/examples/wave_provider" "$scratch/wave_provider"
# Without any of the packages that C++ needs.
missing=$(sed -n 's/^find_dependency(\([A-Za-z_]*\)).*/-DCMAKE_DISABLE_FIND_PACKAGE_\1=ON/p' "$source/cmake/Dependencies.cmake")
# shellcheck disable=SC2086 # a list of words
"$cmake" -G Ninja -S "$scratch/wave_provider" -B "$scratch/loop" -DCMAKE_PREFIX_PATH="$scratch/prefix" $missing
"$cmake" --build "$scratch/loop"
"$scratch/loop/wave_provider_loop" "$source/scenes/sea_state_2.toml" 1
cp -r "$source/examples/cpp" "$scratch/cpp"
# shellcheck disable=SC2086 # a list of words
"$cmake" -G Ninja -S "$scratch/cpp" -B "$scratch/look" -DCMAKE_PREFIX_PATH="$scratch/prefix" $missing
"$cmake" --build "$scratch/look"
"$scratch/look/look" "$source/scenes/open_ocean.toml"
cat >"$scratch/version.c" <<'END'
#include <stdio.h>
#include <swell.h>
int main(void) { return puts(swell_version()) < 0; }
END
# shellcheck disable=SC2046 # a list of words
cc "$scratch/version.c" -o "$scratch/version" \
  $(PKG_CONFIG_PATH="$scratch/prefix/lib/pkgconfig" pkg-config --cflags --libs swell)
LD_LIBRARY_PATH="$scratch/prefix/lib" "$scratch/version"
