#include "apps/gazebo/gazebo_inputs.h"

#include <fmt/format.h>

#include <cstddef>
#include <mutex>
#include <vector>

#include "apps/gazebo/inbound.h"
#include "apps/shared/program.h"

namespace swell::apps {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 30;

bool is_read(const char* bytes, std::size_t size, google::protobuf::Message& message) {
#if GOOGLE_PROTOBUF_VERSION < 4022000  // newer ones write by Abseil's log
  const google::protobuf::LogSilencer silencer;
#endif
  return size <= kMostBytes && message.ParseFromArray(bytes, static_cast<int>(size));
}

}  // namespace

struct GazeboInputs::State {
  // What the handlers share: the transport may call them once more while it is closed.
  struct Listening {
    std::mutex mutex;
    bool is_over = false;
    std::vector<std::string> frames;
    GazeboTakers takers;
  };

  // Bytes that are no such message are told of as all that is wrong is: the libraries would write
  // lines of their own for each.
  template <class Message, class Take>
  void listen(const std::string& topic, const Take& take) {
    const std::string type = Message().GetTypeName();
    const auto handle = [to = listening, topic, type, take](const char* bytes, std::size_t size,
                                                            const gz_transport::MessageInfo&) {
      const std::lock_guard lock(to->mutex);
      if (to->is_over) return;
      Message message;
      if (is_read(bytes, size, message))
        take(message, *to);
      else
        to->takers.refuse(topic, fmt::format("got {} bytes that are no {}", size, type));
    };
    if (!node.SubscribeRaw(topic, handle, type))
      throw OptionError(
          fmt::format("command line: --gazebo-poses: got '{}', allowed a name that "
                      "Gazebo's transport takes",
                      topic));
  }

  // `frame`: of poses without a name.
  void listen_to_poses(const std::string& topic, const std::string& frame) {
    listen<gz_msgs::Pose>(topic, [topic, frame](const gz_msgs::Pose& pose, const Listening& to) {
      take_pose(topic, pose, to.frames, frame, to.takers);
    });
    listen<gz_msgs::Pose_V>(topic,
                            [topic, frame](const gz_msgs::Pose_V& poses, const Listening& to) {
                              take_poses(topic, poses, to.frames, frame, to.takers);
                            });
  }

  std::shared_ptr<Listening> listening = std::make_shared<Listening>();
  gz_transport::Node node;
};

GazeboInputs::GazeboInputs(const GazeboInputTopics& topics, GazeboTakers takers)
    : state_(std::make_unique<State>()) {
  state_->listening->frames.assign(topics.frames.begin(), topics.frames.end());
  state_->listening->takers = std::move(takers);
  if (topics.has_clock)
    state_->listen<gz_msgs::Clock>("/clock",
                                   [](const gz_msgs::Clock& clock, const State::Listening& to) {
                                     take_clock("/clock", clock, to.takers);
                                   });
  if (!topics.poses.empty())
    state_->listen_to_poses(topics.poses, "");
  else
    for (const std::string& frame : topics.frames)
      state_->listen_to_poses("/model/" + frame + "/pose", frame);
}

GazeboInputs::~GazeboInputs() {
  const std::lock_guard lock(state_->listening->mutex);
  state_->listening->is_over = true;
}

}  // namespace swell::apps
