#!/bin/sh
# An eye that would be inside the ground is lifted as high over it, in each picture of a sheet: by
# programs that stand in for swell-render, on ground 1.5 m high, and for oiiotool.
# Usage: contact_sheets_test.sh SOURCE_FOLDER
set -eu
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

cat >"$scratch/swell-render" <<'END'
#!/bin/sh
for word; do
  case $word in
    'camera.eye_m[2]='*) eye_m=${word#*=} ;;
    *.png) : >"$word" ;;
  esac
done
echo "$eye_m" >>"$(dirname "$0")/eyes"
if awk "BEGIN { exit !($eye_m < 1.5) }"; then
  echo "warning: frame 0: the camera is inside the ground, at $eye_m m where the ground is at" \
    '1.50 m; what it sees from there is not drawn right' >&2
fi
END
echo '#!/bin/sh' >"$scratch/oiiotool"
chmod +x "$scratch/swell-render" "$scratch/oiiotool"

PATH=$scratch:$PATH SWELL_BIN=$scratch "$1/scripts/contact_sheets.sh" beach "$scratch" 2>"$scratch/said"
[ ! -s "$scratch/said" ] || { echo "said:"; cat "$scratch/said"; exit 1; }
for eye_and_count in 0.3:5 1.8:5 2:5 10:30; do
  count=$(grep -cx "${eye_and_count%:*}" "$scratch/eyes" || true)
  [ "$count" = "${eye_and_count#*:}" ] || { echo "eyes:"; cat "$scratch/eyes"; exit 1; }
done
