// A picture of the frame's surfaces: the window, or one of the pictures that water looks into.
//
// What a view shows is the world itself, the world mirrored in the water's level, or the world
// beyond that level moved to where it appears through the surface. One function maps the vertices
// of every surface; the rest of the frame treats all views alike. For an eye under water the two
// sides of the surface change places.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <iterator>
#include <optional>
#include <span>
#include <vector>

#include "math/view.h"
#include "raster/pass.h"
#include "render/view/implicits.h"
#include "render/view/rivers_drawn.h"
#include "render/view/surfaces.h"

namespace swell {
class Workers;
namespace ocean {
struct SeaFrame;
}
namespace scene {
struct GivenPose;
struct ObjectPose;
}  // namespace scene
}  // namespace swell

namespace swell::render {

struct FrameOptions;
struct LandRays;
struct Meshes;
struct SeaMaps;
struct StageRun;
struct Surface;
struct TreeDraws;
struct WorldState;

// A surface's vertices in a view.
struct ViewVertices {
  std::vector<glm::vec4> p_clip;
  std::vector<float> clip_distance;         // of image_clip_plane(); none in the window
  std::vector<float> second_clip_distance;  // of RenderView::clip_plane, if there is one
};

// A surface's triangles in a view, as the stages after their placing know them.
struct DrawRecord {
  std::span<const std::uint32_t> indices = {};  // 3 per triangle
  // Things that are told apart where edges are looked for, in the order of their triangles; none:
  // all of it is one.
  std::span<const DrawPart> parts = {};
  std::span<const std::uint8_t> like_land =
      {};                                    // per triangle: 1 if it is one with edges_as; or none
  std::span<const std::uint8_t> level = {};  // per triangle, of detail; or none
  bool is_cast = false;                      // found by rays: one primitive for all of it

  const DrawPart& part_of(std::uint32_t triangle) const {
    return *std::prev(std::ranges::upper_bound(parts, triangle, {}, &DrawPart::first_triangle));
  }
};

// Where a view's eye is.
struct EyeInWater {
  bool submerged = false;     // under the drawn surface
  float to_surface_m = 1.0f;  // over 0: to the level, or half of that to the surface if it is more
  float level_m = 0.0f;  // that is looked at: of the water that the eye is in, the sea's from air
};

// The water at an eye's place in the plane.
struct WaterAtEye {
  EyeInWater in_air, in_water;  // from either side of its surface
  bool submerged = false;       // on which the eye is
  bool is_inland = false;       // a river or a lake

  const EyeInWater& from(bool in) const { return in ? in_water : in_air; }
};

struct RenderView {
  ViewKind kind = ViewKind::kWindow;
  View camera;
  EyeInWater eye;
  float refraction_index = 1.333f;
  bool paper_refraction = false;         // scene::RefractionModel::kPaper
  float clip_margin_m = 0.3f;            // of image_clip_plane()
  float level_m = 0.0f;                  // of the water that mirrors or refracts: the sea's is 0
  float drop_per_m2 = 0.0f;              // how far a round earth sinks (math/earth.h)
  std::optional<glm::dvec4> clip_plane;  // FrameOptions::clip_plane
  const LandRays* land = nullptr;        // none: the land is triangles
  bool land_has_apron = true;
  std::array<ViewVertices, kSurfaceKinds> vertices;
  EnumTable<SurfaceKind, DrawRecord> draws;  // of the surfaces that it shows
  PrimitiveRanges primitives;                // of the same
  raster::Pass pass;
  ImplicitsInView implicits;

