// Small frames of the shipped scenes, and where two of them differ.
#pragma once

#include <map>
#include <string>

#include "render/frame.h"
#include "scene/scene.h"

namespace swell::render {

inline constexpr int kWidth = 200, kHeight = 120;

inline World load_world(const std::string& name) {
  return World(scene::load_scene(std::string(SWELL_SOURCE_DIR) + "/scenes/" + name + ".toml"));
}

// The same, made once: drawing does not change it.
inline const World& world_of(const std::string& name) {
  static std::map<std::string, World> worlds;
  const auto found = worlds.find(name);
  return found != worlds.end() ? found->second
                               : worlds.emplace(name, load_world(name)).first->second;
}

inline View view_of(const World& world, double t_s, int width = kWidth, int height = kHeight) {
  return scene::camera_view(world.scene().camera, t_s, width, height);
}

inline FrameOptions few_triangles() {
  FrameOptions options;
  options.water_triangles = 4000;
  return options;
}

struct Picture {
  Target target;
  FrameStatistics statistics;
};

inline Picture draw(const World& world, double t_s, int threads = 2,
                    const FrameOptions& options = few_triangles()) {
  Workers workers(threads);
  Workspace workspace;
  Picture picture;
  picture.statistics =
      render_frame(world, view_of(world, t_s), t_s, options, workspace, picture.target, workers);
  return picture;
}

// Says where two pictures first differ, or nothing.
inline std::string difference(const Target& a, const Target& b) {
  if (a.rgba.size() != b.rgba.size()) return "sizes differ";
  for (std::size_t i = 0; i < a.rgba.size(); ++i)
    if (a.rgba[i] != b.rgba[i])
      return "pixel (" + std::to_string(i % static_cast<std::size_t>(a.width_px)) + ", " +
             std::to_string(i / static_cast<std::size_t>(a.width_px)) + ")";
  return "";
}

}  // namespace swell::render
