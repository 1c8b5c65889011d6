#!/bin/sh
# Contact sheets of a scene: six heights (across) by five heights of the sun (down) at one wind, and
# five winds (across) by the same suns at 10 m.
#   scripts/contact_sheets.sh NAME OUT_FOLDER     NAME: a scene of scenes/
# Needs build/release/bin/swell-render and oiiotool (Debian: openimageio-tools).
set -eu
cd "$(dirname "$0")/.."
name=$1 out=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# draw FILE EYE_HEIGHT_M PITCH_DEG SUN_ELEVATION_DEG WIND_MPS
draw() {
  awk -v z="$2" -v pitch="$3" -v sun="$4" -v wind="$5" '
    /^\[/ { table = $0 }
    table == "[camera]" && /^eye_m/ { split($0, p, /[][,]/); $0 = "eye_m = [" p[2] ", " p[3] ", " z "]" }
    table == "[camera]" && /^pitch_deg/ { $0 = "pitch_deg = " pitch }
    table == "[sky]" && /^sun_elevation_deg/ { $0 = "sun_elevation_deg = " sun }
    table == "[wind]" && /^speed_mps/ { $0 = "speed_mps = " wind }
    { print }' "scenes/$name.toml" >"$work/scene.toml"
  build/release/bin/swell-render --scene "$work/scene.toml" --size 192x108 --time 5 --out "$1" 2>/dev/null
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
