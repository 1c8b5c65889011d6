// Frames with all labels, for tests.
#pragma once

#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>

#include "math/random.h"
#include "render/labels/labels.h"
#include "render/shot.h"

namespace swell::render {

// A shot with all labels, unless some are asked for.
struct LabelledFrame : Shot {
  LabelledFrame(const World& drawn, const View& seen, double at_s, const FrameOptions& asked = {})
      : world(drawn), t_s(at_s), options(asked) {
    if (options.labels.empty()) options.labels = LabelSet::all();
    draw(world, seen, t_s, options);
  }

  using Shot::at, Shot::primitive;
  std::size_t at(glm::ivec2 p) const { return at(p.x, p.y); }
  std::uint32_t primitive(glm::ivec2 p) const { return primitive(p.x, p.y); }
  const Labels& labels() const { return target.labels; }
  glm::dvec3 position(glm::ivec2 p) const {
    return position_of(view, p.x, p.y, labels().depth_m[at(p)]);
  }

  // How far the earth has sunk at a place.
  double sunk_m(glm::dvec3 place) const {
    const glm::dvec2 rel(place - view.eye_world);
    return glm::dot(rel, rel) * static_cast<double>(state().window.drop_per_m2);
  }

  // Calls visit(p) for each pixel whose x and y are multiples of `step`.
  template <class Visit>
  void for_pixels(int step, const Visit& visit) const {
    for (int y = 0; y < view.height_px; y += step)
      for (int x = 0; x < view.width_px; x += step) visit(glm::ivec2(x, y));
  }

  const World& world;
  double t_s;
  FrameOptions options;
};

// Window point of a place in the world, in doubles; what is behind the camera has NaN.
inline glm::dvec2 project(const View& view, glm::dvec3 p_world) {
  const glm::dvec3 rel = p_world - view.eye_world;
  const double w = glm::dot(rel, glm::dvec3(view.forward));
  if (w <= 0.0) return glm::dvec2(std::nan(""));
  const double x = glm::dot(rel, glm::dvec3(view.right)) / w - view.tan_middle_x;
  const double y = glm::dot(rel, glm::dvec3(view.up)) / w - view.tan_middle_y;
  return {0.5 * view.width_px * (1.0 + x / view.tan_half_x),
          0.5 * view.height_px * (1.0 - y / view.tan_half_y)};
}

inline glm::dvec2 centre_of(glm::ivec2 p) { return glm::dvec2(p) + 0.5; }

// A camera like the scene's, somewhere near it, that looks more or less where it does.
inline View random_view(const scene::Scene& scene, int n, glm::ivec2 size_px) {
  const auto dice = [&](int i) {
    return random_uniform(31, static_cast<std::uint64_t>(8 * n + i)) - 0.5;
  };
  const scene::Camera& camera = scene.camera;
  const glm::dvec3 eye =
      camera.eye_m + glm::dvec3(20.0 * dice(0), 20.0 * dice(1), camera.eye_m.z * dice(2));
  return make_view(
      eye,
      camera_axes(camera.heading_rad + dice(3), camera.pitch_rad + 0.3 * dice(4), 0.4 * dice(5)),
      lens_of_fov(camera.fov_y_rad, size_px.x, size_px.y), 0.25f, size_px.x, size_px.y);
}

}  // namespace swell::render
