// What of a scene stands in its rivers.
#pragma once

#include <vector>

#include "ocean/inland/obstacle.h"
#include "ocean/inland/river_network.h"
#include "scene/scene.h"

namespace swell::scene {

// The plans of objects that are moored in a river's water, or fixed and pass its surface; none of
// those that go along a path or drift. As wide as the object, all the way down: an ellipse of round
// kinds and of hulls, a box with rounded corners of boxes and of what a file says, each post of a
// pier. network: of the scene. Sizes of meshes of files are known once a render::World holds the
// scene.
std::vector<ocean::Obstacle> river_obstacles(const Scene& scene,
                                             const ocean::RiverNetwork& network);

}  // namespace swell::scene
