// The triangles of a frame: the water's, the land's, the objects'. They know no view; a
// RenderView holds what becomes of their vertices in a picture.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "lod/roam.h"
#include "math/view.h"
#include "render/view/objects_drawn.h"
#include "render/view/rivers_drawn.h"
#include "render/view/surfaces.h"
#include "render/view/trees_drawn.h"

namespace swell::render {

struct FrameOptions;
struct StageRun;
struct WorldState;

// A triangulated height field at one time.
struct Surface {
  std::optional<lod::Roam> roam;  // of the land, and of the sea if ROAM triangulates it
  int max_triangles = 0;
  lod::Domain domain;  // whose lattice the mesh is on
  lod::AdaptStatistics statistics;
  lod::Mesh mesh;
  std::uint64_t mesh_revision = 0;  // as of Roam::update_mesh
  std::vector<glm::vec2> offset;    // per vertex: x, y relative to the eye [m]
  std::vector<float> height_m;      // per vertex
  std::vector<lod::Focus> focuses;  // where something floats
};

// Where a vertex is in the world: exact, for spacings of a power of two.
glm::dvec2 vertex_world(const Surface& surface, std::size_t vertex);

struct Meshes {
  Surface water, land;  // land: empty without terrain
  ObjectGeometry objects;
  RiverMesh rivers;
  TreeGeometry trees;
  EnumTable<SurfaceKind, PlacedSurface> placed;
  EnumTable<SurfaceKind, bool> has_material = {};  // others are not drawn
};

// Stage 2: the cells of rivers and lakes that the view may show, joined where they are small in it.
void choose_rivers(const WorldState& world, const View& view, const FrameOptions& options,
                   RiverMesh& rivers);

// Stage 2: triangulates water and land for the view at t_s.
void triangulate(const WorldState& world, const View& view, double t_s, const FrameOptions& options,
                 Meshes& meshes, const StageRun& run);

}  // namespace swell::render
