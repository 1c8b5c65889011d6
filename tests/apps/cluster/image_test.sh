#!/bin/sh
# image_test.sh BUILD SOURCE [MADE_OF]: the image of scripts/image.sh, made of the build or of another, as that for 64-bit
# Arm, has the same bytes twice; its entry point draws, as its user and in its folder, what the build's program draws; and
# it does the tasks of a cluster. 77: without root, or a program.
set -eu
build=$1 source=$2 made_of=${3:-$1}
for tool in mmdebstrap umoci python3; do
  command -v $tool >/dev/null || { echo "skipped: no $tool"; exit 77; }
done
[ "$(id -u)" -eq 0 ] || { echo "skipped: chroot needs root"; exit 77; }
[ -x "$build/bin/swell-render" ] && [ -x "$made_of/bin/swell-dataset" ] || { echo "skipped: not all is built"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
image=$("$source/scripts/image.sh" "$work/image" "$made_of")
"$source/scripts/image.sh" "$work/again" "$made_of" >/dev/null
diff -r "$work/image" "$work/again"
bytes=$(du -sb "$work/image" | cut -f1)
[ "$bytes" -le 20000000 ] || { echo "the image has $bytes bytes, allowed 20,000,000"; exit 1; }

umoci unpack --image "$image" "$work/bundle" 2>"$work/log" || { cat "$work/log"; exit 1; }
cat >"$work/process.py" <<'PROGRAM'
import json, sys
config = json.load(open(sys.argv[1]))
process = config["process"]
print("{uid}:{gid}".format(**process["user"]), process["cwd"], process["args"][0],
      config["annotations"]["org.opencontainers.image.architecture"])
PROGRAM
# shellcheck disable=SC2046 # four words
set -- $(python3 "$work/process.py" "$work/bundle/config.json")
user=$1 cwd=$2 entry=$3 architecture=$4
[ "$user" = 1000:1000 ]
# shellcheck source=scripts/debian_root.sh
. "$source/scripts/debian_root.sh"
[ "$architecture" = "$(dpkg --print-architecture)" ] || run_by_qemu "$architecture"

# as_user COMMAND...: as a container would, but for its own namespaces.
as_user() {
  # shellcheck disable=SC2016 # for the shell inside
  chroot --userspec="$user" "$work/bundle/rootfs" /usr/bin/env -i PATH=/usr/bin:/bin JOB_COMPLETION_INDEX="${task:-}" \
    sh -c 'cd "$1" && shift && exec "$@"' sh "$cwd" "$@"
}
options="--scene scenes/buoys.toml --size 320x180 --time 5 --hash"
# shellcheck disable=SC2086 # a list of words
[ "$(as_user "$entry" $options)" = "$(cd "$source" && "$build/bin/swell-render" $options)" ]

options="--scene scenes/open_ocean.toml --size 64x36 --frames 0-2 --out /data/f_%d.png"
for task in 0 1; do
  # shellcheck disable=SC2086 # a list of words
  as_user cluster/task.sh /data/state 2 swell-render $options
done
# shellcheck disable=SC2086 # a list of words
as_user cluster/collect.sh /data/state 2 swell-render $options
[ "$(wc -l <"$work/bundle/rootfs/data/state/manifest.sha256")" -eq 3 ]
as_user swell-dataset --recipe scenes/recipes/harbour.toml --out /data/harbour --try >/dev/null
as_user sh -c '! touch /usr/bin/mine' 2>/dev/null
