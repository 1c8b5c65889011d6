// The one place that knows how each surface keeps its triangles and the places of its vertices.
#pragma once

#include "render/view/meshes.h"
#include "render/view/render_view.h"

namespace swell::render {

// The surface's triangles in views of a kind. Valid until the meshes change.
inline DrawRecord draw_record(const Meshes& meshes, SurfaceKind surface, ViewKind view) {
  const PlacedSurface& placed = meshes.placed[surface];
  if (!placed.indices.empty()) return {.indices = placed.indices};
  switch (surface) {
    case SurfaceKind::kWater:
      return {.indices = meshes.water.mesh.indices, .level = meshes.water.mesh.level};
    case SurfaceKind::kTerrain:
      return {.indices = meshes.land.mesh.indices, .level = meshes.land.mesh.level};
    case SurfaceKind::kObjects:
      return {.indices = meshes.objects.drawn_in(view).indices,
              .parts = meshes.objects.drawn_in(view).parts};
    case SurfaceKind::kTrees:
      return {.indices = meshes.trees.drawn_in(view).indices,
              .like_land = meshes.trees.drawn_in(view).like_land};
    case SurfaceKind::kRivers:
      return {.indices = meshes.rivers.indices};
    default:
      return {};
  }
}

// Calls visit(point) once: point(i) is the WorldPoint of vertex i of a surface as the view draws
// it.
template <class Visit>
void visit_points(const Meshes& meshes, SurfaceKind surface, const RenderView& view,
                  const Visit& visit) {
  const auto mean_rel_m = -static_cast<float>(view.camera.eye_world.z);
  const float level_m = view.level_m, level_rel_m = mean_rel_m + level_m;
  const auto visit_heights = [&](const Surface& heights) {
    visit([&](std::size_t i) {
      const float height_m = heights.height_m[i];
      return WorldPoint{
          {heights.offset[i], height_m + mean_rel_m}, height_m - level_m, level_rel_m};
    });
  };
  const PlacedSurface& placed = meshes.placed[surface];
  switch (surface) {
    case SurfaceKind::kWater:
      return visit_heights(meshes.water);
    case SurfaceKind::kTerrain:
      return visit_heights(meshes.land);
    case SurfaceKind::kObjects:
      return visit([&objects = meshes.objects.drawn_in(view.kind)](std::size_t i) {
        const glm::vec3 p = objects.p_rel[i];
        return WorldPoint{p, p.z - objects.waterline_rel_m[i], objects.waterline_rel_m[i]};
      });
    case SurfaceKind::kRivers:
      return visit([&](std::size_t i) {
        return WorldPoint{meshes.rivers.p_rel[i], 0.0f, meshes.rivers.p_rel[i].z};
      });
    case SurfaceKind::kTrees:
      return visit([&, &trees = meshes.trees.drawn_in(view.kind)](std::size_t i) {
        const glm::vec3 p = trees.p_rel[i];
        return WorldPoint{p, p.z - level_rel_m, level_rel_m};
      });
    default:
      return visit([&](std::size_t i) {
        const glm::vec3 p = placed.p_rel[i];
        return WorldPoint{p, p.z - level_rel_m, level_rel_m};
      });
  }
}

}  // namespace swell::render
