#include "render/view/tree_ground.h"

#include <algorithm>

#include "lod/mesh_query.h"
#include "render/frame/options.h"
#include "render/view/meshes.h"
#include "render/view/trees_drawn.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

// With fewer of the land's triangles than the scene asks for trees go over to the ground that is
// drawn, and are there with this share of them: with a tenth, trees of `everything` hung as high
// over ridges as they are tall. Not at once, so that none jump when a governor begins.
constexpr double kOnDrawnGround = 0.75;

}  // namespace

void prepare_tree_ground(const WorldState& world, const FrameOptions& options, const Surface& land,
                         TreeGeometry& trees) {
  const double share =
      options.terrain_triangles / static_cast<double>(world.scene.detail.terrain_triangles);
  const double coarser = land.mesh.indices.empty() ? 0.0 : (1.0 - share) / (1.0 - kOnDrawnGround);
  trees.on_drawn_ground = static_cast<float>(std::clamp(coarser, 0.0, 1.0));
  if (trees.on_drawn_ground > 0.0f) lod::build_envelopes(land.mesh, land.height_m, trees.ground);
}

float drawn_ground_over(const Meshes& meshes, glm::dvec3 foot_world) {
  const float share = meshes.trees.on_drawn_ground;
  if (share == 0.0f) return 0.0f;
  const Surface& land = meshes.land;
  const lod::TriangleAt at =
      lod::triangle_at({land.mesh, meshes.trees.ground, land.height_m, land.domain}, foot_world);
  if (at.triangle == lod::kNoTriangle) return 0.0f;
  return share * static_cast<float>(at.height_m - foot_world.z);
}

}  // namespace swell::render
