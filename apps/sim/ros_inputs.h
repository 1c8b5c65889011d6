// Inputs as messages of ROS 2, whatever brings their bytes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "apps/sim/inputs.h"

namespace swell::apps {

// What --rig-keys says of them.
inline constexpr std::string_view kRosInputsText = R"(
--dds on: messages are topics of ROS 2 over DDS, in real time or with --clock input in lock-step,
reliable and volatile, /tf_static transient local, of the node /swell_sim. A body with pose =
"input" hears its poses on /FRAME/pose (geometry_msgs/msg/PoseStamped, stamped, in "map"), --clock
input the time on /clock; with --inputs neither is heard. One program publishes the pose of a time
and then its clock: they come in this order, and messages of this time have this pose.
ROS_DOMAIN_ID, ROS_LOCALHOST_ONLY, ROS_AUTOMATIC_DISCOVERY_RANGE, ROS_STATIC_PEERS and
CYCLONEDDS_URI are obeyed as by ROS 2's nodes.
)";

// The topic of a body's poses: "/FRAME/pose".
std::string pose_topic(std::string_view frame);

// Puts in what a rosgraph_msgs/msg/Clock says, and a geometry_msgs/msg/PoseStamped of a body, whose
// frame_id is "map", "odom" (which lies on it) or empty. Bytes that are neither are told of.
void take_clock_message(std::span<const std::uint8_t> cdr, const InputOrigin& from, Inputs& inputs);
void take_pose_message(std::span<const std::uint8_t> cdr, std::string_view frame,
                       const InputOrigin& from, Inputs& inputs);

}  // namespace swell::apps
