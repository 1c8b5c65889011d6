#!/bin/sh
# full_disk_test.sh BIN SOURCE: a recording on a disk that fills up ends with one line and keeps its whole chunks.
# 77: no disk of a test's own can be mounted.
set -eu
bin=$1
source=$2
if [ -z "${SWELL_OWN_MOUNTS:-}" ]; then
  unshare --user --map-root-user --mount true 2>/dev/null ||
    { echo "skipped: no name space of its own for mounts"; exit 77; }
  export SWELL_OWN_MOUNTS=1
  exec unshare --user --map-root-user --mount "$0" "$@"
fi
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'umount "$work/disk" 2>/dev/null || true; rm -rf "$work"' EXIT
mkdir "$work/disk"
mount -t tmpfs -o size=1m tmpfs "$work/disk" || { echo "skipped: no tmpfs"; exit 77; }
wrong() {
  echo "wrong: $*"
  exit 1
}
record() {
  "$bin/swell-sim" --scene "$source/scenes/harbour.toml" --rig "$source/scenes/rigs/harbour_boat.toml" \
    --rig-set "camera[0].width_px=160" --rig-set "camera[0].height_px=90" \
    --rig-set "lidar[0].columns=64" --record "$1" --duration 2
}
if record "$work/disk/run.mcap" 2>"$work/line"; then wrong "done on a full disk"; fi
[ "$(wc -l <"$work/line")" -eq 1 ] && grep -q '^error: .*run.mcap.partial: No space left' "$work/line" ||
  wrong "not one line: $(cat "$work/line")"
[ ! -e "$work/disk/run.mcap" ] || wrong "it has the name of a whole file"
record "$work/whole.mcap"
size=$(stat -c %s "$work/disk/run.mcap.partial")
head -c "$size" "$work/whole.mcap" | cmp - "$work/disk/run.mcap.partial" || wrong "other bytes than on a roomy disk"
python3 -B "$here/mcap_reader.py" "$work/disk/run.mcap.partial" >"$work/messages"
[ "$(wc -l <"$work/messages")" -gt 100 ] || wrong "$(wc -l <"$work/messages") messages kept"
echo "A full disk: one line, and $(wc -l <"$work/messages") messages kept"
