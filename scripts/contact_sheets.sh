#!/bin/sh
# Contact sheets of a scene: six heights (across) by five heights of the sun (down) at one wind, and
# five winds (across) by the same suns at 10 m.
#   scripts/contact_sheets.sh NAME OUT_FOLDER     NAME: a scene of scenes/
# Needs swell-render in SWELL_BIN (build/release/bin) and oiiotool (Debian: openimageio-tools).
set -eu
cd "$(dirname "$0")/.."
name=$1 out=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# render FILE EYE_HEIGHT_M PITCH_DEG SUN_ELEVATION_DEG WIND_MPS
render() {
  "${SWELL_BIN:-build/release/bin}/swell-render" --scene "scenes/$name.toml" --set "camera.eye_m[2]=$2" \
    --set "camera.pitch_deg=$3" --set "sky.sun_elevation_deg=$4" --set "wind.speed_mps=$5" \
    --size 192x108 --time 5 --out "$1" 2>"$work/said"
}

# The same; an eye that would be inside the ground is as high over that.
draw() {
  render "$@" || { cat "$work/said" >&2; exit 1; }
  ground=$(sed -n 's/.*inside the ground.*the ground is at \([0-9.]*\) m.*/\1/p' "$work/said")
  if [ -n "$ground" ]; then
    file=$1 eye=$(awk "BEGIN { print $2 + $ground }")
    shift 2
    render "$file" "$eye" "$@"
  fi
  grep warning: "$work/said" >&2 || true
}

suns="-5 2 10 40 80"
for sun in $suns; do
  for place in "0.3 0" "2 -3" "10 -7" "60 -12" "1500 -15" "40000 -20"; do
    # shellcheck disable=SC2086
    draw "$work/heights_$(printf %03d $((sun + 90)))_${place%% *}.png" $place "$sun" 12
  done
  for wind in 0 5 12 20 35; do
    draw "$work/winds_$(printf %03d $((sun + 90)))_$wind.png" 10 -7 "$sun" "$wind"
  done
done
for sheet in heights winds; do
  columns=$([ $sheet = heights ] && echo 6 || echo 5)
  # shellcheck disable=SC2046
  oiiotool $(ls -v "$work/$sheet"_*.png) --mosaic "${columns}x5" -o "$out/sheet_${name}_$sheet.png"
done
