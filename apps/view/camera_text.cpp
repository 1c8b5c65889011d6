#include "apps/view/camera_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "scene/file/parameters.h"

namespace swell::view {
namespace {

// Whether the text of a camera that stands still needs a key: always the pose, of the lens what the
// camera has.
bool says_something(std::string_view key, const scene::Camera& camera) {
  static constexpr std::array<std::string_view, 4> kAlways = {"camera.eye_m", "camera.heading_deg",
                                                              "camera.pitch_deg", "camera.near_m"};
  if (std::ranges::find(kAlways, key) != kAlways.end()) return true;
  if (key == "camera.roll_deg") return camera.roll_rad != 0.0;
  if (key == "camera.fov_y_deg") return !camera.focal_px;
  if (key == "camera.principal_px") return camera.principal_px.has_value();
  return (key == "camera.focal_px" || key == "camera.size_px") && camera.focal_px;
}

}  // namespace

scene::Camera camera_at(const CameraPose& pose, const scene::Camera& lens) {
  return {.eye_m = pose.eye_m,
          .heading_rad = pose.heading_rad,
          .pitch_rad = pose.pitch_rad,
          .roll_rad = pose.roll_rad,
          .fov_y_rad = lens.fov_y_rad,
          .near_m = lens.near_m,
          .focal_px = lens.focal_px,
          .principal_px = lens.principal_px,
          .size_px = lens.size_px};
}

std::string camera_toml(const CameraPose& pose, const scene::Camera& lens) {
  scene::Scene scene;
  scene.camera = camera_at(pose, lens);
  std::string text = "[camera]\n";
  for (const auto& parameter : scene::scene_parameters())
    if (says_something(parameter.key, scene.camera))
      text += fmt::format("{} = {}\n", parameter.key.substr(parameter.key.find('.') + 1),
                          scene::toml_text(parameter, scene));
  return text;
}

CameraPose pose_of_scene(const scene::Camera& camera, const View& view) {
  const bool stands_still =
      camera.path.empty() && camera.velocity_mps == glm::dvec3(0.0) && camera.turn_rad_s == 0.0;
  if (!stands_still || camera.quaternion || !camera.mount.empty()) return pose_of(view);
  return {camera.eye_m, camera.heading_rad, camera.pitch_rad, camera.roll_rad};
}

}  // namespace swell::view
