#!/bin/sh
# loopback_test.sh BIN PEER SCENE RIG: in a network namespace of its own with a second interface, which counts what goes
# out: under ROS_LOCALHOST_ONLY=1 and ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST nothing does, and a subscriber hears the
# topics; without them something does, so that the counter is known to count. 77: no such namespace may be made.
set -eu
if [ "${SWELL_IN_NAMESPACE:-}" != 1 ]; then
  if unshare -rn true 2>/dev/null; then
    exec env SWELL_IN_NAMESPACE=1 unshare -rn "$0" "$@"
  fi
  unshare -n true 2>/dev/null || { echo "skipped: no network namespace may be made"; exit 77; }
  exec env SWELL_IN_NAMESPACE=1 unshare -n "$0" "$@"
fi
bin=$1
peer=$2
scene=$3
rig=$4
ip link set lo up
ip link add second type dummy 2>/dev/null ||
  ip link add second type veth peer name other 2>/dev/null ||
  { echo "skipped: no second interface may be made"; exit 77; }
ip link show other >/dev/null 2>&1 && ip link set other up
ip link set second addrgenmode none multicast on
ip addr add 10.77.0.1/24 dev second
ip link set second up
sleep 0.5

sent() { sed -n 's/^ *second: *//p' /proc/self/net/dev | awk '{print $10}'; }

# run URI: packets that went out while it ran; the lines of a subscriber with this configuration are in the file `heard`.
run() {
  before=$(sent)
  "$bin/swell-sim" --scene "$scene" --rig "$rig" --rig-set body[0].pose=rig --rig-set "body[0].position_m=[0, 0, 0]" \
    --dds on --duration 5 2>/dev/null &
  (sleep 4) | CYCLONEDDS_URI=$1 "$peer" read /probe=geometry_msgs/msg/PointStamped >heard 2>/dev/null || true
  wait
  echo $(($(sent) - before))
}

# alone VARIABLE=VALUE URI: nothing goes out, and a subscriber that is configured as ROS 2's nodes are then hears the
# topics.
alone() {
  out=$(export "$1" && run "$2")
  lines=$(grep -c '^/probe ' heard || true)
  echo "$1: $out packets out, $lines messages heard"
  [ "$out" -eq 0 ] && [ "$lines" -gt 20 ] || is_right=false
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
is_right=true
alone ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST "<General><AllowMulticast>false</AllowMulticast></General><Discovery>\
<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>32</MaxAutoParticipantIndex>\
<Peers><Peer address='localhost'/></Peers></Discovery>"
ip link set lo multicast on
alone ROS_LOCALHOST_ONLY=1 "<General><Interfaces><NetworkInterface address='127.0.0.1'/></Interfaces></General>"
out=$(run "")
echo "without them: $out packets out"
[ "$out" -gt 0 ] && $is_right
