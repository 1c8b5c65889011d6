#!/bin/sh
# Makes Debian packages for the Debian and the processor of this machine: builds the release, writes them into FOLDER.
# The same commit gives the same bytes, whoever builds it where.
#   scripts/package.sh [FOLDER]           default: build/packages
#   scripts/package.sh --arm64 [FOLDER]   for Debian 12 on 64-bit Arm, default: build/packages_arm64; needs root
set -eu
arm64=""
if [ "${1:-}" = --arm64 ]; then
  arm64=_arm64
  shift
fi
folder=${1:-$(dirname "$0")/../build/packages$arm64}
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
cd "$(dirname "$0")/.."
preset=release
scripts/setup.sh viewer dds gazebo tests python release ${arm64:+arm64}
# The time of all files in the packages.
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct)}
export SOURCE_DATE_EPOCH
umask 022
if [ "$arm64" ]; then
  preset=arm64
  # shellcheck source=scripts/arm64_sysroot.sh
  . scripts/arm64_sysroot.sh
fi
cmake --preset $preset
cmake --build build/$preset --target swell_installed
rm -f "$folder"/*.deb

if [ "$arm64" ]; then
  # What the packages depend on a Debian for that processor knows.
  # shellcheck source=scripts/debian_root.sh
  . scripts/debian_root.sh
  # shellcheck disable=SC2046 # a list of names
  libraries=$(packages_of_libraries $(find build/arm64/bin/swell-* build/arm64/lib build/arm64/python -type f))
  make_root build/arm64-debian bookworm arm64 "cmake,dpkg-dev,file,binutils,$libraries"
  mkdir -p "$root$PWD"
  cpack() { inside sh -c 'cd "$0" && SOURCE_DATE_EPOCH=$1 && export SOURCE_DATE_EPOCH && shift && exec cpack "$@"' "$PWD" \
    "$SOURCE_DATE_EPOCH" "$@"; }
fi
# In the tree, which both see.
made=$PWD/build/$preset/packages_made
rm -rf "$made"
cpack --config "build/$preset/CPackConfig.cmake" -B "$made" >"build/$preset/cpack.log" 2>&1 ||
  { cat "build/$preset/cpack.log"; exit 1; }
mv "$made"/*.deb "$folder"
rm -r "$made"
cd "$folder"
for file in *.deb; do
  echo "$(sha256sum "$file"), $(stat -c %s "$file") bytes"
done