  ViewVertices& vertices_of(SurfaceKind k) { return vertices[static_cast<std::size_t>(k)]; }
  const ViewVertices& vertices_of(SurfaceKind k) const {
    return vertices[static_cast<std::size_t>(k)];
  }
  raster::Viewport viewport() const { return {camera.width_px, camera.height_px}; }
};

// A point of the flat world on its way into a view.
struct WorldPoint {
  glm::vec3 p_rel;    // relative to the eye [m]
  float above_m;      // its height over the water's level
  float level_rel_m;  // that level over the eye
};

// What a view does to points, besides its camera's doing.
struct PointMap {
  ViewKind kind;
  EyeInWater eye;
  float refraction_index;
  bool paper_refraction = false;
};

// Where a view of the flat world shows the point, relative to the eye. On a round earth it then
// sinks with the level that mirrors it.
glm::vec3 map_point(const PointMap& map, const WorldPoint& point);

// The plane that an image cuts off a surface at, (A, B, C, D) of points (x, y) relative to the eye
// and z over the water's level: what lies where A x + B y + C z + D >= 0 is kept. Waves lift and
// lower the water's edge, so the images keep margin_m of the other side; but not of the land in the
// mirror: the floor mirrored in flat shallow water would be a band of sand instead of sky.
glm::vec4 image_clip_plane(ViewKind kind, const EyeInWater& eye, SurfaceKind surface,
                           float margin_m);
// For a sea of waves up to this height.
inline float clip_margin_m(float highest_wave_m) { return std::clamp(highest_wave_m, 0.02f, 0.3f); }

// Returns a plane of the world as that of points relative to the eye.
glm::vec4 relative_plane(const glm::dvec4& world, glm::dvec3 eye_world);

// Where the eye is in the water at the time of `sea`: a function of world, view and time. A surface
// that reaches into the near plane may lie on both sides of the eye; the point of the eye decides.
WaterAtEye find_water_at_eye(const WorldState& world, const SeaMaps& sea, const View& view,
                             const FrameOptions& options);

// All views of a frame.
using FrameViews = std::span<RenderView* const>;

// Those of one kind among a frame's.
class ViewsOfKind {
 public:
  ViewsOfKind(FrameViews views, ViewKind kind) {
    for (RenderView* const view : views)
      if (view->kind == kind) views_[count_++] = view;
  }
  FrameViews all() const { return std::span(views_).first(count_); }

 private:
  // From the air, from below, of rivers.
  std::array<RenderView*, 2 + kMostRiverMirrors> views_{};
  std::size_t count_ = 0;
};

// Makes room for a surface's vertices in the views that show it.
void resize_vertices(SurfaceKind surface, std::size_t count, FrameViews views);

// Maps vertices [begin, end) of a surface into the views that show it.
void map_vertices(const Meshes& meshes, SurfaceKind surface, std::size_t begin, std::size_t end,
                  FrameViews views);

// Stage 3: heights of all vertices of water and land at the time of `sea`, and their places in the
// views.
void displace(const WorldState& world, const SeaMaps& sea, const View& view,
              const FrameOptions& options, Meshes& meshes, FrameViews views, const StageRun& run);

// What the water's vertices are displaced by at the time of `sea`, as the view needs them.
struct WaterHeights {
  const WorldState& world;
  const ocean::SeaFrame& sea;
  const View& view;
  float background_error_px;
};

// The heights of vertices [begin, end) of the water, at most kVertexChunk, whose offsets are those
// of the view. Allocates nothing.
inline constexpr std::size_t kVertexChunk = 2048;
void water_heights(const WaterHeights& in, const Surface& water, std::size_t begin, std::size_t end,
                   std::span<float> vertex_height_m);

// Where all objects are, as they are drawn: where the caller puts them, or the scene.
void drawn_poses(const WorldState& world, const ocean::SeaFrame& sea,
                 std::span<const scene::GivenPose> given, std::span<scene::ObjectPose> poses,
                 const StageRun& run);

// Stage 3: objects where they are, as far as the view may show them, and their vertices in the
// views.
void place_objects(const WorldState& world, const SeaMaps& sea,
                   std::span<const scene::GivenPose> given, Meshes& meshes, FrameViews views,
                   const StageRun& run);

// Stage 3: the trees that views may show, as they sway at t_s, and their vertices in the views. On
// the ground that is drawn where that has fewer triangles than the scene asks for.
void place_trees(const WorldState& world, double t_s, const FrameOptions& options, Meshes& meshes,
                 FrameViews views, const StageRun& run);

// Sets how far each vertex of `draws`, as place_trees() left it, is from where the same tree has it
// at next_s. Trees that do not sway move by exactly 0.
void find_tree_moves(const WorldState& world, const TreeDraws& draws, double next_s,
                     std::span<glm::vec3> move, const StageRun& run);

// Numbers the triangles of what the view shows, clips, sets up and bins them; with edge_samples
// (0, 4 or 8) also for samples.
void prepare_view_pass(const Meshes& meshes, int tile_size_px, int edge_samples, RenderView& view,
                       Workers& workers);

}  // namespace swell::render
