#!/bin/sh
# Installs the build into a fresh prefix. Every header there must compile alone, as a program that
# embeds the library sees it, and none may be private.
# Usage: installed_headers.sh CMAKE BUILD_FOLDER
set -eu
cmake=$1
build=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

"$cmake" --install "$build" --prefix "$scratch/prefix" >"$scratch/log"
include=$scratch/prefix/include/swell

for header in render/frame.h scene/water.h; do
  [ -f "$include/$header" ] || { echo "missing: $header"; exit 1; }
done

# What classes keep, per-target SIMD code, readers of files, kernels, steps of a pass.
private=$(cd "$include" && find . -name '*-inl.h' -o -name '*_state.h' -o -name '*_kernels.h' \
  -o -name '*_bytes.h' -o -name '*_codec.h' -o -name '*_structure.h' -o -name '*_lock.h' \
  -o -name '*_limits.h' -o -name 'check*.h' -o -name 'parameters.h' -o -name 'shade*.h' \
  -o -name 'packed_map.h' -o -path './texture/lattice.h' -o -name 'workspace.h' -o -name 'meshes.h' -o -name 'render_view.h' -o -name 'list.h' -o -name 'bin.h' -o -name 'clip.h' \
  -o -name 'setup.h' -o -name 'vertices.h' -o -name 'tree.h' -o -name 'queue.h')
[ -z "$private" ] || { echo "private headers are installed:"; echo "$private"; exit 1; }
others=$(find "$include" -type f ! -name '*.h')
[ -z "$others" ] || { echo "not headers: $others"; exit 1; }

# Whose includes could mean a file of the program's own.
quoted=$(grep -rl '^ *# *include "' "$include" || true)
[ -z "$quoted" ] || { echo "headers that do not include <swell/...>:"; echo "$quoted"; exit 1; }

# A source for each header, which includes it twice.
mkdir "$scratch/project"
cat >"$scratch/project/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.25)
project(headers LANGUAGES CXX)
find_package(swell REQUIRED)
file(GLOB sources *.cpp)
add_library(headers OBJECT \${sources})
target_link_libraries(headers PRIVATE swell::render)
target_compile_options(headers PRIVATE -fsyntax-only)
END
(cd "$include" && find . -name '*.h') | while read -r header; do
  name=swell/${header#./}
  printf '#include <%s>\n#include <%s>\n' "$name" "$name" \
    >"$scratch/project/$(echo "$name" | tr / _).cpp"
done
# The C++ door, which is beside them.
printf '#include <swell.hpp>\n#include <swell.hpp>\n' >"$scratch/project/door.cpp"
"$cmake" -G Ninja -S "$scratch/project" -B "$scratch/build" -DCMAKE_PREFIX_PATH="$scratch/prefix"
"$cmake" --build "$scratch/build" -- -k 0
echo "$(find "$include" -name '*.h' | wc -l) headers compile alone"
