#include "apps/gazebo/inbound.h"

#include <algorithm>

#include "apps/gazebo/convert.h"

namespace swell::apps {
namespace {

constexpr const char* kAllowedTimes = ", allowed 0 to 2^31 s";

void take_pose_at(std::string_view topic, const gz_msgs::Pose& pose, const gz_msgs::Time& stamp,
                  std::span<const std::string> frames, std::string_view topic_frame,
                  const GazeboTakers& takers) {
  const std::string_view frame = pose.name().empty() ? topic_frame : pose.name();
  if (std::ranges::count(frames, frame) == 0) return;
  const auto t_ns = time_ns(stamp);
  if (!t_ns) {
    takers.refuse(topic, std::string("a pose, got another stamp") + kAllowedTimes);
    return;
  }
  const auto& p = pose.position();
  const auto& q = pose.orientation();
  takers.pose(topic, frame, *t_ns, {{p.x(), p.y(), p.z()}, {q.x(), q.y(), q.z(), q.w()}});
}

}  // namespace

void take_clock(std::string_view topic, const gz_msgs::Clock& clock, const GazeboTakers& takers) {
  const auto t_ns = time_ns(clock.sim());
  if (clock.has_sim() && t_ns)
    takers.clock(topic, *t_ns);
  else
    takers.refuse(topic, std::string("a clock, got none in sim or another time") + kAllowedTimes);
}

void take_pose(std::string_view topic, const gz_msgs::Pose& pose,
               std::span<const std::string> frames, std::string_view topic_frame,
               const GazeboTakers& takers) {
  take_pose_at(topic, pose, pose.header().stamp(), frames, topic_frame, takers);
}

void take_poses(std::string_view topic, const gz_msgs::Pose_V& poses,
                std::span<const std::string> frames, std::string_view topic_frame,
                const GazeboTakers& takers) {
  for (const gz_msgs::Pose& pose : poses.pose()) {
    const gz_msgs::Header& header = pose.header().has_stamp() ? pose.header() : poses.header();
    take_pose_at(topic, pose, header.stamp(), frames, topic_frame, takers);
  }
}

}  // namespace swell::apps
