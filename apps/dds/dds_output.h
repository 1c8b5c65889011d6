// A simulation's messages as topics of ROS 2, over DDS.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "apps/dds/domain.h"
#include "apps/messages/message_output.h"

namespace swell::apps {

// Writers are reliable and volatile, as ROS 2's are by default, which serves subscribers of both
// kinds: best effort (sensor data) asks for less. They keep ten messages, or all in a patient
// domain until those who asked for them have them. Topics that are kept are transient local, with
// one message.
class DdsOutput : public MessageOutput {
 public:
  // The domain has to outlive it. Throws std::runtime_error.
  DdsOutput(DdsDomain& domain, std::span<const Topic> topics);

  // One line says so the first time that a topic's message could not be given away.
  void write(std::size_t topic, std::int64_t stamp_ns, const msg::Message& message) override;

  // Waits until reliable subscribers have all of it, at most a second.
  void finish() override;

 private:
  struct Writer {
    std::string name;
    dds_entity_t entity = 0;
    bool is_fault_told = false;
  };
  std::vector<Writer> writers_;
};

}  // namespace swell::apps
