#!/bin/sh
# Installs the Debian packages of packages.txt that are missing; does nothing if none is.
# Needs root or sudo only if there is something to install.
set -eu
cd "$(dirname "$0")"

missing=""
for package in $(sed 's/#.*//' packages.txt); do
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

as_root=""
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "error: run as root or install sudo; these packages are missing:$missing" >&2
    exit 1
  fi
  as_root="sudo"
fi

echo "Installing:$missing"
# sudo does not pass the environment on: env does.
$as_root env DEBIAN_FRONTEND=noninteractive apt-get update -q </dev/null
# shellcheck disable=SC2086 # a list of words
$as_root env DEBIAN_FRONTEND=noninteractive \
  apt-get install -q -y --no-install-recommends $missing </dev/null
