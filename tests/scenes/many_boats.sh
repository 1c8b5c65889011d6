#!/bin/sh
# Prints a scene of COUNT boats (1000 unless given) on 900 x 900 m of sea around the camera, which
# sees a quarter of them: tests/scenes/many_boats.sh 1000 > boats.toml
awk -v count="${1:-1000}" '
# Numbers in [0, 1): the same everywhere (Park and Miller, 1988).
function uniform() { state = (state * 16807) % 2147483647; return state / 2147483647 }
BEGIN {
  state = 42
  print "[camera]\neye_m = [0.0, 0.0, 6.0]\nheading_deg = 30.0\npitch_deg = -3.0\nfov_y_deg = 50.0\n"
  print "[sky]\nsun_azimuth_deg = 100.0\nsun_elevation_deg = 30.0\ncloud_cover = 0.3\n"
  print "[wind]\nspeed_mps = 6.0\nfrom_deg = 200.0\n\n[sea]\nseed = 5\n\n[picture]\nedge_samples = 4"
  for (i = 0; i < count; ++i) {
    x = 900 * uniform() - 450; y = 900 * uniform() - 450; heading = 360 * uniform()
    printf "\n[[object]]\nkind = \"boat\"\nposition_m = [%.1f, %.1f]\nheading_deg = %.0f\n", x, y, heading
    printf "colour = [%.2f, %.2f, %.2f]\n", uniform(), uniform(), uniform()
  }
}'
