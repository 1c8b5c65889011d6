// What a node of ROS 2 tells the others of itself, so that `ros2 node list` and `ros2 node info`
// show it.
#pragma once

#include <dds/dds.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace swell::apps {

inline constexpr const char* kNodeInfoTopic = "ros_discovery_info";
inline constexpr const char* kNodeInfoType = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_";

// A participant's only node, in the root namespace.
struct NodeInfo {
  std::string name;
  dds_guid_t participant{};
  std::vector<dds_guid_t> readers{}, writers{};
};

// rmw_dds_common's ParticipantEntitiesInfo in CDR. An identifier has 24 bytes up to Humble, 16 from
// Iron on; nodes of these read of 24 a participant without nodes.
std::vector<std::uint8_t> node_info_bytes(const NodeInfo& node, std::size_t gid_bytes);

}  // namespace swell::apps
