#!/bin/sh
# Makes Debian packages for the Debian and the processor of this machine: builds the release, writes them into FOLDER.
# The same commit gives the same bytes, whoever builds it where.
#   scripts/package.sh [FOLDER]   default: build/packages
set -eu
folder=${1:-$(dirname "$0")/../build/packages}
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
cd "$(dirname "$0")/.."
scripts/setup.sh viewer tests python release
# The time of all files in the packages.
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct)}
export SOURCE_DATE_EPOCH
umask 022
cmake --preset release
cmake --build --preset release --target swell_installed
rm -f "$folder"/*.deb
cpack --config build/release/CPackConfig.cmake -B "$folder" >"$folder/cpack.log" 2>&1 ||
  { cat "$folder/cpack.log"; exit 1; }
rm -r "$folder/_CPack_Packages" "$folder/cpack.log"
cd "$folder"
for file in *.deb; do
  echo "$(sha256sum "$file"), $(stat -c %s "$file") bytes"
done
