#!/bin/sh
# packages_elsewhere.sh BUILD SOURCE: README's ways to get Swell, run in a copy of the sources in another folder,
# without a cache of compilers. Packages, wheel and image have the bytes of those of the build. 77: a tool is missing, or
# not all is built.
set -eu
build=$1 source=$2
for tool in cpack dpkg-shlibdeps file patchelf mmdebstrap umoci; do
  command -v $tool >/dev/null || { echo "skipped: no $tool"; exit 77; }
done
[ "$(id -u)" -eq 0 ] || { echo "skipped: the image needs root"; exit 77; }
for file in bin/swell-view bin/swell-bench bin/swell-dataset bin/swell-sim bin/swell-render lib/libswell.so.0 \
    python/swell; do
  [ -e "$build/$file" ] || { echo "skipped: not all is built"; exit 77; }
done
for part in DDS=1 GAZEBO=.; do
  grep -q "^SWELL_\(HAS_\)\?${part%=*}:INTERNAL=${part#*=}" "$build/CMakeCache.txt" ||
    { echo "skipped: built without ${part%=*}"; exit 77; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
umask 022
export SOURCE_DATE_EPOCH=1700000000
# quietly COMMAND...: its output only if it fails.
quietly() { "$@" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }; }

made=$work/made
quietly cpack --config "$build/CPackConfig.cmake" -B "$made"
rm -r "$made/_CPack_Packages"
quietly python3 -B "$source/scripts/write_wheel.py" "$build" "$made"
quietly "$source/scripts/image.sh" "$made/image" "$build"

# Programs name the commit, also those of the copy.
if repository=$(git -C "$source" rev-parse --absolute-git-dir 2>/dev/null); then
  export GIT_DIR="$repository" GIT_OPTIONAL_LOCKS=0
fi
mkdir "$work/elsewhere"
(cd "$source" && find . \( -path ./build -o -path ./.git -o -path ./out \) -prune -o -type f -print0 |
  xargs -0 cp --parents -t "$work/elsewhere")
cd "$work/elsewhere"
names='CMAKE_(C|CXX)_COMPILER|SWELL_(DCHECKS|PARALLEL|SIMD)'
options=$(sed -nE "s/^(($names):.*)/-D\\1/p" "$build/CMakeCache.txt")
export CCACHE_DISABLE=1
# shellcheck disable=SC2086 # a list of words
quietly cmake --preset release -DSWELL_BUILD_TESTS=OFF $options
quietly scripts/package.sh "$work/again"
quietly scripts/wheel.sh
mv out/*.whl "$work/again"
quietly scripts/image.sh "$work/again/image"
diff -r "$made" "$work/again"
quietly env -u DISPLAY -u WAYLAND_DISPLAY scripts/run.sh
[ -s out/open_ocean.png ]
(cd "$made" && sha256sum ./*.deb ./*.whl image/index.json)
