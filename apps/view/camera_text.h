// The camera as text: a table of a scene file.
#pragma once

#include <string>

#include "apps/view/camera_controls.h"
#include "scene/scene.h"

namespace swell::view {

// [camera] with the pose, and the lens of `lens`, standing still: scene::parse_scene reads the same
// place and, to the last bit of radians in degrees, the same angles. In a scene file it takes the
// place of [camera] and of all [[camera.path]].
std::string camera_toml(const CameraPose& pose, const scene::Camera& lens);

// The pose in the scene's own numbers if its camera stands still, else that of the view.
CameraPose pose_of_scene(const scene::Camera& camera, const View& view);

}  // namespace swell::view
