# shellcheck shell=sh disable=SC2016 # apt-get's own names, and those of inner shells
# To be sourced by debian13.sh and compilers.sh: makes a root of Debian 13 in the folder $root, if there is none, copies
# this tree into its /swell, and defines how commands run there. Needs root and mmdebstrap.
mkdir -p "$root"
root=$(cd "$root" && pwd)

# inside COMMAND...: in the root, with its own processes, by which programs find their own folder.
inside() {
  unshare --mount sh -c 'mount -t proc proc "$0/proc" && mount --rbind /dev "$0/dev" && exec chroot "$0" env -i "$@"' \
    "$root" PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C "$@"
}

if [ ! -e "$root/etc/debian_version" ]; then
  rmdir "$root"
  # The mirror that this machine's own packages come from.
  mirror=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' | grep -v security | head -1)
  mmdebstrap --quiet --variant=apt trixie "$root" "$mirror"
fi
# The network's settings and apt's own, as this machine has them.
cp /etc/resolv.conf "$root/etc/"
cp -r /etc/apt/apt.conf.d/. "$root/etc/apt/apt.conf.d/"

mkdir -p "$root/swell"
git ls-files -z | tar --null --files-from=- -c | tar -x -C "$root/swell"
