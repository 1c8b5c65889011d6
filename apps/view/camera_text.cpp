#include "apps/view/camera_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "scene/parameters.h"

namespace swell::view {

std::string camera_toml(const CameraPose& pose, const scene::Camera& lens) {
  static constexpr std::array<std::string_view, 5> kKeys = {"camera.eye_m", "camera.heading_deg",
                                                            "camera.pitch_deg", "camera.fov_y_deg",
                                                            "camera.near_m"};
  scene::Scene scene;
  scene.camera = {.eye_m = pose.eye_m,
                  .heading_rad = pose.heading_rad,
                  .pitch_rad = pose.pitch_rad,
                  .fov_y_rad = lens.fov_y_rad,
                  .near_m = lens.near_m};
  std::string text = "[camera]\n";
  for (const auto& parameter : scene::scene_parameters())
    if (std::ranges::find(kKeys, parameter.key) != kKeys.end())
      text += fmt::format("{} = {}\n", parameter.key.substr(parameter.key.find('.') + 1),
                          scene::toml_text(parameter, scene));
  return text;
}

CameraPose pose_of_scene(const scene::Camera& camera, const View& view) {
  const bool stands_still =
      camera.path.empty() && camera.velocity_mps == glm::dvec3(0.0) && camera.turn_rad_s == 0.0;
  return stands_still ? CameraPose{camera.eye_m, camera.heading_rad, camera.pitch_rad}
                      : pose_of(view);
}

}  // namespace swell::view
