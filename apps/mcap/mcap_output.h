// A simulation's messages as an MCAP file that ROS 2 and Foxglove open.
#pragma once

#include <filesystem>
#include <span>

#include "apps/mcap/mcap_writer.h"
#include "apps/messages/message_output.h"

namespace swell::apps {

// PATH.partial until finish() (mcap_writer.h). A message is logged and published at its stamp.
class McapOutput : public MessageOutput {
 public:
  McapOutput(const std::filesystem::path& path, std::span<const Topic> topics);

  void write(std::size_t topic, std::int64_t stamp_ns, const msg::Message& message) override;
  void finish() override;

 private:
  McapWriter writer_;
};

}  // namespace swell::apps
