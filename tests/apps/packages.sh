#!/bin/sh
# packages.sh BUILD SOURCE: the Debian packages of a build, installed into an empty root. 77: a tool is missing, or not
# all of the build is made.
set -eu
build=$1
source=$2
for tool in cpack dpkg dpkg-shlibdeps file lintian mandoc desktop-file-validate; do
  command -v $tool >/dev/null || { echo "skipped: no $tool"; exit 77; }
done
for file in bin/swell-view bin/swell-bench bin/swell-dataset bin/swell-sim bin/swell-render lib/libswell.so.0; do
  [ -e "$build/$file" ] || { echo "skipped: not all is built"; exit 77; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
umask 022
fail() {
  echo "error: $*"
  exit 1
}

# make_packages FOLDER: as scripts/package.sh does.
make_packages() {
  SOURCE_DATE_EPOCH=1700000000 cpack --config "$build/CPackConfig.cmake" -B "$1" >"$work/log" 2>&1 ||
    { cat "$work/log"; exit 1; }
  rm -r "$1/_CPack_Packages"
}
# unpack ROOT FILE...: by dpkg where that may be.
unpack() {
  into=$1
  shift
  mkdir -p "$into/var/lib/dpkg/info" "$into/var/lib/dpkg/updates"
  : >"$into/var/lib/dpkg/status"
  if [ "$(id -u)" -eq 0 ]; then
    dpkg --root="$into" --no-triggers --unpack "$@" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
  else
    for file in "$@"; do dpkg-deb -x "$file" "$into"; done
  fi
}

# The bytes are those of the build, whatever the folder and the time zone.
make_packages "$work/packages"
(export TZ=Asia/Tokyo LC_ALL=C.UTF-8 && make_packages "$work/another folder")
diff -r "$work/packages" "$work/another folder" || fail "two runs of cpack give two packages"

# Each file that is installed is in one package.
DESTDIR=$work/all cmake --install "$build" --prefix /usr >/dev/null
(cd "$work/all" && find . ! -type d | sort) >"$work/installed"
for package in "$work"/packages/*.deb; do
  dpkg-deb --fsys-tarfile "$package" | tar -t | grep -v '/$'
done | sort >"$work/packed"
[ -z "$(uniq -d "$work/packed")" ] || fail "in two packages: $(uniq -d "$work/packed")"
grep -v '^\./usr/share/doc/[^/]*/\(copyright\|changelog\.gz\)$' "$work/packed" | diff "$work/installed" - ||
  fail "what is installed (<) and what is packed (>) differ"

# They are as Debian wants them, but that cpack's own scripts call ldconfig, and that the folder of libraries names
# no processor.
lintian --no-cfg --allow-root --fail-on error,warning \
  --suppress-tags maintscript-calls-ldconfig,pkg-config-unavailable-for-cross-compilation \
  "$work"/packages/*.deb >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
root=$work/root
unpack "$root" "$work"/packages/*.deb
for page in "$root"/usr/share/man/man1/*.gz; do
  mandoc -T lint -W error "$page" || fail "mandoc finds errors in $page"
done
# Whose code is compiled in is in them: of all headers of the build those that are more than an interface in C.
plain='libc6|linux-libc|libstdc..-.*|libgcc-.*|libpython3.*|libsdl2|zlib1g|libpng|libturbojpeg0|libmeshoptimizer'
plain="$plain|libzstd|uuid|cyclonedds"
tests='libgtest|libkissfft|libosmesa6|libegl|libgl'
for name in $(ninja -C "$build" -t deps | sed -n 's#^ *\(/usr/include/.*\)#\1#p' | sort -u | xargs dpkg -S |
    sed 's/:.*//; s/^libboost[0-9.]*/libboost/' | sort -u | grep -vxE "($plain|$tests)-dev"); do
  grep -qF "($name)" "$root/usr/share/doc/swell/copyright" || fail "no copyright of $name"
done
for words in 'Redistributions in binary form' 'copies or substantial portions' common-licenses/Apache-2.0 \
    'Boost Software License'; do
  grep -qF "$words" "$root/usr/share/doc/swell/copyright" || fail "no licence that says '$words'"
done
desktop-file-validate "$root"/usr/share/applications/*.desktop
for package in "$work"/packages/*.deb; do
  case $(dpkg-deb -f "$package" Maintainer) in *localhost*) fail "the maintainer is nobody" ;; esac
done
# A path of the build in them would give other bytes elsewhere.
found=$(grep -rlF -e "$source" -e "$build" "$root/usr" || true)
[ -z "$found" ] || fail "these files name a folder of the build: $found"

# They depend on no library of images, windows or meshes but where these are what the package is for.
depends() { dpkg-deb -f "$1" Depends; }
for package in "$work"/packages/libswell0_*.deb "$work"/packages/swell_*.deb "$work"/packages/python3-swell_*.deb; do
  case $(depends "$package") in
    *openimageio* | *assimp* | *sdl* | *turbojpeg* | *libegl* | *libgl*)
      fail "$package depends on $(depends "$package")" ;;
  esac
done
case $(depends "$work"/packages/swell_*.deb) in *libtbb*) ;; *) fail "swell does not depend on oneTBB" ;; esac
case $(dpkg-deb -f "$work"/packages/libswell-dev_*.deb Recommends) in
  *libhwy-dev*) ;; *) fail "libswell-dev does not recommend what C++ needs" ;;
esac

# Programs and libraries run, from another place, and draw what those of the build do.
draw() { "$1/swell-render" --scene "$2/open_ocean.toml" --size 64x36 --time 5 --hash; }
[ "$(draw "$root/usr/bin" "$root/usr/share/swell/scenes")" = "$(draw "$build/bin" "$root/usr/share/swell/scenes")" ] ||
  fail "the installed program draws something else"
"$root/usr/bin/swell-view" --version >/dev/null
printf '#include <swell.h>\n#include <stdio.h>\nint main(void) { return puts(swell_version()) < 0; }\n' >"$work/main.c"
cc "$work/main.c" -I"$root/usr/include" -L"$root/usr/lib" -lswell -o "$work/main"
LD_LIBRARY_PATH=$root/usr/lib "$work/main" >/dev/null
if [ -d "$root/usr/lib/python3/dist-packages/swell" ] && /usr/bin/python3 -c 'import numpy' 2>/dev/null; then
  PYTHONPATH=$root/usr/lib/python3/dist-packages LD_LIBRARY_PATH=$root/usr/lib \
    /usr/bin/python3 -B -c 'import swell; print(swell.World)'
fi

# Without the packages of image and mesh files a line says which is missing; with them such files are read.
unpack "$work/bare" "$work"/packages/swell_*.deb
needs() {
  got=$("$work/bare/usr/bin/swell-render" --scene "$2" --size 64x36 --hash 2>&1) && fail "$2 is drawn without $1"
  case $got in *"the Debian package $1 has it"*) ;; *) fail "no word of $1: $got" ;; esac
  "$root/usr/bin/swell-render" --scene "$2" --size 64x36 --hash >/dev/null
}
needs swell-images "$source/scenes/pool.toml"
needs swell-meshes "$source/tests/scenes/crates.toml"
