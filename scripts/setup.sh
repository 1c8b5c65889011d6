#!/bin/sh
# Installs the Debian packages of packages.txt that are missing; does nothing if none is.
# Needs root or sudo only if there is something to install.
#   scripts/setup.sh [GROUP ...]
# GROUP: viewer, dds, gazebo, tests, python, film, browser, cluster, docs, release, clang, tidy, arm64: packages_GROUP.txt
# as well, without which everything else works. Where they cannot be had one line says so.
set -eu
cd "$(dirname "$0")"

# missing FILE: packages that are not installed.
missing() {
  for package in $(sed 's/#.*//' "$1"); do
    status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
    [ "$status" = installed ] || printf ' %s' "$package"
  done
}

# install PACKAGES
install() {
  as_root=""
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "error: run as root or install sudo; these packages are missing:$1" >&2
      return 1
    fi
    as_root="sudo"
  fi
  echo "Installing:$1"
  # sudo does not pass the environment on: env does.
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get update -q </dev/null &&
    # shellcheck disable=SC2086 # a list of words
    $as_root env DEBIAN_FRONTEND=noninteractive \
      apt-get install -q -y --no-install-recommends $1 </dev/null
}

all=$(missing packages.txt)
for group in "$@"; do
  all="$all$(missing "packages_$group.txt")"
done
# All at once takes the package lists but once; where that cannot be done, what can be had.
if [ -n "$all" ] && ! install "$all"; then
  packages=$(missing packages.txt)
  [ -z "$packages" ] || install "$packages"
  for group in "$@"; do
    packages=$(missing "packages_$group.txt")
    [ -z "$packages" ] || install "$packages" ||
      echo "note: goes on without the group '$group' of packages:$packages"
  done
fi
