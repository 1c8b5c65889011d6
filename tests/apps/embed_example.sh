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

# Each component is found, and refused in one line where there is none or it is not installed.
mkdir "$scratch/component"
cat >"$scratch/component/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.25)
project(component LANGUAGES CXX)
find_package(swell REQUIRED COMPONENTS ${component} OPTIONAL_COMPONENTS nothing)
if(NOT swell_${component}_FOUND OR swell_nothing_FOUND)
  message(FATAL_ERROR "${component} is said not to be found")
endif()
END
find_component() {
  rm -rf "$scratch/found"
  "$cmake" -G Ninja -S "$scratch/component" -B "$scratch/found" -DCMAKE_PREFIX_PATH="$scratch/prefix" \
    -Dcomponent="$1" >"$scratch/log" 2>&1
}
for component in C CXX core images meshes; do
  find_component $component || { cat "$scratch/log"; exit 1; }
done
if find_component waves; then echo "a component that there is not is found"; exit 1; fi
tr -s ' \n' '  ' <"$scratch/log" | grep -q 'swell has no component waves, allowed C, core, CXX, images, meshes'
rm "$scratch/prefix/lib/swell/swell_mesh_import"
if find_component meshes; then echo "a component that is not installed is found"; exit 1; fi
tr -s ' \n' '  ' <"$scratch/log" | grep -q 'the component meshes is not installed'
find_component images
cat >"$scratch/version.c" <<'END'
#include <stdio.h>
#include <swell.h>
int main(void) { return puts(swell_version()) < 0; }
END
export PKG_CONFIG_PATH="$scratch/prefix/lib/pkgconfig"
# shellcheck disable=SC2046 # a list of words
cc "$scratch/version.c" -o "$scratch/version" $(pkg-config --cflags --libs swell)
LD_LIBRARY_PATH="$scratch/prefix/lib" "$scratch/version"

# The C++ libraries by pkg-config: the same picture again.
# shellcheck disable=SC2046 # a list of words
c++ -O1 "$source/examples/embed/embed.cpp" -o "$scratch/embed_pc" $(pkg-config --cflags --libs swell-cpp)
"$scratch/embed_pc" "$source/scenes/open_ocean.toml" "$scratch/again.png"
cmp "$scratch/embed.png" "$scratch/again.png"
