// Objects that rivers carry away.
#pragma once

#include <span>

#include "math/parallel.h"
#include "scene/scene.h"

namespace swell::scene {

// Gives the scene's objects with `drift` their ways, which object_poses() and plan_pose() then
// follow; their sizes are known. like: scenes with the same rivers and lakes, whose ways are taken
// where an object begins alike. For each object 0.03 s of one core and 0.1 MB a kilometre;
// the same bits with any workers. The scene passes check_scene().
void find_drift_tracks(Scene& scene, std::span<const Scene* const> like, Workers& workers);

}  // namespace swell::scene
