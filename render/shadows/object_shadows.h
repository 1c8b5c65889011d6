// Stage 3: which floating objects stand in the light, and in which tiles of a view that may show.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "raster/pass.h"
#include "render/frame/parts.h"
#include "render/view/shadow_casters.h"

namespace swell {
struct View;
namespace ocean {
struct Disturbance;
}
namespace scene {
struct FloatingObject;
struct ObjectPose;
}  // namespace scene
namespace shapes {
struct MeshPart;
struct ObjectMesh;
}  // namespace shapes
}  // namespace swell

namespace swell::render {

struct ObjectGeometry;
struct RenderView;
struct StageRun;
struct WorldState;

// The triangles of a part of the mesh where the pose puts them, as the sun sees them along the axes
// of `shadows`; from the object's place. Every `step`-th row is found, which divides kRows - 1, and
// the others lie between them. 20 us for a buoy of many triangles and all rows.
Outline outline_of(const shapes::ObjectMesh& mesh, const shapes::MeshPart& part,
                   const scene::FloatingObject& object, const scene::ObjectPose& pose,
                   const ObjectShadows& shadows, int step);

// The light of a frame, and what of its pictures is left out.
struct ShadowOptions {
  glm::vec3 sun_direction{0.0f, 0.0f, 1.0f};  // unit; below the horizon it casts no shadows
  PartSet without;
  std::span<const ocean::Disturbance> disturbances = {};  // besides the world's
};

// Sets objects.shadows: all objects that may tell on what the view shows, in front of it or not, at
// the poses in `objects`.
void find_shadow_casters(const WorldState& world, const ShadowOptions& options, const View& view,
                         ObjectGeometry& objects, const StageRun& run);

struct LightInWater {
  glm::vec2 slant{0.0f};       // how far aside sunlight comes from under water, a metre of depth
  bool eye_submerged = false;  // what is shaded begins in water
};

// The casters of each tile of a view. The same pixels are shaded with tiles of any size.
void list_casters(const ObjectShadows& shadows, const LightInWater& light, const RenderView& view,
                  const raster::TileGrid& grid, TileCasters& of_tile);

}  // namespace swell::render
