#include "apps/gazebo/gazebo_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <thread>
#include <variant>
#include <vector>

#include "apps/gazebo/convert.h"
#include "apps/gazebo/water_services.h"
#include "apps/shared/program.h"

namespace swell::apps {
namespace {

constexpr std::int64_t kRepeat_ns = 1'000'000'000;  // of kept topics
// The transport does not say what it has sent, and drops the rest when the program ends.
constexpr std::chrono::milliseconds kLastSending{500};

// The number of the topic of the ids of the camera whose classes `topic` carries.
std::optional<std::size_t> ids_beside(std::string topic, std::span<const Topic> topics) {
  constexpr std::string_view kClasses = "/class";
  topic.replace(topic.size() - kClasses.size(), kClasses.size(), "/id");
  const auto found = std::ranges::find(topics, topic, &Topic::name);
  if (found == topics.end()) return std::nullopt;
  return static_cast<std::size_t>(found - topics.begin());
}

// The services keep what they answer with: the transport may call them while it is closed.
template <class Request, class Reply>
void offer(const char* name, bool (WaterServices::*answer)(const Request&, Reply&),
           const std::shared_ptr<WaterServices>& services, gz_transport::Node& node) {
  std::function<bool(const Request&, Reply&)> call = [services, answer](const Request& request,
                                                                        Reply& reply) {
    return ((*services).*answer)(request, reply);
  };
  if (!node.Advertise(name, call))
    throw OptionError(fmt::format("command line: --gazebo, got no service {}", name));
}

}  // namespace

struct GazeboOutput::State {
  struct Channel {
    GazeboTopic topic;
    gz_transport::Node::Publisher publisher;  // not valid: Gazebo has no such message
    std::unique_ptr<GazeboMessage> message;
    bool is_kept = false;
    std::optional<msg::Message> kept;
    // The channel of the same camera's ids, of classes; and the last classes, of ids.
    std::optional<std::size_t> ids;
    std::optional<msg::Image> classes;

    void publish(const msg::Message& from);
    void fill(const msg::Message& from);
  };

  std::shared_ptr<WaterServices> services;
  std::vector<Channel> channels;  // of the topics
  std::int64_t second = -1;       // that the last stamp lay in
  gz_transport::Node node;
};

void GazeboOutput::State::Channel::publish(const msg::Message& from) {
  if (!publisher.HasConnections()) return;
  fill(from);
  publisher.Publish(*message);
}

void GazeboOutput::State::Channel::fill(const msg::Message& from) {
  const auto* image = std::get_if<msg::Image>(&from);
  if (!image || topic.use == ImageUse::kPicture) return convert(from, *message);
  auto& labels = static_cast<gz_msgs::Image&>(*message);
  if (topic.use == ImageUse::kClasses) return convert_classes(*image, labels);
  convert_ids(*image, classes ? &*classes : nullptr, labels);
}

GazeboOutput::GazeboOutput(std::span<const Topic> topics, const scene::Water& water)
    : state_(std::make_unique<State>()) {
  state_->services = std::make_shared<WaterServices>(water);
  for (const Topic& topic : topics) {
    State::Channel& channel = state_->channels.emplace_back();
    channel.topic = gazebo_topic(topic);
    channel.message = gazebo_message(topic.type);
    channel.is_kept = topic.is_kept;
    if (!channel.message) continue;
    if (channel.topic.use == ImageUse::kClasses) channel.ids = ids_beside(topic.name, topics);
    channel.publisher = state_->node.Advertise(channel.topic.name, channel.message->GetTypeName());
    if (!channel.publisher)
      throw OptionError(
          fmt::format("command line: --gazebo, got the topic {}, allowed names that "
                      "Gazebo's transport takes, once each",
                      channel.topic.name));
  }
  offer(WaterServices::kHeights, &WaterServices::heights, state_->services, state_->node);
  offer(WaterServices::kSeaState, &WaterServices::sea_state, state_->services, state_->node);
}

GazeboOutput::~GazeboOutput() = default;

void check_gazebo() {}

std::string GazeboOutput::audience() const {
  const std::string host = gz_transport::determineHost();
  return fmt::format("gazebo: partition {} ({}), address {} ({}): {} can hear it",
                     state_->node.Options().Partition(), kGazeboPartition, host, kGazeboIp,
                     host.starts_with("127.") ? "this machine alone" : "its whole network");
}

void GazeboOutput::write(std::size_t topic, std::int64_t stamp_ns, const msg::Message& message) {
  state_->services->set_time(stamp_ns);
  auto& channels = state_->channels;
  if (const std::int64_t second = stamp_ns / kRepeat_ns; second != state_->second) {
    for (State::Channel& channel : channels)
      if (channel.kept) channel.publish(*channel.kept);
    state_->second = second;
  }
  State::Channel& channel = channels[topic];
  if (!channel.message) return;
  if (channel.is_kept) channel.kept = message;
  if (channel.ids) channels[*channel.ids].classes = std::get<msg::Image>(message);
  channel.publish(message);
}

void GazeboOutput::finish() {
  const auto is_heard = [](const State::Channel& channel) {
    return channel.publisher.HasConnections();
  };
  if (std::ranges::any_of(state_->channels, is_heard)) std::this_thread::sleep_for(kLastSending);
}

}  // namespace swell::apps
