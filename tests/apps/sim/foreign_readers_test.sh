#!/bin/sh
# foreign_readers_test.sh BIN SOURCE BUILD: Foxglove's readers, which npm brings into the build folder, find in a
# recording of ten seconds of the harbour all that ours finds, message by message, with the pictures and labels that a
# film of swell-render has; and in one that was cut off all whole chunks. 77: no node, or nothing to be had from npm.
set -eu
bin=$1
source=$2
build=$3
here=$(cd "$(dirname "$0")" && pwd)
for tool in node npm python3; do
  command -v $tool >/dev/null || { echo "skipped: no $tool"; exit 77; }
done
modules=$build/mcap-readers-1
if ! [ -d "$modules/node_modules/@mcap/core" ]; then
  mkdir -p "$modules"
  timeout 120 npm install --prefix "$modules" --no-save --no-package-lock --no-audit --no-fund --ignore-scripts \
    @mcap/core@2.2.2 @foxglove/rosmsg@5.0.5 @foxglove/rosmsg2-serialization@3.1.0 fzstd@0.1.1 \
    >"$modules/log" 2>&1 </dev/null || { rm -rf "$modules"; echo "skipped: npm cannot get the readers"; exit 77; }
fi
export SWELL_NODE_MODULES="$modules"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$bin/swell-sim" --scene "$source/scenes/harbour.toml" --rig "$source/scenes/rigs/harbour_boat.toml" \
  --rig-set "camera[0].width_px=96" --rig-set "camera[0].height_px=54" \
  --rig-set "camera[0].compressed=jpeg" --rig-set "lidar[0].columns=64" --record "$work/run.mcap"

# Both readers' lines; messages of one stamp may come in any order.
ours() { python3 -B "$here/mcap_reader.py" "$1" | sort; }
ours "$work/run.mcap" >"$work/ours"
[ "$(wc -l <"$work/ours")" -eq 6601 ] || { echo "wrong: $(wc -l <"$work/ours") messages"; exit 1; }
node "$here/read_mcap.mjs" "$work/run.mcap" | sort | diff - "$work/ours"
node "$here/read_mcap.mjs" "$work/run.mcap" --chunks | sort | diff - "$work/ours"

# The pictures and labels of each stamp are those of swell-render at that time and pose.
"$bin/swell-render" --scene "$source/scenes/harbour.toml" --size 96x54 --frames 0-199 --fps 20 \
  --set camera.mount=launch --set "camera.mount_offset_m=[0, 1.6, 1.9]" --set camera.eye_m= --set camera.heading_deg=0 \
  --set camera.pitch_deg=-5 --set camera.fov_y_deg=56 --labels depth,class,id --out "$work/film.mcap"
images() { node "$here/read_mcap.mjs" "$1" --images; }
images "$work/run.mcap" | sort >"$work/images"
images "$work/film.mcap" | sort | diff - "$work/images"
for topic in "image_raw 96 54 rgb8 15552" "depth 96 54 32FC1 20736" "class 96 54 16UC1 10368" "id 96 54 32SC1 20736"; do
  for k in $(seq 0 199); do echo "/camera/$topic $((k * 50000000)) $((k * 50000000))"; done
done | sort >"$work/heads"
cut -d " " -f 1-7 "$work/images" | sort | diff - "$work/heads"

head -c $(($(stat -c %s "$work/run.mcap") / 2)) "$work/run.mcap" >"$work/cut.mcap"
ours "$work/cut.mcap" >"$work/ours"
[ -s "$work/ours" ]
node "$here/read_mcap.mjs" "$work/cut.mcap" --chunks | sort | diff - "$work/ours"
echo "The same $(wc -l <"$work/ours") messages of a cut file too"
