// Stage 3: heights of the vertices of water and land.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "math/check.h"
#include "ocean/open_sea/sea.h"
#include "ocean/water_surface.h"
#include "render/frame/options.h"
#include "render/frame/profile.h"
#include "render/sea/background.h"
#include "render/sea/sea_maps.h"
#include "render/view/meshes.h"
#include "render/view/render_view.h"
#include "render/view/wave_reach.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

// Positions of the mesh's vertices relative to the eye.
void place_vertices(Surface& surface, std::size_t begin, std::size_t end, glm::dvec2 eye) {
  lod::Domain from_eye = surface.domain;
  from_eye.min_world -= eye;
  for (std::size_t i = begin; i < end; ++i)
    surface.offset[i] = glm::vec2(from_eye.point(surface.mesh.lattice[i]));
}

void displace_land(const terrain::HeightGrid& terrain, glm::dvec2 eye, std::size_t begin,
                   std::size_t end, Surface& land) {
  place_vertices(land, begin, end, eye);
  const std::size_t count = end - begin;
  std::array<glm::dvec2, kVertexChunk> p;
  for (std::size_t i = 0; i < count; ++i) p[i] = eye + glm::dvec2(land.offset[begin + i]);
  terrain::sample_heights(terrain, std::span(p).first(count),
                          std::span(land.height_m).subspan(begin, count));
}

// Calls displace_some(begin, end) for all vertices of the surface, in chunks, and maps them.
template <class Body>
void displace_in_chunks(SurfaceKind kind, Surface& surface, const Meshes& meshes, FrameViews views,
                        const StageRun& run, const Body& displace_some) {
  const std::size_t count = surface.mesh.lattice.size();
  surface.offset.resize(count);
  surface.height_m.resize(count);
  resize_vertices(kind, count, views);
  run.for_each((count + kVertexChunk - 1) / kVertexChunk, [&](std::size_t chunk, int) {
    const std::size_t begin = chunk * kVertexChunk, end = std::min(count, begin + kVertexChunk);
    displace_some(begin, end);
    map_vertices(meshes, kind, begin, end, views);
  });
}

// Floating things further out than waves reach. There the sea has finer triangles, as if it were
// focus_nearer times nearer (PriorityFactors), on which waves carry the thing.
struct FarFocuses {
  std::array<lod::Focus, lod::kMaxFocuses> focus;
  std::size_t count = 0;

  FarFocuses(const WorldState& world, std::span<const lod::Focus> focuses, glm::dvec3 eye,
             double reach_m) {
    if (focuses.empty()) return;
    const auto inv_reach = static_cast<float>(1.0 / reach_m);
    const double widest_m = 0.5 * world.water_bounds().mean_wavelength_m;
    for (const lod::Focus& f : focuses) {
      const double distance_m = glm::length(glm::dvec3(f.centre_m - glm::dvec2(eye), eye.z));
      if (wave_share(static_cast<float>(distance_m), inv_reach) == 1.0f) continue;
      const double width_m = widest_m * distance_m / (reach_m * world.scene.detail.objects);
      focus[count++] = {f.centre_m, f.radius_m + width_m};
    }
  }

  // What of the waves a vertex shows for their sake: all within a radius, none beyond two.
  float share_at(glm::dvec2 p_world) const {
    double share = 0.0;
    for (const lod::Focus& f : std::span(focus).first(count))
      share = std::max(share, 2.0 - glm::distance(p_world, f.centre_m) / f.radius_m);
    return static_cast<float>(std::min(share, 1.0));
  }
};

// The sea's waves come some way into rivers.
void displace_rivers(const WorldState& world, const SeaMaps& sea, const View& view,
                     std::size_t begin, std::size_t end, RiverMesh& rivers) {
  std::array<glm::dvec2, kVertexChunk> place;
  std::array<std::size_t, kVertexChunk> vertex;
  std::array<float, kVertexChunk> height_m;
  std::size_t count = 0;
  for (std::size_t i = begin; i < end; ++i) {
    if (rivers.sea_share[i] <= 0.0f) continue;
    place[count] = glm::dvec2(view.eye_world) + glm::dvec2(rivers.p_rel[i]);
    vertex[count++] = i;
  }
  const auto heights = std::span(height_m).first(count);
  water_surface(world, sea).heights(std::span(place).first(count), heights);
  const auto eye_z = static_cast<float>(view.eye_world.z);
  for (std::size_t k = 0; k < count; ++k) {
    // On a bank that is no longer the river's there is none.
    float& z = rivers.p_rel[vertex[k]].z;
    z += std::max(heights[k] - (z + eye_z), -1.0f);
  }
}

}  // namespace

