// What ROS 2's environment variables ask of its DDS: which domain, and who hears it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace swell::apps {

// Who finds a node by itself.
enum class DiscoveryRange : std::uint8_t { kOff, kThisMachine, kSubnet, kSystemDefault };

struct DdsEnvironment {
  std::uint32_t domain = 0;
  DiscoveryRange range = DiscoveryRange::kSubnet;
  bool is_loopback_alone = false;  // no packet leaves this machine
  std::size_t gid_bytes = 24;      // of identifiers in what nodes tell of themselves (node_info.h)
  std::string configuration;       // Cyclone's, in XML; parts with commas between them
};

// Reads them by `variable`, which gives "" for those that are not set:
//   ROS_DOMAIN_ID                  0 to 232; 0
//   ROS_LOCALHOST_ONLY             1: the loopback interface alone, whatever the range; 0. Nodes of
//                                  Humble do likewise; those of Iron and later that run on Cyclone
//                                  stay on others and want LOCALHOST below
//   ROS_AUTOMATIC_DISCOVERY_RANGE  OFF, LOCALHOST, SUBNET or SYSTEM_DEFAULT; SUBNET
//   ROS_STATIC_PEERS               hosts that are looked for besides, with ; between them
//   ROS_DISTRO                     identifiers have 24 bytes up to humble and where it is not set,
//                                  16 with later ones
//   CYCLONEDDS_URI                 Cyclone's configuration, which comes last
// Discovery is configured as ROS 2's nodes configure it (rmw_cyclonedds: interfaces of Humble,
// ranges of Iron and later). Throws OptionError for other values.
//   is_ordered: what one publisher sends on several topics comes in its order. Cyclone sends what
//   several subscribers hear by multicast, which overtakes what is sent to one; others send nothing
//   but discovery by multicast to a participant that wants no more.
DdsEnvironment read_dds_environment(const std::function<std::string(const char*)>& variable,
                                    bool is_ordered);

}  // namespace swell::apps
