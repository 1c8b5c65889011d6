#!/bin/sh
# wheel_root_test.sh PYTHON BUILD SOURCE: in a new root of Debian 12 with Python and NumPy, pip installs the wheel into an
# environment of its own, and README's lines draw a picture. Prints how long it took and what it needs. 77: without root,
# or a program.
set -eu
python=$1 build=$2 source=$3
for tool in mmdebstrap patchelf; do
  command -v $tool >/dev/null || { echo "skipped: no $tool"; exit 77; }
done
[ "$(id -u)" -eq 0 ] || { echo "skipped: chroot needs root"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
wheel=$("$python" -B "$source/scripts/write_wheel.py" "$build" "$work")

# shellcheck disable=SC2016 # apt-get's own names
mirror=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' | grep -v security | head -1)
root=$work/root
mmdebstrap --quiet --variant=apt --include=python3-venv,python3-numpy bookworm "$root" "$mirror"
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C "$@"; }
inside sh -c '! find /usr/lib -name "libtbb*" | grep .'

inside python3 -m venv --system-site-packages /sea
cp "$wheel" "$root"
begin_s=$(date +%s.%N) before_kb=$(du -sk "$root/sea" | cut -f1)
inside sh -c '/sea/bin/pip install --quiet --no-index /swell-*.whl'
installed_s=$(date +%s.%N) after_kb=$(du -sk "$root/sea" | cut -f1)
# shellcheck disable=SC2016 # marks of Markdown
sed -n '/^```python/,/^```$/p' "$source/README.md" | grep -v '^```' >"$root/lines.py"
inside sh -c 'cd /sea/share/swell && /sea/bin/python3 /lines.py' | grep '^(720, 1280) \['
echo "$begin_s $installed_s $(date +%s.%N) $before_kb $after_kb $(stat -c %s "$wheel")" | awk '{
  printf "wheel %.1f MB, installed %.1f MB in %.1f s, drawn in %.1f s\n", $6 / 1e6, ($5 - $4) / 1e3, $2 - $1, $3 - $2 }'