glm::dvec2 vertex_world(const Surface& surface, std::size_t vertex) {
  return surface.domain.point(surface.mesh.lattice[vertex]);
}

// Heights come from where the vertex is in the world, exactly, not from its rounded offset: a query
// of the surface there gives the same bits, within the waves' reach.
void water_heights(const WaterHeights& in, const Surface& water, std::size_t begin, std::size_t end,
                   std::span<float> vertex_height_m) {
  SWELL_DCHECK(end - begin <= kVertexChunk, "{} vertices", end - begin);
  const auto height_m = vertex_height_m.subspan(begin, end - begin);
  std::ranges::fill(height_m, 0.0f);
  if (in.world.scene.detail.triangulation == scene::Triangulation::kPlane) return;

  // The vertices that waves move.
  std::array<glm::dvec2, kVertexChunk> place;
  std::array<glm::vec2, kVertexChunk> offset;
  std::array<float, kVertexChunk> share;
  std::array<std::uint16_t, kVertexChunk> vertex;
  const auto eye_z = static_cast<float>(in.view.eye_world.z);
  const auto inv_reach = static_cast<float>(1.0 / water.statistics.reach_m);
  const FarFocuses focuses(in.world, water.focuses, in.view.eye_world, water.statistics.reach_m);
  std::size_t count = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const glm::vec2 p = water.offset[i];
    place[count] = vertex_world(water, i);
    share[count] = wave_share(std::sqrt(p.x * p.x + p.y * p.y + eye_z * eye_z), inv_reach);
    if (share[count] < 1.0f && focuses.count > 0)
      share[count] = std::max(share[count], focuses.share_at(place[count]));
    if (share[count] == 0.0f) continue;
    offset[count] = p;
    vertex[count++] = static_cast<std::uint16_t>(i - begin);
  }

  std::array<float, kVertexChunk> wave_m;
  const auto p_world = std::span(place).first(count);
  const auto waves = std::span(wave_m).first(count);
  ocean::WaterParts sea_alone = in.world.water();
  sea_alone.sea_alone = true;
  const ocean::WaterSurface surface(sea_alone, in.sea);
  if (in.background_error_px > 0.0f)
    background_heights(Background(in.view, *in.world.sea, in.world.water_bounds().height_m,
                                  in.background_error_px),
                       surface, p_world, std::span(offset).first(count), waves);
  else
    surface.heights(p_world, waves);
  for (std::size_t k = 0; k < count; ++k) height_m[vertex[k]] = wave_m[k] * share[k];
}

void displace(const WorldState& world, const SeaMaps& sea, const View& view,
              const FrameOptions& options, Meshes& meshes, FrameViews views, const StageRun& run) {
  const WaterHeights heights{world, sea.frame, view,
                             static_cast<float>(options.background_error_px)};
  const glm::dvec2 eye(view.eye_world);
  displace_in_chunks(SurfaceKind::kWater, meshes.water, meshes, views, run,
                     [&](std::size_t begin, std::size_t end) {
                       place_vertices(meshes.water, begin, end, eye);
                       water_heights(heights, meshes.water, begin, end, meshes.water.height_m);
                     });
  displace_in_chunks(SurfaceKind::kTerrain, meshes.land, meshes, views, run,
                     [&](std::size_t begin, std::size_t end) {
                       displace_land(*world.terrain, eye, begin, end, meshes.land);
                     });
  const std::size_t count = meshes.rivers.p_rel.size();
  resize_vertices(SurfaceKind::kRivers, count, views);
  run.for_each((count + kVertexChunk - 1) / kVertexChunk, [&](std::size_t chunk, int) {
    const std::size_t begin = chunk * kVertexChunk, end = std::min(count, begin + kVertexChunk);
    displace_rivers(world, sea, view, begin, end, meshes.rivers);
    map_vertices(meshes, SurfaceKind::kRivers, begin, end, views);
  });
}

}  // namespace swell::render
