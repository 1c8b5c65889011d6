#include "apps/sim/ros_inputs.h"

#include <fmt/format.h>

#include "apps/messages/cdr_reader.h"

namespace swell::apps {
namespace {

constexpr std::uint32_t kNanosecondsEnd = 1'000'000'000;

bool is_time(const msg::Time& time) { return time.nanosec < kNanosecondsEnd; }

std::int64_t ns_of(const msg::Time& time) {
  return std::int64_t{time.sec} * kNanosecondsEnd + time.nanosec;
}

}  // namespace

std::string pose_topic(std::string_view frame) { return fmt::format("/{}/pose", frame); }

void take_clock_message(std::span<const std::uint8_t> cdr, const InputOrigin& from,
                        Inputs& inputs) {
  const auto message = read_clock(cdr);
  if (message && is_time(message->clock))
    inputs.put_clock(from, ns_of(message->clock));
  else
    inputs.refuse(from, fmt::format("got {} bytes that are no Clock, allowed rosgraph_msgs/msg/"
                                    "Clock in CDR",
                                    cdr.size()));
}

void take_pose_message(std::span<const std::uint8_t> cdr, std::string_view frame,
                       const InputOrigin& from, Inputs& inputs) {
  const auto message = read_pose_stamped(cdr);
  if (!message || !is_time(message->header.stamp)) {
    inputs.refuse(from, fmt::format("got {} bytes that are no PoseStamped, allowed geometry_msgs/"
                                    "msg/PoseStamped in CDR",
                                    cdr.size()));
    return;
  }
  const std::string& parent = message->header.frame_id;
  if (parent != "map" && parent != "odom" && !parent.empty()) {
    inputs.refuse(from, fmt::format("a pose, got the frame_id \"{}\", allowed map or odom",
                                    parent.substr(0, 100)));
    return;
  }
  const auto& [position, q] = message->pose;
  inputs.put_pose(
      from, frame,
      {ns_of(message->header.stamp), {position.x, position.y, position.z}, {q.w, q.x, q.y, q.z}});
}

}  // namespace swell::apps
