#include "apps/sim/input_poses.h"

#include <algorithm>

#include "math/elementary.h"

namespace swell::apps {
namespace {

constexpr std::size_t kMostPoses = 20'000;
constexpr std::int64_t kKept_ns = 10'000'000'000, kStill_ns = 1'000'000'000;

// The orientation a share of the way from one to the other, by the shorter turn.
glm::dquat turned(const glm::dquat& from, glm::dquat to, double share) {
  if (glm::dot(from, to) < 0.0) to = -to;
  // |a - b| and |a + b| are twice the sine and the cosine of half the angle between them.
  const double angle = 2.0 * atan2(glm::length(from - to), glm::length(from + to));
  const double sine = sin(angle);
  if (sine < 1e-9) return glm::normalize(from * (1.0 - share) + to * share);
  return glm::normalize(from * (sin((1.0 - share) * angle) / sine) +
                        to * (sin(share * angle) / sine));
}

FramePose frame_pose(const glm::dvec3& position_m, const glm::dquat& orientation) {
  return {position_m, glm::mat3_cast(orientation)};
}

}  // namespace

bool InputPoses::add(std::string_view frame, const StampedPose& pose) {
  auto found = tracks_.find(frame);
  if (found == tracks_.end()) found = tracks_.emplace(std::string(frame), Track()).first;
  Track& track = found->second;
  const auto at = std::ranges::lower_bound(track, pose.stamp_ns, {}, &StampedPose::stamp_ns);
  if (at != track.end() && at->stamp_ns == pose.stamp_ns) {
    const bool is_new = *at != pose;
    *at = pose;
    return is_new;
  }
  track.insert(at, pose);
  if (track.size() > kMostPoses) track.pop_back();  // the one that is farthest ahead
  return true;
}

bool InputPoses::reaches(std::string_view frame, const Moment& moment) const {
  const Track* track = find(frame);
  return track && track->back().stamp_ns >= moment.t_ns;
}

void InputPoses::set_horizon(const Moment& moment) {
  horizon_ns_ = moment.t_ns;
  for (auto& [frame, track] : tracks_) {
    const std::size_t old = count_until(track, horizon_ns_ - kKept_ns);
    if (old > 1) track.erase(track.begin(), track.begin() + static_cast<std::ptrdiff_t>(old - 1));
  }
}

std::optional<FramePose> InputPoses::at(std::string_view frame, const Moment& moment) const {
  const Track* track = find(frame);
  const std::size_t count = track ? count_until(*track, moment.t_ns) : 0;
  if (count == 0) return std::nullopt;
  const StampedPose& before = (*track)[count - 1];
  if (count == count_until(*track, horizon_ns_))
    return frame_pose(before.position_m, before.orientation);
  const StampedPose& after = (*track)[count];
  const double share = static_cast<double>(moment.t_ns - before.stamp_ns) /
                       static_cast<double>(after.stamp_ns - before.stamp_ns);
  return frame_pose(before.position_m + share * (after.position_m - before.position_m),
                    turned(before.orientation, after.orientation, share));
}

std::optional<InputPoses::Window> InputPoses::motion_window(std::string_view frame,
                                                            const Moment& moment) const {
  const Track* track = find(frame);
  const std::size_t count = track ? count_until(*track, moment.t_ns) : 0;
  if (count == 0) return std::nullopt;
  const std::int64_t last_ns = (*track)[count - 1].stamp_ns;
  Window window{moment, kMotionStep_ns};
  if (count > 1) window.step_ns = std::max(window.step_ns, last_ns - (*track)[count - 2].stamp_ns);
  const bool is_last = count == count_until(*track, horizon_ns_);
  const bool is_still = is_last && moment.t_ns - last_ns > std::max(kStill_ns, 2 * window.step_ns);
  if (is_still) return window;  // the last pose thrice
  if (is_last) window.end = {last_ns};
  if (window.end.t_ns - 2 * window.step_ns < track->front().stamp_ns) return std::nullopt;
  return window;
}

const InputPoses::Track* InputPoses::find(std::string_view frame) const {
  const auto found = tracks_.find(frame);
  return found == tracks_.end() ? nullptr : &found->second;
}

std::size_t InputPoses::count_until(const Track& track, std::int64_t t_ns) const {
  const auto end =
      std::ranges::upper_bound(track, std::min(t_ns, horizon_ns_), {}, &StampedPose::stamp_ns);
  return static_cast<std::size_t>(end - track.begin());
}

}  // namespace swell::apps
