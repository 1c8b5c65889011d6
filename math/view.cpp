#include "math/view.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "math/check.h"
#include "math/elementary.h"

namespace swell {
namespace {

glm::mat4 clip_from_rel(const View& view) {
  const glm::vec3 row_x = (view.right - view.forward * view.tan_middle_x) / view.tan_half_x;
  const glm::vec3 row_y = (view.up - view.forward * view.tan_middle_y) / view.tan_half_y;
  return glm::transpose(glm::mat4(  // rows
      glm::vec4(row_x, 0.0f), glm::vec4(row_y, 0.0f), glm::vec4(0.0f, 0.0f, 0.0f, view.near_m),
      glm::vec4(view.forward, 0.0f)));
}

}  // namespace

glm::dmat3 camera_axes(double heading_rad, double pitch_rad, double roll_rad) {
  SWELL_CHECK(std::isfinite(heading_rad), "heading_rad={}", heading_rad);
  SWELL_CHECK(std::isfinite(pitch_rad), "pitch_rad={}", pitch_rad);
  SWELL_CHECK(std::isfinite(roll_rad), "roll_rad={}", roll_rad);
  const double sin_h = sin(heading_rad), cos_h = cos(heading_rad);
  const double sin_p = sin(pitch_rad), cos_p = cos(pitch_rad);
  const glm::dvec3 right(cos_h, -sin_h, 0.0);
  const glm::dvec3 ahead(sin_h * cos_p, cos_h * cos_p, sin_p);
  const glm::dvec3 up(-sin_h * sin_p, -cos_h * sin_p, cos_p);
  if (roll_rad == 0.0) return {right, ahead, up};
  const double sin_r = sin(roll_rad), cos_r = cos(roll_rad);
  return {cos_r * right - sin_r * up, ahead, cos_r * up + sin_r * right};
}

glm::dmat3 camera_axes(const glm::dquat& world_from_optical) {
  const glm::dquat& q = world_from_optical;
  const double length = glm::length(q);
  SWELL_CHECK(std::isfinite(length) && length > 0.0, "world_from_optical=({}, {}, {}, {})", q.w,
              q.x, q.y, q.z);
  const glm::dmat3 axes = glm::mat3_cast(q / length);  // right, down, ahead
  return {axes[0], axes[2], -axes[1]};
}

Lens lens_of_fov(double fov_y_rad, int width_px, int height_px) {
  SWELL_CHECK(width_px >= 1 && height_px >= 1, "size={}x{}", width_px, height_px);
  SWELL_CHECK(fov_y_rad > 0.0 && fov_y_rad < kPi, "fov_y_rad={}", fov_y_rad);
  const double tan_half_y = tan(0.5 * fov_y_rad);
  return {.tan_half_x = tan_half_y * width_px / height_px, .tan_half_y = tan_half_y};
}

Lens lens_of_intrinsics(const Intrinsics& k, int width_px, int height_px) {
  SWELL_CHECK(width_px >= 1 && height_px >= 1, "size={}x{}", width_px, height_px);
  SWELL_CHECK(k.fx > 0.0 && k.fy > 0.0, "fx={} fy={}", k.fx, k.fy);
  const double half_x = 0.5 * width_px, half_y = 0.5 * height_px;
  return {.tan_half_x = half_x / k.fx,
          .tan_half_y = half_y / k.fy,
          .tan_middle_x = (half_x - k.cx) / k.fx,
          .tan_middle_y = (k.cy - half_y) / k.fy};
}

View make_view(glm::dvec3 eye_world, const glm::dmat3& world_from_camera, const Lens& lens,
               float near_m, int width_px, int height_px) {
  SWELL_CHECK(width_px >= 1 && height_px >= 1, "size={}x{}", width_px, height_px);
  SWELL_CHECK(near_m > 0.0f, "near_m={}", near_m);
  View view;
  view.width_px = width_px;
  view.height_px = height_px;
  view.eye_world = eye_world;
  view.right = glm::vec3(world_from_camera[0]);
  view.forward = glm::vec3(world_from_camera[1]);
  view.up = glm::vec3(world_from_camera[2]);
  view.tan_half_x = static_cast<float>(lens.tan_half_x);
  view.tan_half_y = static_cast<float>(lens.tan_half_y);
  view.tan_middle_x = static_cast<float>(lens.tan_middle_x);
  view.tan_middle_y = static_cast<float>(lens.tan_middle_y);
  view.near_m = near_m;
  view.clip_from_rel = clip_from_rel(view);
  return view;
}

View make_view(glm::dvec3 eye_world, double heading_rad, double pitch_rad, double fov_y_rad,
               float near_m, int width_px, int height_px) {
  return make_view(eye_world, camera_axes(heading_rad, pitch_rad, 0.0),
                   lens_of_fov(fov_y_rad, width_px, height_px), near_m, width_px, height_px);
}

View make_view(glm::dvec3 eye_world, const glm::dquat& world_from_optical, const Intrinsics& k,
               float near_m, int width_px, int height_px) {
  return make_view(eye_world, camera_axes(world_from_optical),
                   lens_of_intrinsics(k, width_px, height_px), near_m, width_px, height_px);
}

OpticalPose camera_pose(const View& view) {
  const glm::dmat3 axes(glm::dvec3(view.right), -glm::dvec3(view.up), glm::dvec3(view.forward));
  const glm::dquat q = glm::normalize(glm::quat_cast(axes));
  OpticalPose pose;
  pose.eye_world = view.eye_world;
  pose.world_from_optical = q.w < 0.0 ? -q : q;
  const double half_x = 0.5 * view.width_px, half_y = 0.5 * view.height_px;
  pose.k.fx = half_x / static_cast<double>(view.tan_half_x);
  pose.k.fy = half_y / static_cast<double>(view.tan_half_y);
  pose.k.cx = half_x - static_cast<double>(view.tan_middle_x) * pose.k.fx;
  pose.k.cy = half_y + static_cast<double>(view.tan_middle_y) * pose.k.fy;
  return pose;
}

std::array<glm::vec4, 5> frustum_planes(const View& view) {
  const auto plane = [](glm::vec3 n) { return glm::vec4(glm::normalize(n), 0.0f); };
  return {plane(view.right + view.forward * (view.tan_half_x - view.tan_middle_x)),
          plane(-view.right + view.forward * (view.tan_half_x + view.tan_middle_x)),
          plane(view.up + view.forward * (view.tan_half_y - view.tan_middle_y)),
          plane(-view.up + view.forward * (view.tan_half_y + view.tan_middle_y)),
          glm::vec4(view.forward, -view.near_m)};
}

}  // namespace swell
