#include "apps/view/camera_controls.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"

namespace swell::view {
namespace {

constexpr double kLook_rad_px = 0.0025;
constexpr double kSlowest_mps = 8.0;
constexpr double kSpeedPerHeight_s = 0.5;  // metres a second more for each metre above 16
constexpr double kFastFactor = 6.0;
constexpr double kLongestStep_s = 0.1;
constexpr double kFarthest_m = 1e6;
constexpr double kVertical = 1e-4;  // of a unit vector in the horizontal; views are floats

double axis(bool plus, bool minus) { return (plus ? 1.0 : 0.0) - (minus ? 1.0 : 0.0); }

double wrap_heading(double heading_rad) {
  const double turns = heading_rad / (2.0 * kPi);
  const double wrapped = (turns - std::floor(turns)) * 2.0 * kPi;
  return wrapped < 2.0 * kPi ? wrapped : 0.0;
}

double speed_mps(const CameraPose& pose, bool fast) {
  const double cruise = std::max(kSlowest_mps, kSpeedPerHeight_s * std::abs(pose.eye_m.z));
  return fast ? kFastFactor * cruise : cruise;
}

}  // namespace

bool is_idle(const CameraInput& input) {
  return axis(input.forward, input.back) == 0.0 && axis(input.right, input.left) == 0.0 &&
         axis(input.up, input.down) == 0.0 && input.look_x_px == 0.0 && input.look_y_px == 0.0;
}

CameraPose fly(const CameraPose& pose, const CameraInput& input, double dt_s) {
  CameraPose next = pose;
  next.heading_rad = wrap_heading(pose.heading_rad + kLook_rad_px * input.look_x_px);
  next.pitch_rad = std::clamp(pose.pitch_rad - kLook_rad_px * input.look_y_px, -kPitchLimit_rad,
                              kPitchLimit_rad);

  const double sin_h = sin(next.heading_rad), cos_h = cos(next.heading_rad);
  const double sin_p = sin(next.pitch_rad), cos_p = cos(next.pitch_rad);
  const glm::dvec3 direction =
      axis(input.forward, input.back) * glm::dvec3(sin_h * cos_p, cos_h * cos_p, sin_p) +
      axis(input.right, input.left) * glm::dvec3(cos_h, -sin_h, 0.0) +
      axis(input.up, input.down) * glm::dvec3(0.0, 0.0, 1.0);
  const double length = glm::length(direction);
  if (length < 1e-9) return next;
  const double distance_m = speed_mps(pose, input.fast) * std::clamp(dt_s, 0.0, kLongestStep_s);
  next.eye_m += direction * (distance_m / length);
  next.eye_m = glm::clamp(next.eye_m, -kFarthest_m, kFarthest_m);
  return next;
}

CameraPose pose_of(const View& view) {
  const glm::dvec3 forward(view.forward), right(view.right), up(view.up);
  const double horizontal = std::hypot(forward.x, forward.y);
  // Straight up or down the picture's top says where the heading is.
  const glm::dvec3 ahead = horizontal > kVertical ? forward : (forward.z < 0.0 ? up : -up);
  const double heading_rad = wrap_heading(atan2(ahead.x, ahead.y));

  // What is left is a turn from level axes of the same heading.
  const glm::dvec3 level_right(cos(heading_rad), -sin(heading_rad), 0.0);
  const glm::dvec3 level_up = glm::cross(level_right, forward);
  const double roll_rad = atan2(-glm::dot(right, level_up), glm::dot(right, level_right));
  return {view.eye_world, heading_rad,
          std::clamp(atan2(forward.z, horizontal), -kPitchLimit_rad, kPitchLimit_rad), roll_rad};
}

}  // namespace swell::view
