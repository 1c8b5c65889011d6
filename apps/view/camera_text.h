// The camera as text: a table of a scene file.
#pragma once

#include <string>

#include "apps/view/camera_controls.h"
#include "scene/scene.h"

namespace swell::view {

// A camera at the pose that stands still in the world, with the lens of `lens` (its field of view
// or K, and its near plane).
scene::Camera camera_at(const CameraPose& pose, const scene::Camera& lens);

// [camera] of camera_at(): scene::parse_scene reads the same place and lens and, to the last bit of
// radians in degrees, the same angles. In a scene file it takes the place of [camera] and of all
// [[camera.path]].
std::string camera_toml(const CameraPose& pose, const scene::Camera& lens);

// The pose in the scene's own numbers if its camera stands still in the world and is given by
// angles, else that of the view.
CameraPose pose_of_scene(const scene::Camera& camera, const View& view);

}  // namespace swell::view
