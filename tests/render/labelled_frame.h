// Frames with all labels, for tests.
#pragma once

#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <map>
#include <string>

#include "math/random.h"
#include "render/drawn_shots.h"
#include "render/labels/labels.h"
#include "render/workspace.h"

namespace swell::render {

// The world of load_shipped(name), made once: drawing does not change it.
inline const World& shipped_world(const std::string& name) {
  static std::map<std::string, World> worlds;
  const auto found = worlds.find(name);
  return found != worlds.end() ? found->second
                               : worlds.emplace(name, World(load_shipped(name))).first->second;
}

// A frame of a world, and what it was drawn with.
struct LabelledFrame {
  LabelledFrame(const World& drawn, const View& camera, double time_s,
                const FrameOptions& asked = {})
      : world(drawn), view(camera), t_s(time_s), options(asked) {
    if (options.labels.empty()) options.labels = LabelSet::all();
    Workers workers(2);
    render_frame(world, view, t_s, options, workspace, target, workers);
  }

  const Labels& labels() const { return target.labels; }
  std::size_t at(glm::ivec2 p) const {
    return static_cast<std::size_t>(p.y) * static_cast<std::size_t>(view.width_px) +
           static_cast<std::size_t>(p.x);
  }
  glm::dvec3 position(glm::ivec2 p) const {
    return position_of(view, p.x, p.y, labels().depth_m[at(p)]);
  }

  // How far the earth has sunk at a place.
  double sunk_m(glm::dvec3 place) const {
    const glm::dvec2 rel(place - view.eye_world);
    return glm::dot(rel, rel) * static_cast<double>(workspace.state().window.drop_per_m2);
  }

  // The primitive that pixel p shows.
  std::uint32_t primitive(glm::ivec2 p) const {
    const VisibilityBuffer& visibility = workspace.state().visibility;
    const int size = visibility.grid.tile_size_px;
    const int tile = p.y / size * visibility.grid.tiles_x + p.x / size;
    if (visibility.covered[static_cast<std::size_t>(tile)] < 0) return raster::kNoPrimitive;
    return visibility.primitive_of(tile)[static_cast<std::size_t>(p.y % size * size + p.x % size)];
  }

  // Calls visit(p) for each pixel whose x and y are multiples of `step`.
  template <class Visit>
  void for_pixels(int step, const Visit& visit) const {
    for (int y = 0; y < view.height_px; y += step)
      for (int x = 0; x < view.width_px; x += step) visit(glm::ivec2(x, y));
  }

  const World& world;
  View view;
  double t_s;
  FrameOptions options;
  Workspace workspace;
  Target target;
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
