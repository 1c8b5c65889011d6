#!/bin/sh
# Makes an OCI image of swell-render, swell-dataset and the scenes, on the few packages of Debian 12 that they need; no
# daemon takes part. The same build, commit and packages give the same bytes.
#   scripts/image.sh OUT [BUILD]   OUT: a new folder, which becomes an OCI layout; default BUILD: build/release.
#                                  For 64-bit Arm: build/arm64, made by scripts/arm64.sh or package.sh --arm64
# Then: podman pull oci:OUT:VERSION; or skopeo copy oci:OUT:VERSION docker-daemon:swell:VERSION
set -eu
if [ $# -eq 0 ] || [ -e "$1" ]; then
  echo "error: OUT, got '${1:-}', allowed a folder that is not there" >&2
  exit 2
fi
out=$(realpath -m "$1")
build=$(realpath -m "${2:-$(dirname "$0")/../build/release}")
cd "$(dirname "$0")/.."
programs="swell-render swell-dataset"
for program in $programs; do
  [ -x "$build/bin/$program" ] || { echo "error: $build/bin/$program, got none, allowed one" >&2; exit 2; }
done
# The processor that they were built for.
machine=$(readelf -h "$build/bin/swell-render" | sed -n 's/^ *Machine: *//p')
case $machine in
  AArch64) architecture=arm64 ;;
  *X86-64) architecture=amd64 ;;
  *) echo "error: $build/bin/swell-render, got a program for $machine, allowed X86-64 AArch64" >&2; exit 2 ;;
esac
other=""
[ $architecture = "$(dpkg --print-architecture)" ] || other=$architecture
# shellcheck disable=SC2086 # one word or none
scripts/setup.sh release $other >&2
# shellcheck source=scripts/debian_root.sh
. scripts/debian_root.sh
strip=$(dpkg-architecture -a$architecture -qDEB_HOST_MULTIARCH)-strip
version=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct)}
export SOURCE_DATE_EPOCH
created=$(date -u -d "@$SOURCE_DATE_EPOCH" +%FT%TZ)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Ours: programs, scenes, the scripts of clusters, a user that is not root and has /data.
root=$work/root
mkdir -p "$root/usr/bin" "$root/usr/share/swell" "$root/usr/share/doc/swell" "$root/etc" "$root/data"
for program in $programs; do
  "$strip" -o "$root/usr/bin/$program" "$build/bin/$program"
done
cp -r scenes scripts/cluster "$root/usr/share/swell"
{ cat LICENSE && echo && cat cmake/notices.txt; } >"$root/usr/share/doc/swell/copyright"
echo "root:x:0:0:root:/root:/bin/sh
swell:x:1000:1000::/data:/bin/sh" >"$root/etc/passwd"
echo "root:x:0:
swell:x:1000:" >"$root/etc/group"
chmod -R u=rwX,go=rX "$root"

# Debian's: the libraries, and what the scripts call, unpacked; with dpkg's list, by which scanners know what there is.
cat >"$work/finish" <<'HOOK'
for package in "$1"/var/cache/apt/archives/*.deb; do
  dpkg-deb -f "$package" && printf 'Status: install ok installed\n\n'
done >"$1/var/lib/dpkg/status"
cp -r "$2/." "$1" && chown 1000:1000 "$1/data"
HOOK
# shellcheck disable=SC2086 # a list of words
libraries=$(cd "$build/bin" && packages_of_libraries $programs)
# shellcheck disable=SC2016 # apt-get's own names
mirror=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' | grep -v security | head -1)
mmdebstrap --quiet --variant=extract --architectures=$architecture --aptopt='APT::Install-Recommends "false"' \
  --include="base-files,dash,coreutils,findutils,sed,$libraries" \
  --extract-hook="sh -eu '$work/finish' \"\$1\" '$root'" bookworm "$work/all.tar" "$mirror"
# Without what is of this machine, translations and manuals. Licences stay.
set -- '/etc/apt/*' /etc/hostname /etc/resolv.conf '/var/lib/apt/*' '/var/cache/*' '/var/log/*' '/usr/lib/*/gconv/*' \
  '/usr/share/info/*' '/usr/share/lintian/*' '/usr/share/locale/*' '/usr/share/man/*' '/usr/share/doc/*'
for pattern in "$@"; do
  set -- "$@" "--path-exclude=$pattern"
  shift
done
mmtarfilter "$@" '--path-include=/usr/share/doc/*/copyright' <"$work/all.tar" >"$work/layer.tar"

image=$out:$version
umoci init --layout "$out"
umoci new --image "$image"
umoci raw add-layer --image "$image" --history.created "$created" --history.created_by scripts/image.sh \
  "$work/layer.tar"
umoci config --image "$image" --no-history --created "$created" --architecture $architecture --config.user swell \
  --config.workingdir /usr/share/swell --config.env PATH=/usr/bin:/bin --config.env SWELL_CACHE=off \
  --config.entrypoint swell-render --config.cmd --help \
  --config.label org.opencontainers.image.title=swell \
  --config.label "org.opencontainers.image.description=Draws the sea on CPUs, with labels" \
  --config.label "org.opencontainers.image.version=$version" \
  --config.label org.opencontainers.image.licenses=BSD-3-Clause
umoci gc --layout "$out"
echo "$image"
