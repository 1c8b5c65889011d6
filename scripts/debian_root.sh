# shellcheck shell=sh disable=SC2016 # apt-get's own names, and those of inner shells
# To be sourced: makes roots of Debian and runs commands in them. Needs root and mmdebstrap; for another processor also
# qemu-user-static, and a kernel that lets it run programs.

# make_root FOLDER RELEASE ARCHITECTURE [PACKAGE,PACKAGE...]: makes the root, if it is not in the folder as a whole.
make_root() {
  root=$(realpath -m "$1")
  if [ "$3" != "$(dpkg --print-architecture)" ]; then
    run_by_qemu "$3"
  fi
  if [ "$(cat "$root/made_of" 2>/dev/null)" != "$2 $3 ${4:-}" ]; then
    rm -rf "$root"
    # The mirror that this machine's own packages come from.
    mirror=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' | grep -v security | head -1)
    mmdebstrap --quiet --variant=apt --architectures="$3" --aptopt='APT::Install-Recommends "false"' \
      ${4:+--include="$4"} "$2" "$root" "$mirror" || return
    echo "$2 $3 ${4:-}" >"$root/made_of"
  fi
  # The network's settings and apt's own, as this machine has them.
  cp /etc/resolv.conf "$root/etc/"
  cp -r /etc/apt/apt.conf.d/. "$root/etc/apt/apt.conf.d/"
}

# run_by_qemu ARCHITECTURE: lets the kernel run programs for arm64.
run_by_qemu() {
  formats=/proc/sys/fs/binfmt_misc
  [ "$1" = arm64 ] || { echo "error: architecture, got '$1', allowed arm64" >&2; return 2; }
  [ -e $formats/register ] || mount -t binfmt_misc binfmt_misc $formats
  [ -e $formats/qemu-aarch64 ] || cat /usr/lib/binfmt.d/qemu-aarch64.conf >$formats/register
}

# packages_of_libraries FILE...: the packages, a,b,c, of the libraries that programs for any processor load. They have the
# names there that they have here.
packages_of_libraries() {
  here=$(dpkg-architecture -qDEB_BUILD_MULTIARCH)
  readelf -d "$@" 2>/dev/null | sed -n "s/.*(NEEDED).*\[\(.*\)\]/*\/$here\/\1/p" | grep -v -e swell -e ld-linux |
    sort -u | xargs dpkg-query -S | cut -d: -f1 | sort -u | paste -sd,
}

# inside COMMAND...: in the root, with its own processes, by which programs find their own folder. This tree is in the
# place where it is here, if the root has a folder there.
inside() {
  unshare --mount sh -c 'mount -t proc proc "$0/proc" && mount --rbind /dev "$0/dev" &&
    { [ ! -d "$0$PWD" ] || mount --bind "$PWD" "$0$PWD"; } && exec chroot "$0" env -i "$@"' \
    "$root" PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C DEBIAN_FRONTEND=noninteractive "$@"
}

# copy_tree: this tree's files into the root's /swell.
copy_tree() {
  mkdir -p "$root/swell"
  git ls-files -z | tar --null --files-from=- -c | tar -x -C "$root/swell"
}
