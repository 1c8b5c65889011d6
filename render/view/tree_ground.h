// The ground that trees stand on: the true one, or the one that is drawn where few triangles draw
// it.
#pragma once

#include <glm/glm.hpp>

namespace swell::render {

struct FrameOptions;
struct Meshes;
struct Surface;
struct TreeGeometry;
struct WorldState;

// Before trees are placed, when the land's vertices have their heights. Trees stand on the true
// ground where the land has as many triangles as the scene asks for, or is drawn by rays.
void prepare_tree_ground(const WorldState& world, const FrameOptions& options, const Surface& land,
                         TreeGeometry& trees);

// How far over a foot on the true ground the ground is on which the tree stands [m]; below: under
// 0.
float drawn_ground_over(const Meshes& meshes, glm::dvec3 foot_world);

}  // namespace swell::render
