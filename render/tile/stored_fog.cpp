#include "render/tile/stored_fog.h"

#include <algorithm>

#include "render/frame/profile.h"
#include "render/packets/view_rays.h"
#include "render/sky/fog.h"
#include "render/view/draw_record.h"

namespace swell::render {
namespace {

constexpr std::size_t kChunk = 2048;

// How far a place of a round earth has sunk.
float sunk_m(glm::vec3 p_rel, float drop_per_m2) {
  return (p_rel.x * p_rel.x + p_rel.y * p_rel.y) * drop_per_m2;
}

// Takes their triangles' extent from things that rays found: those but stand for them.
void forget_cast_parts(std::span<const DrawPart> parts, std::span<FogAtPlace> vertices) {
  for (const DrawPart& part : parts)
    if (part.is_cast)
      for (FogAtPlace& vertex : vertices.subspan(part.first_vertex, part.vertices)) vertex = {};
}

}  // namespace

FogAtCorners find_corners(const StoredFog& stored, std::uint32_t primitive) {
  static constexpr FogAtPlace kNowhere;
  for (const SurfaceKind kind : kAllSurfaces) {
    if (!stored.primitives.holds(kind, primitive)) continue;
    const DrawRecord& record = (*stored.draws)[kind];
    if (record.is_cast) break;
    const std::size_t first = std::size_t{3} * (primitive - stored.primitives.begin(kind));
    const FogAtPlace* const vertices = stored.vertices[kind].data();
    return {vertices + record.indices[first], vertices + record.indices[first + 1],
            vertices + record.indices[first + 2]};
  }
  return {&kNowhere, &kNowhere, &kNowhere};
}

void find_fog_at_vertices(const Fog& fog, const Meshes& meshes, const RenderView& window,
                          StoredFog& stored, const StageRun& run) {
  stored.is_table = false;
  stored.draws = &window.draws;
  stored.primitives = window.primitives;
  const float eye_m = fog.at_eye.height_m;
  for (const SurfaceKind kind : kAllSurfaces) {
    const DrawRecord& record = window.draws[kind];
    const bool is_drawn = !record.is_cast && !record.indices.empty();
    std::vector<FogAtPlace>& vertices = stored.vertices[kind];
    vertices.resize(is_drawn ? window.vertices_of(kind).p_clip.size() : 0);
    visit_points(meshes, kind, window, [&](const auto& point) {
      run.for_each((vertices.size() + kChunk - 1) / kChunk, [&](std::size_t n, int) {
        const auto chunk =
            std::span(vertices).subspan(n * kChunk, std::min(kChunk, vertices.size() - n * kChunk));
        for (std::size_t i = 0; i < chunk.size(); ++i) {
          const glm::vec3 p = point(n * kChunk + i).p_rel;
          chunk[i] = {{p.x, p.y, p.z - sunk_m(p, window.drop_per_m2)}, p.z + eye_m};
        }
        see_fog_at(fog, chunk);
      });
    });
    if (is_drawn) forget_cast_parts(record.parts, vertices);
  }
}

void find_fog_by_depth(const Fog& fog, const ViewRays& rays, glm::ivec2 size_px,
                       StoredFog& stored) {
  stored.is_table = true;
  stored.table.resize(FogTable::kRows);
  const glm::vec3 top = rays.ray + 0.5f * static_cast<float>(size_px.x - 1) * rays.ray_dx;
  const auto last_row = static_cast<float>(size_px.y - 1);
  for (int row = 0; row < FogTable::kRows; ++row) {
    const float depth = rays.near_m / FogTable::middle(row);
    // A round earth's sea has sunk there by as much as straight ahead.
    const float sea_z = -rays.eye_z / depth - depth * rays.drop_per_m2;
    const float down = rays.ray_dy.z;
    const float y_px = down != 0.0f ? (sea_z - top.z) / down : 0.5f * last_row;
    const glm::vec3 p = depth * (top + std::clamp(y_px, 0.0f, last_row) * rays.ray_dy);
    const float height_m = rays.eye_z + p.z + sunk_m(p, rays.drop_per_m2);
    stored.table[static_cast<std::size_t>(row)] = {p, height_m};
  }
  see_fog_at(fog, stored.table);
}

}  // namespace swell::render
