// The triangles of a frame: the water's, the land's, the objects'. They know no view; a
// RenderView holds what becomes of their vertices in a picture.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "lod/roam.h"
#include "render/frame/options.h"
#include "render/frame/profile.h"
#include "render/sea/sea_maps.h"
#include "render/view/implicit_rays.h"
#include "render/view/shadow_casters.h"
#include "render/view/surfaces.h"
#include "render/view/trees_drawn.h"
#include "render/world/world.h"
#include "scene/objects.h"
#include "shapes/object_mesh.h"

namespace swell::render {

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

// A floating object in a frame. Its axes are divided by its sizes: a point p_rel has the mesh's
// coordinates (right, ahead, up) . (p_rel - bottom_rel), and a normal (x, y, z) of the mesh is
// x right + y ahead + z up in the world, but for its length.
struct ObjectInstance {
  glm::vec3 right{1, 0, 0}, ahead{0, 1, 0}, up{0, 0, 1};
  glm::vec3 bottom_rel{0.0f};
  float waterline_rel_m = 0.0f;  // height of its waterline above the eye
  glm::vec3 colour{0.0f};
  float roughness = 0.42f, metalness = 0.0f;  // of its paint
  float squares_per_m = 0.0f;                 // of its checkers; 0: it has none
  glm::vec3 squares_per_unit{0.0f};           // the same along the mesh's axes
  const shapes::ObjectMesh* mesh = nullptr;
  const SunDepth* self_shadow = nullptr;    // none: it does not shade itself
  float log2_units_per_m = 0.0f;            // of the mesh's lengths, in the mean over its axes
  std::uint32_t object = 0;                 // its index in the scene
  const PosedImplicit* implicit = nullptr;  // none: it is drawn as its triangles
  glm::vec3 implicit_size{1.0f},
      implicit_base{0.0f};  // an implicit surface's point is base + size (mesh coordinates)
};

// Which triangle of which object a primitive is.
struct ObjectPrimitive {
  const shapes::ObjectTriangle* triangle = nullptr;
  const ObjectInstance* object = nullptr;
};

// Which of a surface's triangles and vertices are one thing.
struct DrawPart {
  std::uint32_t first_triangle = 0, triangles = 0;
  std::uint32_t first_vertex = 0, vertices = 0;
  bool is_cast = false;  // found by rays: its triangles but stand for its parts
};

// The objects that views of one kind may show, each of as many triangles as the view needs.
struct ObjectDraws {
  std::vector<ObjectInstance> instances;
  std::vector<DrawPart> parts;              // of the same
  std::vector<ObjectPrimitive> primitives;  // per triangle
  std::vector<std::uint32_t> indices;       // 3 per triangle
  std::vector<glm::vec3> p_rel;             // per vertex, relative to the eye
  std::vector<float> waterline_rel_m;       // per vertex: its object's
};

// The objects of a frame.
struct ObjectGeometry {
  std::vector<scene::ObjectPose> poses;           // of all objects of the scene
  std::vector<const shapes::ObjectMesh*> meshes;  // of the same, in the window; null: not in view
  std::array<ObjectDraws, kViewKinds> draws;
  ObjectShadows shadows;                                   // of those that the view may show
  bool draws_implicits = true;                             // Part::kImplicits
  std::vector<PosedImplicit> implicits;                    // at the frame's time
  std::vector<const scene::ImplicitSurface*> implicit_of;  // what they are of; of each shape one

  ObjectDraws& drawn_in(ViewKind kind) { return draws[static_cast<std::size_t>(kind)]; }
  const ObjectDraws& drawn_in(ViewKind kind) const { return draws[static_cast<std::size_t>(kind)]; }
  const ObjectDraws& in_window() const { return drawn_in(ViewKind::kWindow); }
};

// The rivers and lakes that a window may show.
struct RiverMesh {
  std::vector<std::uint32_t> indices;    // 3 per triangle
  std::vector<glm::vec3> p_rel;          // per vertex, relative to the eye
  std::vector<float> sea_share;          // per vertex: of the sea's waves, which displace() adds
  std::vector<std::uint8_t> looks_into;  // per triangle: bits of LooksInto
  // The level of what lies nearest to the eye but for water that the sea's mirror serves; an image
  // mirrored in it is drawn. None: too little of it is in view.
  std::optional<float> mirror_level_m;
  float mirror_share = 0.0f;  // how much of that image shows: less where little is in view
};

// Water of rivers and lakes shows an image that is mirrored in another level all the same: all of
// it up to half a metre off, nothing from two metres on.
inline constexpr float kMirrorFull_m = 0.5f, kMirrorGone_m = 2.0f;

// How fast water loses the image of another level, and how much is left of one so far off.
inline constexpr float kMirrorFall_per_m = 1.0f / (kMirrorGone_m - kMirrorFull_m);
inline float mirror_share(float off_m) {
  return std::clamp((kMirrorGone_m - std::abs(off_m)) * kMirrorFall_per_m, 0.0f, 1.0f);
}

// The triangles of a kind that its material places (materials/list.h).
struct PlacedSurface {
  std::vector<std::uint32_t> indices;  // 3 per triangle
  std::vector<glm::vec3> p_rel;        // per vertex, relative to the eye
};

// The images that water may look into.
enum LooksInto : std::uint8_t { kSeaFloor = 1, kSeaMirror = 2, kRiverMirror = 4 };

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
