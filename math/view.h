// A camera: where it is, which pixels look where, what it can see.
//
// Positions are relative to the eye ("rel": world axes, metres, origin at the eye), so that float
// keeps millimetres far from the world's origin. Clip space is reversed-Z with the far plane at
// infinity: z_clip = near_m, w_clip = depth along the view axis, depth buffer value near_m / w in
// (0, 1], 0 = infinitely far. Window x goes right, y down; pixel centres lie at +0.5.
#pragma once

#include <array>
#include <glm/glm.hpp>

namespace swell {

struct View {
  int width_px = 0, height_px = 0;
  glm::dvec3 eye_world{0.0};
  // Unit vectors in world axes, up = right x forward.
  glm::vec3 right{1, 0, 0}, up{0, 0, 1}, forward{0, 1, 0};
  float tan_half_x = 1.0f, tan_half_y = 1.0f;
  float near_m = 0.1f;
  glm::mat4 clip_from_rel{1.0f};

  // The direction through window point (x_px, y_px), scaled so that its depth (component along
  // forward) is 1: p_rel = depth * ray.
  glm::vec3 ray(float x_px, float y_px) const {
    const float x_ndc = 2.0f * x_px / static_cast<float>(width_px) - 1.0f;
    const float y_ndc = 1.0f - 2.0f * y_px / static_cast<float>(height_px);
    return forward + right * (x_ndc * tan_half_x) + up * (y_ndc * tan_half_y);
  }
};

// Builds a view from eye_world [m], heading_rad (clockwise from north), pitch_rad (up positive,
// in [-pi/2, pi/2]), fov_y_rad in (0, pi), near_m > 0 and a size of at least 1 x 1.
View make_view(glm::dvec3 eye_world, double heading_rad, double pitch_rad, double fov_y_rad,
               float near_m, int width_px, int height_px);

// The half-spaces dot(n, p_rel) + w >= 0 that enclose what the view sees: left, right, bottom,
// top, near. Unit normals.
std::array<glm::vec4, 5> frustum_planes(const View& view);

}  // namespace swell
