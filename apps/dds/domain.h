// A participant of a DDS domain, as a node of ROS 2 is one.
#pragma once

#include <dds/dds.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "apps/dds/environment.h"
#include "apps/dds/node_info.h"

namespace swell::apps {

// All of a process is in one.
class DdsDomain {
 public:
  // Opens its ports. Writers that write faster than readers take wait for them if `is_patient`;
  // else they drop the oldest messages and never wait. Throws OptionError for a configuration that
  // Cyclone does not take, std::runtime_error where the domain cannot be joined.
  DdsDomain(const DdsEnvironment& environment, bool is_patient);
  ~DdsDomain();
  DdsDomain(const DdsDomain&) = delete;
  DdsDomain& operator=(const DdsDomain&) = delete;

  dds_entity_t participant() const { return participant_; }
  bool is_patient() const { return is_patient_; }

  // A topic of ROS 2 ("/camera/image_raw", "sensor_msgs/msg/Image"), under the names that its nodes
  // give topics and types in DDS. Throws std::runtime_error.
  dds_entity_t topic(const std::string& name, std::string_view type);

  // An endpoint of the node that this is.
  void add_reader(dds_entity_t reader) { add_endpoint(reader, node_.readers); }
  void add_writer(dds_entity_t writer) { add_endpoint(writer, node_.writers); }

  // Tells other nodes of this one, "/swell_sim", with all endpoints so far. Throws
  // std::runtime_error.
  void announce();

  // Who can hear it, in words: the domain, the interfaces.
  std::string audience() const;

 private:
  class Log;

  void add_endpoint(dds_entity_t endpoint, std::vector<dds_guid_t>& to);

  DdsEnvironment environment_;
  bool is_patient_;
  std::unique_ptr<Log> log_;
  dds_entity_t domain_ = 0, participant_ = 0;
  std::vector<std::string> interfaces_;
  NodeInfo node_;
  dds_entity_t announcer_ = 0;
};

}  // namespace swell::apps
