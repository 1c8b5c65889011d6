#!/bin/sh
# browser_test.sh PROGRAM SCENE [PICTURES]: the viewer in headless Chromium. 77: there is none, or no driver.
set -eu
program=$1 scene=$2 here=$(dirname "$0")
python=/usr/bin/python3
if ! command -v chromedriver >/dev/null || ! "$python" -c 'import selenium' 2>/dev/null; then
  echo "skipped: no chromedriver or no python3-selenium (packages of the group browser)"
  exit 77
fi
work=$(mktemp -d)
"$program" --scene "$scene" --size 1280x720 --threads 2 --serve 0 >"$work/url" 2>"$work/errors" &
viewer=$!
trap 'kill $viewer 2>/dev/null || true; rm -rf "$work"' EXIT
for _ in $(seq 100); do
  [ -s "$work/url" ] && break
  sleep 0.1
done
"$python" "$here/browser_test.py" "$(head -n 1 "$work/url")" "$viewer" "$work" ${3:+"$3"}
kill -TERM $viewer
wait $viewer
[ ! -s "$work/errors" ] || { cat "$work/errors"; exit 1; }
