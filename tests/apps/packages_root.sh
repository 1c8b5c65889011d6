#!/bin/sh
# packages_root.sh BUILD SOURCE [PACKAGES]: installs Debian packages, those of the build or of a folder, into an empty
# Debian 12 of their processor that has Python and NumPy, and draws there what the build does. Prints what apt brings and in
# what time. 77: not root, a tool is missing, or no package is to be had.
set -eu
build=$1
source=$2
most_mb=25  # of python3-swell with all that it needs
[ "$(id -u)" -eq 0 ] || { echo "skipped: not root"; exit 77; }
for tool in cpack dpkg-shlibdeps file mmdebstrap unshare; do
  command -v $tool >/dev/null || { echo "skipped: no $tool"; exit 77; }
done
[ -e "$build/bin/swell-view" ] && [ -e "$build/lib/libswell.so.0" ] && [ -d "$build/python/swell" ] ||
  { echo "skipped: not all is built"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
packages=${3:-}
if [ -z "$packages" ]; then
  packages=$work/packages
  cpack --config "$build/CPackConfig.cmake" -B "$packages" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
fi
architecture=$(dpkg-deb -f "$packages"/libswell0_*.deb Architecture)
# shellcheck source=scripts/debian_root.sh
. "$source/scripts/debian_root.sh"
make_root "$work/root" bookworm "$architecture" python3-numpy || { echo "skipped: no packages"; exit 77; }

names() { dpkg-query --admindir="$root/var/lib/dpkg" -W -f '${Package}\n' | sort; }
kilobytes() { du -sk "$root/usr" | cut -f1; }
# install PACKAGE...: prints what is new.
install() {
  names >"$work/before"
  before_kb=$(kilobytes)
  begin_s=$(date +%s)
  inside sh -c 'cd /swell && for name; do set -- "$@" ./"$name"_*.deb; shift; done && exec apt-get install -qq -y \
    --no-install-recommends "$@"' sh "$@" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
  seconds=$(($(date +%s) - begin_s))
  names | comm -13 "$work/before" - >"$work/new"
  mb=$((($(kilobytes) - before_kb) / 1024))
  echo "$*: $(wc -l <"$work/new") packages, $mb MB, $seconds s: $(paste -sd" " "$work/new")"
}

mkdir "$root/swell"
cp "$packages"/*.deb "$root/swell"
inside apt-get -qq update
install python3-swell libswell0
[ "$mb" -lt $most_mb ] || { echo "error: $mb MB, allowed under $most_mb"; exit 1; }

# The first lines of Python in the documents run, and draw what swell-render does.
cp -r "$source/scenes" "$root/swell"
for page in README.md docs/learn/first_python.md; do
  awk '/^```python/ { inside = 1; next } /^```/ && inside { exit } inside' "$source/$page" >"$root/swell/lines.py"
  inside sh -c 'cd /swell && python3 lines.py'
done
cat >"$root/swell/hash.py" <<'END'
import swell
print("frame 0 xxh3", swell.World("scenes/buoys.toml").render(t=5.0, size=(640, 360)).hash)
END
drawn() { "$@" --scene scenes/buoys.toml --time 5 --size 640x360 --hash; }
here=$(cd "$source" && drawn "$build/bin/swell-render")
[ "$(inside sh -c 'cd /swell && python3 hash.py')" = "$here" ] || { echo "error: Python draws something else"; exit 1; }

# The programs come with their scenes.
install swell
there=$(inside sh -c "cd /usr/share/swell && swell-render --scene scenes/buoys.toml --time 5 --size 640x360 --hash")
[ "$there" = "$here" ] || { echo "error: swell-render draws something else: $there"; exit 1; }
# Nothing is left behind.
inside apt-get -qq -y purge python3-swell libswell0 swell >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
left=$(find "$root/usr" "$root/etc" -path '*swell*')
[ -z "$left" ] || { echo "error: after a purge these are left: $left"; exit 1; }
