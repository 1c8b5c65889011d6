#include "math/view.h"

#include <cmath>

#include "math/check.h"
#include "math/elementary.h"

namespace swell {

View make_view(glm::dvec3 eye_world, double heading_rad, double pitch_rad, double fov_y_rad,
               float near_m, int width_px, int height_px) {
  SWELL_CHECK(width_px >= 1 && height_px >= 1, "size={}x{}", width_px, height_px);
  SWELL_CHECK(std::isfinite(heading_rad), "heading_rad={}", heading_rad);
  SWELL_CHECK(std::isfinite(pitch_rad), "pitch_rad={}", pitch_rad);
  SWELL_CHECK(fov_y_rad > 0.0 && fov_y_rad < kPi, "fov_y_rad={}", fov_y_rad);
  SWELL_CHECK(near_m > 0.0f, "near_m={}", near_m);
  const double sin_h = sin(heading_rad), cos_h = cos(heading_rad);
  const double sin_p = sin(pitch_rad), cos_p = cos(pitch_rad);
  const double tan_half_y = tan(0.5 * fov_y_rad);

  View view;
  view.width_px = width_px;
  view.height_px = height_px;
  view.eye_world = eye_world;
  view.right = glm::vec3(glm::dvec3(cos_h, -sin_h, 0.0));
  view.up = glm::vec3(glm::dvec3(-sin_h * sin_p, -cos_h * sin_p, cos_p));
  view.forward = glm::vec3(glm::dvec3(sin_h * cos_p, cos_h * cos_p, sin_p));
  view.tan_half_y = static_cast<float>(tan_half_y);
  view.tan_half_x = static_cast<float>(tan_half_y * width_px / height_px);
  view.near_m = near_m;

  const glm::vec3 row_x = view.right / view.tan_half_x;
  const glm::vec3 row_y = view.up / view.tan_half_y;
  view.clip_from_rel = glm::transpose(glm::mat4(  // rows
      glm::vec4(row_x, 0.0f), glm::vec4(row_y, 0.0f), glm::vec4(0.0f, 0.0f, 0.0f, near_m),
      glm::vec4(view.forward, 0.0f)));
  return view;
}

std::array<glm::vec4, 5> frustum_planes(const View& view) {
  const auto plane = [](glm::vec3 n) { return glm::vec4(glm::normalize(n), 0.0f); };
  return {plane(view.right + view.forward * view.tan_half_x),
          plane(-view.right + view.forward * view.tan_half_x),
          plane(view.up + view.forward * view.tan_half_y),
          plane(-view.up + view.forward * view.tan_half_y), glm::vec4(view.forward, -view.near_m)};
}

}  // namespace swell
