#!/bin/sh
# package.sh BUILD: the .deb of a build, installed into an empty root. 77: there is no dpkg, or not
# all of the build is made.
set -eu
build=$1
for tool in cpack dpkg dpkg-shlibdeps; do
  command -v $tool >/dev/null || { echo "skipped: no $tool"; exit 77; }
done
[ -x "$build/bin/swell-view" ] && [ -x "$build/bin/swell-bench" ] || { echo "skipped: not all is built"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cpack --config "$build/CPackConfig.cmake" -B "$work" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
deb=$(ls "$work"/*.deb)
root=$work/root
mkdir -p "$root"
if [ "$(id -u)" -eq 0 ]; then
  mkdir -p "$root/var/lib/dpkg/info" "$root/var/lib/dpkg/updates"
  : >"$root/var/lib/dpkg/status"
  dpkg --root="$root" --force-depends --force-script-chrootless --no-triggers -i "$deb" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
else
  dpkg-deb -x "$deb" "$root"
fi
dpkg-deb -f "$deb" Depends | grep -q libtbb
dpkg-deb -f "$deb" Suggests | grep -q libhwy-dev
case $(dpkg-deb -f "$deb" Maintainer) in *localhost*) echo "the maintainer is nobody"; exit 1 ;; esac
size=$(stat -c %s "$deb")
[ "$size" -le 20000000 ] || { echo "README says 17 MB, the package has $size bytes"; exit 1; }
for file in bin/swell-render bin/swell-bench bin/swell-dataset bin/swell-view lib/libswell.so.0 include/swell.h \
  include/swell/render/frame.h lib/pkgconfig/swell.pc lib/cmake/swell/swellConfig.cmake \
  share/swell/scenes/open_ocean.toml share/swell/slurm/submit.sh share/swell/cluster/task.sh share/man/man1/swell-view.1 share/doc/swell/README.md share/doc/swell/copyright share/doc/swell/LICENSE \
  share/doc/swell/docs/do/embedding.md share/swell/examples/python/boat.py share/swell/examples/wave_provider/wave_provider.h \
  share/bash-completion/completions/swell-render; do
  [ -e "$root/usr/$file" ] || { echo "the package lacks $file"; exit 1; }
done
# Its programs run, from another place, and draw what those of the build do.
draw() { "$1/swell-render" --scene "$2/open_ocean.toml" --size 64x36 --time 5 --hash; }
[ "$(draw "$root/usr/bin" "$root/usr/share/swell/scenes")" = "$(draw "$build/bin" "$root/usr/share/swell/scenes")" ]
"$root/usr/bin/swell-view" --version >/dev/null
# So do its libraries.
printf '#include <swell.h>\n#include <stdio.h>\nint main(void) { return puts(swell_version()) < 0; }\n' >"$work/main.c"
cc "$work/main.c" -I"$root/usr/include" -L"$root/usr/lib" -lswell -o "$work/main"
LD_LIBRARY_PATH=$root/usr/lib "$work/main" >/dev/null
if [ -d "$root/usr/lib/python3/dist-packages/swell" ] && /usr/bin/python3 -c 'import numpy' 2>/dev/null; then
  PYTHONPATH=$root/usr/lib/python3/dist-packages /usr/bin/python3 -c 'import swell; print(swell.World)'
fi
