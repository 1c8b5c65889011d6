// The rays through the pixels of a view.
#pragma once

#include <glm/glm.hpp>

#include "math/view.h"

namespace swell::render {

// Where pixels lie in the world, relative to the eye:
// p_rel = depth (ray + x_px ray_dx + y_px ray_dy), depth = near_m / z.
struct ViewRays {
  glm::vec3 ray{0.0f}, ray_dx{0.0f}, ray_dy{0.0f};
  float near_m = 0.25f;
  float eye_z = 0.0f;
  float pixel_angle = 0.001f;  // size of a pixel at depth 1
  float drop_per_m2 = 0.0f;    // how far a round earth sinks (math/earth.h)
};

inline ViewRays make_rays(const View& camera) {
  ViewRays rays;
  rays.ray = camera.ray(0.5f, 0.5f);
  rays.ray_dx = camera.right * (2.0f * camera.tan_half_x / static_cast<float>(camera.width_px));
  rays.ray_dy = -camera.up * (2.0f * camera.tan_half_y / static_cast<float>(camera.height_px));
  rays.near_m = camera.near_m;
  rays.eye_z = static_cast<float>(camera.eye_world.z);
  rays.pixel_angle = 2.0f * camera.tan_half_y / static_cast<float>(camera.height_px);
  return rays;
}

}  // namespace swell::render
