// Poses between waypoints, for cameras and for bodies that sensors are on.
#pragma once

#include <span>

#include "scene/camera.h"

namespace swell::scene {

// The pose at t_s (finite) on a path of one waypoint or more, as Camera::path says.
Waypoint pose_on_path(std::span<const Waypoint> path, double t_s);

}  // namespace swell::scene
