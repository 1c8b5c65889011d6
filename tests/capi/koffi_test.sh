#!/bin/sh
# koffi_test.sh BUILD LIBRARY SCENE EXPECTED: Node draws a picture by koffi, which npm brings into
# the build folder, and ends as it should. EXPECTED prints the picture's hash. 77: there is no Node,
# or no koffi to be had.
set -eu
version=3.3.4
here=$(dirname "$0")
folder=$1/koffi-$version
for tool in node npm; do
  command -v $tool >/dev/null || { echo "skipped: no $tool"; exit 77; }
done
if ! [ -d "$folder/node_modules/koffi" ]; then
  mkdir -p "$folder"
  timeout 120 npm install --prefix "$folder" --no-save --no-package-lock --no-audit --no-fund \
    --ignore-scripts "koffi@$version" >"$folder/log" 2>&1 </dev/null ||
    { rm -rf "$folder"; echo "skipped: npm cannot get koffi $version"; exit 77; }
fi
drawn=$(node "$here/koffi_test.js" "$folder/node_modules/koffi" "$2" "$3")
echo "$drawn"
[ "$drawn" = "$("$4" --scene "$3" --size 64x36 --time 5 --hash)" ]
