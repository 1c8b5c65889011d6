// A picture for tests: this world, seen so, at that time, and what was drawn for it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "render/workspace.h"
#include "scene/camera.h"
#include "sky/sky_light.h"

namespace swell::render {

// The scene of that name in scenes/; "_radial" after it: with the radial grid, "_plane": with the
// plane.
inline scene::Scene load_shipped(std::string_view name) {
  const std::size_t end = std::min(name.find("_radial"), name.find("_plane"));
  scene::Scene scene =
      scene::load_scene(SWELL_SOURCE_DIR "/scenes/" + std::string(name.substr(0, end)) + ".toml");
  if (name.ends_with("_radial")) scene.detail.triangulation = scene::Triangulation::kRadial;
  if (name.ends_with("_plane")) scene.detail.triangulation = scene::Triangulation::kPlane;
  return scene;
}

// A world made like those of the last few scenes: sooner, the same bits
// (FrameBits.AWorldMadeLikeAnotherDrawsTheSamePicture). Not for scenes whose files change.
inline World world_of(const scene::Scene& scene) {
  constexpr std::size_t kKept = 8;
  static std::deque<World> kept;
  std::vector<const World*> like;
  for (const World& world : kept) like.push_back(&world);
  World world(scene, like, available_cpus());
  kept.emplace_back(scene, world, 1);
  if (kept.size() > kKept) kept.pop_front();
  return world;
}

// A shipped scene's world, made once: drawing does not change it.
inline const World& shipped_world(std::string_view name) {
  static std::map<std::string, World, std::less<>> worlds;
  const auto found = worlds.find(name);
  if (found != worlds.end()) return found->second;
  return worlds.emplace(name, world_of(load_shipped(name))).first->second;
}

// Through the scene's own camera.
inline View view_of(const World& world, double t_s, int width_px, int height_px) {
  return scene::camera_view(world.scene().camera, t_s, width_px, height_px);
}

// One picture, or with draw() several, one after the other. The last world has to outlive it.
struct Shot {
  explicit Shot(int threads = 2) : workers(threads) {}
  Shot(const World& world, const View& seen, double t_s, const FrameOptions& options = {},
       int threads = 2)
      : workers(threads) {
    draw(world, seen, t_s, options);
  }

  // Storage is kept, as in a film.
  const Target& draw(const World& world, const View& seen, double t_s,
                     const FrameOptions& options = {}) {
    view = seen;
    statistics = render_frame(world, view, t_s, options, workspace, target, workers);
    return target;
  }

  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y * view.width_px + x); }
  glm::ivec3 codes(int x, int y) const {
    const std::uint32_t rgba = target.rgba[at(x, y)];
    return {rgba & 255, rgba >> 8 & 255, rgba >> 16 & 255};
  }
  // Returns the linear light of a pixel; the picture was drawn with keep_linear.
  glm::vec3 linear(int x, int y) const {
    const float* const rgb = &target.linear[3 * at(x, y)];
    return {rgb[0], rgb[1], rgb[2]};
  }
  // Returns the direction through the middle of a pixel, of length 1.
  glm::vec3 direction(int x, int y) const {
    return glm::normalize(view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
  }

  const FrameState& state() const { return workspace.state(); }
  // What the middle of a pixel shows; raster::kNoPrimitive for the sky.
  std::uint32_t primitive(int x, int y) const {
    const VisibilityBuffer& buffer = state().visibility;
    const int size = buffer.grid.tile_size_px;
    const int tile = y / size * buffer.grid.tiles_x + x / size;
    if (buffer.covered[static_cast<std::size_t>(tile)] < 0) return raster::kNoPrimitive;
    return buffer.primitive_of(tile)[static_cast<std::size_t>(y % size * size + x % size)];
  }
  bool shows(SurfaceKind kind, int x, int y) const {
    return state().window.primitives.holds(kind, primitive(x, y));
  }

  Workers workers;
  Workspace workspace;
  Target target;
  View view;
  FrameStatistics statistics;
};

// A small one of few triangles through the scene's own camera.
inline constexpr int kSmallWidth = 200, kSmallHeight = 120;
inline FrameOptions few_triangles() { return {.water_triangles = 4000}; }
inline Shot small_shot(const World& world, double t_s,
                       const FrameOptions& options = few_triangles(), int threads = 2) {
  return Shot(world, view_of(world, t_s, kSmallWidth, kSmallHeight), t_s, options, threads);
}

}  // namespace swell::render
