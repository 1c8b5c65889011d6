#include "render/world_view.h"

#include <algorithm>

#include "math/with_ieee.h"
#include "ocean/water_surface.h"
#include "render/exposure.h"
#include "render/sea/sea_maps.h"
#include "render/world/world_state.h"
#include "scene/camera.h"

namespace swell::render {
namespace {

// Where the caller puts the object that carries the camera; null: nowhere.
const scene::ObjectPose* given_mount(const scene::Scene& scene, const scene::FloatingObject& mount,
                                     std::span<const scene::GivenPose> given) {
  const auto object = static_cast<std::size_t>(&mount - scene.objects.data());
  const auto found = std::ranges::find(given, object, &scene::GivenPose::object);
  return found == given.end() ? nullptr : &found->pose;
}

}  // namespace

View world_view(const World& world, double t_s, int width_px, int height_px, ocean::SeaFrame& sea,
                Workers& workers) {
  return world_view(world, t_s, FrameOptions{}, {width_px, height_px}, sea, workers);
}

View world_view(const World& world, double t_s, const FrameOptions& options, glm::ivec2 size_px,
                ocean::SeaFrame& sea, Workers& workers) {
  const ScopedFloatEnvironment ieee;
  const WorldState& w = world.state();
  scene::check_given_poses(options.poses, w.scene.objects.size());
  const scene::FloatingObject* mount = scene::camera_mount(w.scene);
  if (!mount) return scene::camera_view(w.scene.camera, t_s, size_px.x, size_px.y);
  if (const scene::ObjectPose* given = given_mount(w.scene, *mount, options.poses))
    return scene::mounted_view(w.scene.camera, *given, t_s, size_px.x, size_px.y);
  advance_waves(w, t_s, options.disturbances, {}, sea, workers);
  return scene::camera_view(w.scene, water_surface(w, sea), t_s, size_px.x, size_px.y);
}

View next_world_view(const World& world, double t_s, const FrameOptions& options,
                     glm::ivec2 size_px, ocean::SeaFrame& sea, Workers& workers) {
  FrameOptions next = options;
  next.poses = options.next_poses;
  const double next_s = with_ieee([&] { return t_s + options.next_frame_s; });
  return world_view(world, next_s, next, size_px, sea, workers);
}

std::vector<View> exposed_views(const World& world, double t_s, const FrameOptions& options,
                                glm::ivec2 size_px, ocean::SeaFrame& sea, Workers& workers) {
  const ScopedFloatEnvironment ieee;
  const Exposure exposure = exposure_of(world.scene().camera, options);
  std::vector<View> views;
  if (exposure.moments == 1) return views;
  for (int k = 0; k < exposure.moments; ++k)
    views.push_back(world_view(world, t_s + k * exposure.step_s, options, size_px, sea, workers));
  return views;
}

}  // namespace swell::render
