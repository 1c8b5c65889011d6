#!/bin/sh
# Does swell-sim hold real time in each output? For a machine that does nothing else:
#   scripts/sim_real_time.sh [BIN [SECONDS [THREADS]]]      (build/release/bin, 60, 2)
# A camera of 640x360 with depth, classes and ids at 20 Hz, a lidar of 32 beams at 10 Hz and 20 wave
# probes at 100 Hz on the harbour's launch go into a recording, to DDS and to Gazebo's transport, one
# after the other; packets stay on this machine. Prints the table of costs of each; ends with 1 if
# real time was not held in one of them, as --measure says.
set -eu
source=$(cd "$(dirname "$0")/.." && pwd)
bin=${1:-$source/build/release/bin} seconds=${2:-60} threads=${3:-2}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

rig=$scratch/rig.toml
cat > "$rig" <<'END'
clock_hz = 100
[[body]]
mount = "launch"
[[camera]]
name = "camera"
body = "base_link"
position_m = [1.6, 0.0, 1.9]
rpy_deg = [0, 5, 0]
fov_y_deg = 56
rate_hz = 20
width_px = 640
height_px = 360
depth = true
class = true
id = true
[[lidar]]
name = "lidar"
body = "base_link"
position_m = [0.4, 0.0, 2.4]
pattern = "hdl-32e"
rate_hz = 10
farthest_m = 100
reach_m = 60
range_noise_m = 0.02
END
n=0
while [ $n -lt 20 ]; do
  printf '[[wave_probe]]\nname = "probe_%d"\nposition_m = [%d, %d, 0]\nrate_hz = 100\n' \
    $n $((n % 5 * 14 - 30)) $((n / 5 * 18 - 60)) >> "$rig"
  n=$((n + 1))
done

held=0
run() {
  name=$1
  shift
  echo "== $name, $seconds s, $threads threads"
  "$bin/swell-sim" --scene "$source/scenes/harbour.toml" --rig "$rig" --measure --realtime --duration "$seconds" \
    --threads "$threads" "$@" > "$scratch/said" || { held=1; return; }
  grep -v wave_probe "$scratch/said"
  grep -qx "real time was held" "$scratch/said" || held=1
}
ROS_LOCALHOST_ONLY=1 IGN_IP=127.0.0.1 GZ_IP=127.0.0.1
IGN_PARTITION=swell_$$ GZ_PARTITION=swell_$$
export ROS_LOCALHOST_ONLY IGN_IP GZ_IP IGN_PARTITION GZ_PARTITION
run "recording" --record "$scratch/run.mcap"
run "DDS" --dds on
run "Gazebo" --gazebo on
exit $held
