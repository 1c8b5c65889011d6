#!/bin/sh
# Builds the programs of scripts/run.sh in a root of Debian 13, compares the pictures of all scenes with those of the
# release build beside it, and runs the tests there: an hour on two cores. Needs root, mmdebstrap and build/release/bin.
#   scripts/debian13.sh [FOLDER]   the root's folder, kept and used again; default build/debian13
set -eu
cd "$(dirname "$0")/.."
[ -x build/release/bin/swell-render ] || { echo "error: build/release/bin/swell-render, got none, allowed one" >&2; exit 2; }
# shellcheck source=scripts/debian_root.sh
. scripts/debian_root.sh
make_root "${1:-build/debian13}" trixie "$(dpkg --print-architecture)"
copy_tree

# shellcheck disable=SC2016 # inner shells' variables
hashes='for scene in scenes/*.toml; do
  for t_s in 0 7.5; do
    echo "$scene $t_s $(build/release/bin/swell-render --scene "$scene" --size 320x180 --time $t_s --hash)"
  done
done'

inside sh -c 'cd /swell && scripts/setup.sh viewer python && cmake --preset release -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DCMAKE_UNITY_BUILD=OFF &&
  cmake --build --preset release --target swell-render swell-bench swell-view swell-dataset swell-sim swell_package'
inside sh -c "cd /swell && $hashes" >build/debian13.txt
sh -c "$hashes" >build/debian12.txt
diff build/debian12.txt build/debian13.txt
echo "The same $(wc -l <build/debian13.txt) pictures on both"
inside sh -c 'cd /swell && scripts/test.sh'
