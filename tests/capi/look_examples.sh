#!/bin/sh
# look_examples.sh LANGUAGE BUILD LIBRARY SCENE SWELL_RENDER: an example in another language draws the picture that
# swell-render draws, and ends as it should. LANGUAGE: rust, csharp, or node, whose koffi npm brings into the build
# folder. 77: the language is not installed, or there is no koffi to be had.
set -eu
language=$1
build=$2
library=$3
scene=$4
render=$5
koffi=3.3.4
examples=$(cd "$(dirname "$0")/../../examples" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

need() {
  for tool; do
    command -v "$tool" >/dev/null || { echo "skipped: no $tool"; exit 77; }
  done
}

folder=$(dirname "$library")
case $language in
rust)
  need rustc
  rustc -D warnings -L "$folder" -C "link-arg=-Wl,-rpath,$folder" -o "$scratch/look" "$examples/rust/look.rs"
  look() { "$scratch/look" "$1"; }
  ;;
csharp)
  need dotnet
  cp -r "$examples/csharp" "$scratch"
  dotnet build --nologo -v quiet -o "$scratch/out" "$scratch/csharp" >"$scratch/log" || { cat "$scratch/log"; exit 1; }
  look() { LD_LIBRARY_PATH=$folder "$scratch/out/look" "$1"; }
  ;;
node)
  need node npm
  modules=$build/koffi-$koffi
  if ! [ -d "$modules/node_modules/koffi" ]; then
    mkdir -p "$modules"
    timeout 120 npm install --prefix "$modules" --no-save --no-package-lock --no-audit --no-fund \
      --ignore-scripts "koffi@$koffi" >"$modules/log" 2>&1 </dev/null ||
      { rm -rf "$modules"; echo "skipped: npm cannot get koffi $koffi"; exit 77; }
  fi
  export NODE_PATH="$modules/node_modules" SWELL_LIBRARY="$library"
  look() { node "$examples/node/look.js" "$1"; }
  ;;
esac
drawn=$(look "$scene")
echo "$drawn"
if look "no such scene.toml" 2>"$scratch/fault"; then echo "a fault is no failure"; exit 1; fi
grep -q "no such scene.toml" "$scratch/fault"
echo "$drawn" | grep -q ' m ahead$'
[ "$(echo "$drawn" | head -n 1)" = "$("$render" --scene "$scene" --size 64x36 --time 5 --hash)" ]
