#include "render/view/render_view.h"

#include <algorithm>
#include <cmath>

#include "math/check.h"
#include "render/view/draw_record.h"
#include "render/view/meshes.h"
#include "render/view/refracted_image.h"
#include "render/world/world_state.h"

namespace swell::render {

glm::vec3 map_point(const PointMap& map, const WorldPoint& point) {
  const glm::vec3 p = point.p_rel;
  const float above = point.above_m, level = point.level_rel_m, n = map.refraction_index;
  switch (map.kind) {
    case ViewKind::kWindow:
      return p;
    case ViewKind::kReflection:
      return {p.x, p.y, level - above};
    case ViewKind::kRefraction:
      break;
  }
  const float horizontal_m = std::sqrt(p.x * p.x + p.y * p.y), eye_m = map.eye.to_surface_m;
  if (map.eye.submerged) {
    if (above < 0.0f) return {p.x, p.y, level + above};
    return {p.x, p.y, level + apparent_height_m({above, eye_m, horizontal_m}, n)};
  }
  // What is cut off above the level goes on as below it, so that triangles that pass the level are
  // moved right up to where they do; they do not reach high.
  constexpr float kHigh_m = 10.0f;
  if (above > kHigh_m) return {p.x, p.y, level + above};
  const BentWay way{eye_m, std::abs(above), horizontal_m};
  const float apparent_m = map.paper_refraction ? paper_depth_m(way, n) : apparent_depth_m(way, n);
  return {p.x, p.y, level + std::copysign(apparent_m, above)};
}

glm::vec4 image_clip_plane(ViewKind kind, const EyeInWater& eye, SurfaceKind surface,
                           float margin_m) {
  const float to_eyes_side = eye.submerged ? -1.0f : 1.0f;
  if (kind == ViewKind::kRefraction) return {0.0f, 0.0f, -to_eyes_side, margin_m};
  return {0.0f, 0.0f, to_eyes_side, kSurfaceTraits[surface].keeps_clip_margin ? margin_m : 0.0f};
}

glm::vec4 relative_plane(const glm::dvec4& world, glm::dvec3 eye_world) {
  return glm::vec4(glm::dvec4(glm::dvec3(world), world.w + glm::dot(glm::dvec3(world), eye_world)));
}

namespace {

float distance_to(const glm::vec4& plane, glm::vec3 p) {
  return plane.x * p.x + plane.y * p.y + plane.z * p.z + plane.w;
}

// Maps vertices [begin, end) of a surface, whose points are point(i).
template <ViewKind kView, class Point>
void map_points(SurfaceKind surface, std::size_t begin, std::size_t end, const RenderView& view,
                const Point& point, ViewVertices& out) {
  const glm::mat4 clip_from_rel = view.camera.clip_from_rel;
  const PointMap map{kView, view.eye, view.refraction_index, view.paper_refraction};
  const float drop_per_m2 = view.drop_per_m2;
  const glm::vec4 image_plane = image_clip_plane(kView, view.eye, surface, view.clip_margin_m);
  const bool is_cut = view.clip_plane.has_value();
  const glm::vec4 plane =
      relative_plane(view.clip_plane.value_or(glm::dvec4(0.0)), view.camera.eye_world);
  glm::vec4* const p_clip = out.p_clip.data();
  float* const distance = out.clip_distance.data();
  float* const second_distance = out.second_clip_distance.data();
  for (std::size_t i = begin; i < end; ++i) {
    const WorldPoint p = point(i);
    glm::vec3 shown = map_point(map, p);
    shown.z -= (shown.x * shown.x + shown.y * shown.y) * drop_per_m2;
    p_clip[i] = clip_from_rel * glm::vec4(shown, 1.0f);
    if constexpr (kView != ViewKind::kWindow)
      distance[i] = distance_to(image_plane, {p.p_rel.x, p.p_rel.y, p.above_m});
    if (is_cut) second_distance[i] = distance_to(plane, p.p_rel);
  }
}

template <class Point>
void map_range(SurfaceKind surface, std::size_t begin, std::size_t end, const RenderView& view,
               const Point& point, ViewVertices& out) {
  switch (view.kind) {
    case ViewKind::kWindow:
      return map_points<ViewKind::kWindow>(surface, begin, end, view, point, out);
    case ViewKind::kReflection:
      return map_points<ViewKind::kReflection>(surface, begin, end, view, point, out);
    case ViewKind::kRefraction:
      return map_points<ViewKind::kRefraction>(surface, begin, end, view, point, out);
  }
}

}  // namespace

void resize_vertices(SurfaceKind surface, std::size_t count, FrameViews views) {
  for (RenderView* view : views) {
    if (!shows(view->kind, surface)) continue;
    ViewVertices& out = view->vertices_of(surface);
    out.p_clip.resize(count);
    if (view->kind != ViewKind::kWindow) out.clip_distance.resize(count);
    out.second_clip_distance.resize(view->clip_plane ? count : 0);
  }
}

void map_vertices(const Meshes& meshes, SurfaceKind surface, std::size_t begin, std::size_t end,
                  FrameViews views) {
  for (RenderView* view : views) {
    if (!shows(view->kind, surface)) continue;
    ViewVertices& out = view->vertices_of(surface);
    visit_points(meshes, surface, *view,
                 [&](const auto& point) { map_range(surface, begin, end, *view, point, out); });
  }
}

void prepare_view_pass(const Meshes& meshes, int tile_size_px, int edge_samples, RenderView& view,
                       Workers& workers) {
  std::array<std::uint32_t, kSurfaceKinds> triangles{};
  std::array<raster::Draw, kSurfaceKinds> draws;
  for (const SurfaceKind s : kAllSurfaces) {
    DrawRecord& record = view.draws[s] = {};
    if (!shows(view.kind, s) || !meshes.has_material[s]) continue;
    record = draw_record(meshes, s, view.kind);
    record.is_cast = s == SurfaceKind::kTerrain && view.land;
    triangles[static_cast<std::size_t>(s)] =
        record.is_cast ? 1 : static_cast<std::uint32_t>(record.indices.size() / 3);
  }
  view.primitives = PrimitiveRanges(triangles);
  std::size_t count = 0;
  for (const SurfaceKind s : kAllSurfaces) {
    if (view.primitives.empty(s)) continue;
    const ViewVertices& vertices = view.vertices_of(s);
    draws[count].p_clip = vertices.p_clip;
    draws[count].clip_distance = {vertices.clip_distance, vertices.second_clip_distance};
    draws[count].indices = view.draws[s].indices;
    draws[count++].first_primitive = view.primitives.begin(s);
  }
  raster::prepare_pass(std::span(draws).first(count), view.viewport(), tile_size_px, view.pass,
                       workers, edge_samples);
  find_implicits(meshes.objects.drawn_in(view.kind), view);
}

}  // namespace swell::render
