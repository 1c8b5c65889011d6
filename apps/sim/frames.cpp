#include "apps/sim/frames.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "math/elementary.h"
#include "math/view.h"

namespace swell::apps {
namespace {

// From right, ahead, up.
glm::dmat3 ros_axes(const glm::dmat3& axes) { return {axes[1], -axes[0], axes[2]}; }

}  // namespace

FramePose operator*(const FramePose& outer, const FramePose& inner) {
  return {outer.position_m + outer.axes * inner.position_m, outer.axes * inner.axes};
}

FramePose heading_pose(const scene::Waypoint& at) {
  return {at.eye_m, ros_axes(camera_axes(at.heading_rad, at.pitch_rad, at.roll_rad))};
}

FramePose object_frame(const scene::ObjectPose& object) {
  return {object.position_world, ros_axes(object.world_from_object)};
}

scene::ObjectPose frame_object(const FramePose& frame) {
  return {frame.position_m, {-frame.axes[1], frame.axes[0], frame.axes[2]}};
}

// Roll about x, then pitch about y, then yaw about z.
FramePose mounting(const scene::Sensor& sensor) {
  const glm::dvec3 angles = sensor.rpy_rad;
  const double sr = sin(angles.x), cr = cos(angles.x), sp = sin(angles.y), cp = cos(angles.y),
               sy = sin(angles.z), cy = cos(angles.z);
  return {sensor.position_m,
          {{cy * cp, sy * cp, -sp},
           {cy * sp * sr - sy * cr, sy * sp * sr + cy * cr, cp * sr},
           {cy * sp * cr + sy * sr, sy * sp * cr - cy * sr, cp * cr}}};
}

FramePose optical_frame() {
  return {glm::dvec3(0.0), {{0.0, -1.0, 0.0}, {0.0, 0.0, -1.0}, {1.0, 0.0, 0.0}}};
}

FrameMotion motion_between(const FramePose& before, const FramePose& now, const FramePose& after,
                           double h_s) {
  FrameMotion motion;
  motion.velocity_mps = (after.position_m - before.position_m) / (2.0 * h_s);
  motion.acceleration_mps2 =
      (after.position_m - 2.0 * now.position_m + before.position_m) / (h_s * h_s);
  // The rotation from one to the other: its axis times sin and, by its trace, cos of its angle.
  const glm::dmat3 turn = glm::transpose(before.axes) * after.axes;
  const glm::dvec3 axis =
      0.5 * glm::dvec3(turn[1][2] - turn[2][1], turn[2][0] - turn[0][2], turn[0][1] - turn[1][0]);
  const double sine = std::sqrt(glm::dot(axis, axis));
  const double cosine = 0.5 * (turn[0][0] + turn[1][1] + turn[2][2] - 1.0);
  if (sine > 0.0) motion.turn_rad_s = axis * (atan2(sine, cosine) / (sine * 2.0 * h_s));
  return motion;
}

FrameMotion motion_behind(const FramePose& before_2h, const FramePose& before_h,
                          const FramePose& now, double h_s) {
  FrameMotion motion = motion_between(before_2h, before_h, now, h_s);
  motion.velocity_mps += h_s * motion.acceleration_mps2;
  // Means of the two steps, and on by half of what they differ.
  const glm::dvec3 last = motion_between(before_h, before_h, now, 0.5 * h_s).turn_rad_s;
  const glm::dvec3 first = motion_between(before_2h, before_2h, before_h, 0.5 * h_s).turn_rad_s;
  motion.turn_rad_s = last + 0.5 * (last - first);
  return motion;
}

msg::Vector3 vector_message(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

msg::Quaternion quaternion_message(const glm::dmat3& axes) {
  const glm::dquat q = glm::quat_cast(axes);
  return {q.x, q.y, q.z, q.w};
}

msg::Pose pose_message(const FramePose& pose) {
  return {vector_message(pose.position_m), quaternion_message(pose.axes)};
}

msg::TransformStamped transform_message(msg::Time stamp, const std::string& parent,
                                        const std::string& child, const FramePose& pose) {
  return {{stamp, parent}, child, {vector_message(pose.position_m), quaternion_message(pose.axes)}};
}

}  // namespace swell::apps
