# shellcheck shell=sh
# To be sourced, in the tree's folder: unpacks what the preset arm64 builds with into the folder $root, if it is not there.
root=build/arm64-root

# Debian's :arm64 libraries and Python, unpacked: nothing of them runs but what programs load.
libraries=$(sed -n 's/^\(lib[^ ]*-dev\|nlohmann-json3-dev\|zlib1g-dev\|p[^ ]*-dev\|python3-numpy\) .*/\1/p' \
  scripts/packages.txt scripts/packages_viewer.txt scripts/packages_tests.txt scripts/packages_python.txt | paste -sd,)
if [ "$(cat "$root/complete" 2>/dev/null)" != "$libraries" ]; then
  rm -rf "$root"
  # shellcheck disable=SC2016 # apt-get's own names
  mirror=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' | grep -v security | head -1)
  mmdebstrap --quiet --variant=extract --architectures=arm64 --aptopt='APT::Install-Recommends "false"' \
    --include="libc6-dev,libstdc++-12-dev,$libraries" bookworm "$root" "$mirror"
  # Links to places in the root, and those that packages make when they are installed.
  find "$root" -type l -lname '/*' | while read -r link; do
    place=$(readlink "$link")
    [ ! -e "$root$place" ] || ln -sfn "$(realpath --relative-to="$(dirname "$link")" "$root$place")" "$link"
  done
  for name in blas lapack; do
    ln -sf "$name/lib$name.so.3" "$root/usr/lib/aarch64-linux-gnu/lib$name.so.3"
  done
  echo "$libraries" >"$root/complete"
fi
