#include "apps/mcap/mcap_output.h"

#include <algorithm>

#include "apps/messages/cdr.h"
#include "apps/messages/definitions.h"
#include "apps/shared/version.h"

namespace swell::apps {
namespace {

// With which ros2 bag play publishes a topic: reliable, the last messages kept (transient local).
// As bags have it, in YAML and with the numbers of rmw's enumerations.
constexpr std::string_view kKeptProfile = R"(- history: 1
  depth: 100
  reliability: 1
  durability: 1
  deadline:
    sec: 9223372036
    nsec: 854775807
  lifespan:
    sec: 9223372036
    nsec: 854775807
  liveliness: 1
  liveliness_lease_duration:
    sec: 9223372036
    nsec: 854775807
  avoid_ros_namespace_conventions: false
)";

McapContents contents_of(std::span<const Topic> topics) {
  McapContents contents{"ros2", "swell " + version(), {}, {}};
  for (const Topic& topic : topics) {
    auto& schemas = contents.schemas;
    const auto found = std::ranges::find(schemas, topic.type, &McapSchema::name);
    const auto schema = static_cast<std::size_t>(found - schemas.begin());
    if (found == schemas.end())
      schemas.push_back({std::string(topic.type), "ros2msg", message_definition(topic.type)});
    McapChannel channel{schema, topic.name, "cdr"};
    if (topic.is_kept) channel.metadata.emplace_back("offered_qos_profiles", kKeptProfile);
    contents.channels.push_back(std::move(channel));
  }
  return contents;
}

}  // namespace

McapOutput::McapOutput(const std::filesystem::path& path, std::span<const Topic> topics)
    : writer_(path, contents_of(topics)) {}

void McapOutput::write(std::size_t topic, std::int64_t stamp_ns, const msg::Message& message) {
  writer_.add(topic, stamp_ns, cdr_bytes(message));
}

void McapOutput::finish() { writer_.finish(); }

}  // namespace swell::apps
