// Scenes in which edges are all there is to see, and views moved by parts of a pixel, to judge
// smooth edges by.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "math/elementary.h"
#include "math/view.h"
#include "raster/sample_pattern.h"
#include "scene/scene.h"

namespace swell::render {

// A flat, smooth sea under a sky of one colour, nearly without haze: what is left is edges.
inline scene::Scene plain_scene() {
  scene::Scene scene;
  scene.sea.wind_speed_mps = 0.0;
  scene.sea.resolution = 64;
  scene.water.bump_strength = 0.0;
  scene.detail.triangulation = scene::Triangulation::kPlane;
  scene.sky.zenith = scene.sky.horizon = glm::vec3(0.04f, 0.08f, 0.16f);
  scene.sky.sun_radiance = glm::vec3(2.0f);
  scene.sky.cloud_cover = 0.0;
  scene.sky.haze_distance_m = 1e6;
  scene.sky.sun_azimuth_rad = kPi;  // behind a camera that looks north
  scene.sky.sun_direction = {0.0f, -0.8660254f, 0.5f};
  return scene;
}

inline scene::FloatingObject white_box(glm::dvec2 position_m, glm::dvec3 size_m) {
  return {.kind = scene::ObjectKind::kBox,
          .position_m = position_m,
          .size_m = size_m,
          .colour = glm::vec3(0.9f)};
}

// A camera that looks north along the sea, level but for its roll.
inline View north_view(double eye_z_m, double roll_rad, double fov_y_rad, int width_px,
                       int height_px) {
  return make_view({0.0, 0.0, eye_z_m}, camera_axes(0.0, 0.0, roll_rad),
                   lens_of_fov(fov_y_rad, width_px, height_px), 0.25f, width_px, height_px);
}

// The view whose pixels' middles lie where this one's lie, moved by (right, down) pixels.
inline View moved(const View& view, glm::dvec2 by_px) {
  const Lens lens = {.tan_half_x = view.tan_half_x,
                     .tan_half_y = view.tan_half_y,
                     .tan_middle_x = view.tan_middle_x + 2.0 * by_px.x / view.width_px *
                                                             static_cast<double>(view.tan_half_x),
                     .tan_middle_y = view.tan_middle_y - 2.0 * by_px.y / view.height_px *
                                                             static_cast<double>(view.tan_half_y)};
  const glm::dmat3 axes(view.right, view.forward, view.up);
  return make_view(view.eye_world, axes, lens, view.near_m, view.width_px, view.height_px);
}

// 64 places of a pixel from its middle, one in each of 64 columns and of 64 rows, evenly spread
// (Hammersley's points).
inline std::array<glm::dvec2, 64> rook_places() {
  std::array<glm::dvec2, 64> places;
  for (int i = 0; i < 64; ++i) {
    int mirrored = 0;
    for (int bit = 0; bit < 6; ++bit) mirrored |= (i >> bit & 1) << (5 - bit);
    places[static_cast<std::size_t>(i)] = {(i + 0.5) / 64.0 - 0.5, (mirrored + 0.5) / 64.0 - 0.5};
  }
  return places;
}

// The place of a sample from the pixel's middle.
inline glm::dvec2 place_of_sample(const raster::SamplePosition& p) {
  return glm::dvec2(p.x_fx8, p.y_fx8) / 256.0 - 0.5;
}

// sRGB bytes as light of the display, in [0, 1] (IEC 61966-2-1).
inline double display_light(std::uint32_t rgba, int channel) {
  const double code = (rgba >> (8 * channel) & 255u) / 255.0;
  return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

}  // namespace swell::render
