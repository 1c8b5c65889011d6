#!/bin/sh
# Builds the programs of scripts/run.sh in a root of Debian 13, compares the pictures of all scenes with those of the
# release build beside it, and runs the tests there: an hour on two cores. Needs root, mmdebstrap and build/release/bin.
#   scripts/debian13.sh [FOLDER]   the root's folder, kept and used again; default build/debian13
set -eu
cd "$(dirname "$0")/.."
[ -x build/release/bin/swell-render ] || { echo "error: build/release/bin/swell-render, got none, allowed one" >&2; exit 2; }
root=${1:-build/debian13}
mkdir -p "$root"
root=$(cd "$root" && pwd)

# The mirror that this machine's own packages come from.
mirror=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' | grep -v security | head -1)

# inside COMMAND...: in the root, with its own processes, by which programs find their own folder.
inside() {
  unshare --mount sh -c 'mount -t proc proc "$0/proc" && mount --rbind /dev "$0/dev" && exec chroot "$0" env -i "$@"' "$root" \
    PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C "$@"
}
hashes='for scene in scenes/*.toml; do
  for t_s in 0 7.5; do
    echo "$scene $t_s $(build/release/bin/swell-render --scene "$scene" --size 320x180 --time $t_s --hash)"
  done
done'

if [ ! -e "$root/etc/debian_version" ]; then
  rmdir "$root"
  mmdebstrap --quiet --variant=apt trixie "$root" "$mirror"
fi
# The network's settings and apt's own, as this machine has them.
cp /etc/resolv.conf "$root/etc/"
cp -r /etc/apt/apt.conf.d/. "$root/etc/apt/apt.conf.d/"

mkdir -p "$root/swell"
git archive HEAD | tar -x -C "$root/swell"
inside sh -c 'cd /swell && scripts/setup.sh viewer python && cmake --preset release -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DCMAKE_UNITY_BUILD=OFF &&
  cmake --build --preset release --target swell-render swell-bench swell-view swell-dataset swell-sim swell_package'
inside sh -c "cd /swell && $hashes" >build/debian13.txt
sh -c "$hashes" >build/debian12.txt
diff build/debian12.txt build/debian13.txt
echo "The same $(wc -l <build/debian13.txt) pictures on both"
inside sh -c 'cd /swell && scripts/test.sh'
