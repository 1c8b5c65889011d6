// What a Workspace holds, and the stages that work on it. Each stage reads what the one before has
// written; nothing here is an input of a later frame.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "lod/roam.h"
#include "ocean/sea.h"
#include "ocean/water_surface.h"
#include "raster/pass.h"
#include "render/enlarge.h"
#include "render/frame.h"
#include "render/profile.h"
#include "render/shade.h"
#include "render/world_state.h"
#include "texture/uv_noise.h"

namespace swell::render {

// A triangulated surface of one frame.
struct Surface {
  std::optional<lod::Roam> roam;  // of the land, and of the sea if ROAM triangulates it
  int max_triangles = 0;
  lod::Domain domain;  // whose lattice the mesh is on
  lod::AdaptStatistics statistics;
  lod::Mesh mesh;
  std::uint64_t mesh_revision = 0;  // as of Roam::update_mesh
  std::vector<glm::vec2> offset;    // per vertex: x, y relative to the eye [m]
  std::vector<float> height_m;      // per vertex
  std::vector<glm::vec4> p_clip;    // in the window's view
};

// Apparent depth over true depth of a point below the water seen from the eye, at an angle theta
// to the vertical: k = (1/n) cos / sqrt(1 - (sin/n)^2), from 1/n to 0.
float squeeze(glm::vec3 p_rel, float n);

// Where a vertex is in the world: exact, for spacings of a power of two.
glm::dvec2 vertex_world(const Surface& surface, std::size_t vertex);

// An off-screen picture: the land mirrored in the sea, or squeezed below it.
struct LookupTarget {
  raster::Pass pass;
  std::vector<glm::vec4> p_clip;
  std::vector<float> clip_distance;
  texture::RgbaImage image;
  std::vector<std::uint8_t> wanted;   // per tile: water can look into it
  std::vector<std::uint8_t> written;  // per tile: holds anything but zeros
  ShadeContext context;
};

// The floating objects that a frame may show, as the triangles of three views.
struct ObjectGeometry {
  std::vector<scene::ObjectPose> poses;          // of all objects of the scene
  std::vector<const scene::ObjectMesh*> meshes;  // of the same; null: not in view
  std::vector<ObjectInstance> instances;         // of those in view
  std::vector<ObjectPrimitive> primitives;       // per triangle
  std::vector<std::uint32_t> indices;            // 3 per triangle
  std::vector<glm::vec4> p_clip;                 // in the window's view
  std::vector<glm::vec4> mirrored, squeezed;     // of the reflection and the refraction image
  std::vector<float> above_water, below_water;   // their clip distances [m]
};

// Per-tile results of visibility, in tile order.
struct VisibilityBuffer {
  raster::TileGrid grid;
  std::vector<float> depth;
  std::vector<std::uint32_t> primitive;
  std::vector<int> covered;             // pixels with a surface; -1: no triangle, buffers unset
  std::vector<std::uint8_t> has_water;  // 0 or 1

  std::size_t tile_pixels() const {
    return static_cast<std::size_t>(grid.tile_size_px) * grid.tile_size_px;
  }
  std::span<float> depth_of(int tile) {
    return {depth.data() + tile * tile_pixels(), tile_pixels()};
  }
  std::span<std::uint32_t> primitive_of(int tile) {
    return {primitive.data() + tile * tile_pixels(), tile_pixels()};
  }
};

// Scratch memory of one thread.
struct ThreadScratch {
  ShadeScratch shade;
  alignas(64) std::array<float, kMaxTilePixels> depth;
  alignas(64) std::array<std::uint32_t, kMaxTilePixels> primitive;
};

struct Workspace::State {
  Profile profile;
  // Sea.
  ocean::SeaFrame sea;
  std::vector<texture::PackedMap2> patch_maps;
  texture::UvNoise uv_noise{{}};
  std::vector<float> noise_cos, noise_sin;
  texture::PackedMap2 uv_noise_map;
  std::vector<float> coast_slope_x, coast_slope_y, coast_foam;
  texture::PackedMap2 coast_slopes, coast_surf;  // slopes; the trains' share and their foam
  // Geometry.
  Surface water, land;
  ObjectGeometry objects;
  // Pixels.
  raster::Pass pass;
  VisibilityBuffer visibility;
  LookupTarget reflection, refraction;
  Target small;  // the picture before it is enlarged
  EnlargeTables enlarge;
  std::vector<TileLookups> tile_lookups;
  std::vector<int> shaded;  // per tile
  std::vector<std::unique_ptr<ThreadScratch>> scratch;
  ShadeContext context;
};

// Everything a stage needs of this frame.
struct Frame {
  const World::State& world;
  const View& view;
  double t_s;
  const FrameOptions& options;  // without zeros that mean the scene's
  Workspace::State& ws;
  Workers& workers;

  raster::Viewport viewport() const { return {view.width_px, view.height_px}; }
};

void advance_sea(Frame& frame);
void triangulate(Frame& frame);
void displace(Frame& frame);
void place_objects(Frame& frame);
void find_visible(Frame& frame);
void draw_lookup_images(Frame& frame);
void shade_pixels(Frame& frame, Target& target);

// Primitives are numbered through the water, then the land, then the objects.
std::uint32_t water_triangles(const Frame& frame);
std::uint32_t land_triangles(const Frame& frame);  // 0 without terrain

// The sea's surface at the frame's time, after advance_sea.
ocean::WaterSurface water_surface(const Frame& frame);

// Draws triangle edges, tinted by level of detail, over a tile of the finished picture.
void draw_wireframe(const Frame& frame, int tile, Target& target);

// The constants of shading for a view of this frame; kind kWindow fills everything.
void fill_shade_context(const Frame& frame, const View& view, ViewKind kind, ShadeContext& context);

}  // namespace swell::render
