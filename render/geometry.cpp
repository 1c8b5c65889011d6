// Stages 1 to 3: the sea at time t, the triangulations for the view, the vertices.
#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>

#include "lod/plane.h"
#include "lod/radial_grid.h"
#include "math/elementary.h"
#include "render/background.h"
#include "render/frame_state.h"

namespace swell::render {
namespace {

// The endless sea: a square of 64 km around the eye, whose corner moves in whole steps.
constexpr double kSeaSize_m = 65536.0, kSeaStep_m = 4096.0;
constexpr int kUvNoiseSize = texture::UvNoiseOptions{}.size;
constexpr double kUvNoiseCells_per_s = 0.25;
constexpr float kCoastSlopeScale = 1.5f / 127.0f;  // steeper fronts of breaking waves are clamped
constexpr std::size_t kChunk = 2048;               // vertices a task

// Vertices every 1 m, 0.25 m or 0.125 m at the closest. A small budget is better spent further off,
// a large one has nothing left to do there: docs/lod.md has the errors of all three.
int sea_lattice_bits(int budget) { return budget < 4000 ? 16 : budget <= 40000 ? 18 : 19; }

lod::Domain sea_domain(const View& view, int budget) {
  const glm::dvec2 cell = glm::floor(glm::dvec2(view.eye_world) / kSeaStep_m) * kSeaStep_m;
  return {cell - 0.5 * kSeaSize_m, kSeaSize_m, sea_lattice_bits(budget)};
}

lod::Domain land_domain(const terrain::HeightGrid& terrain) {
  const auto cells = static_cast<unsigned>(std::max(terrain.grid.samples_x - 1, 2));
  return {terrain.grid.min_world, terrain.grid.size_m(),
          std::clamp<int>(std::bit_width(cells - 1), 1, 12)};
}

lod::PriorityFactors priority_factors(const scene::Scene& scene) {
  const scene::Detail& detail = scene.detail;
  lod::PriorityFactors factors;
  factors.focus_nearer = static_cast<float>(detail.objects);
  factors.back_facing = static_cast<float>(detail.back_facing);
  factors.flat = static_cast<float>(detail.normal_spread);
  factors.off_silhouette = static_cast<float>(detail.silhouette);
  if (detail.visibility > 0.0)
    factors.haze_distance_m = static_cast<float>(scene.sky.haze_distance_m / detail.visibility);
  return factors;
}

lod::AdaptLimits adapt_limits(const FrameOptions& options) {
  using Clock = std::chrono::steady_clock;
  lod::AdaptLimits limits;
  if (options.lod_operations > 0) limits.max_operations = options.lod_operations;
  if (options.lod_ms > 0.0)
    limits.deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                         std::chrono::duration<double, std::milli>(options.lod_ms));
  limits.priority_groups = options.lod_groups;
  return limits;
}

lod::AdaptRequest request_for(const Frame& frame, int budget, float low_m, float high_m) {
  const scene::Detail& detail = frame.world.scene.detail;
  lod::AdaptRequest request;
  request.view = frame.view;
  request.triangle_budget = budget;
  request.priority = detail.inverse_distance_priority ? lod::Priority::kInverseDistance
                                                      : lod::Priority::kProjectedSize;
  request.min_height_m = low_m;
  request.max_height_m = high_m;
  request.factors = priority_factors(frame.world.scene);
  request.limits = adapt_limits(frame.options);
  return request;
}

// capacity: triangles to keep storage for, besides those of the request.
void adapt_surface(const lod::Domain& domain, const lod::AdaptRequest& request, int capacity,
                   Surface& surface) {
  capacity = std::max(capacity, request.triangle_budget);
  if (!surface.roam || surface.max_triangles < capacity) {
    surface.roam.emplace(domain, capacity);
    surface.max_triangles = capacity;
    surface.mesh_revision = 0;
  }
  surface.roam->set_domain(domain);
  surface.statistics = surface.roam->adapt(request);
  surface.domain = domain;
  surface.roam->update_mesh(surface.mesh, surface.mesh_revision);
}

void triangulate_water(const Frame& frame) {
  const scene::Detail& detail = frame.world.scene.detail;
  const int budget = frame.options.water_triangles;
  Surface& water = frame.ws.water;
  if (detail.triangulation != scene::Triangulation::kRoam) water.mesh_revision = 0;
  switch (detail.triangulation) {
    case scene::Triangulation::kRoam: {
      const float bound = frame.world.height_bound_m();
      lod::AdaptRequest request = request_for(frame, budget, -bound, bound);
      request.max_slope = frame.world.slope_bound();
      if (const double mean_m = frame.world.mean_wavelength_m(); mean_m > 0.0)
        request.largest_size_m = 0.5 * mean_m;
      request.focuses = frame.world.focuses;
      adapt_surface(sea_domain(frame.view, budget), request, frame.options.triangle_capacity,
                    water);
      break;
    }
    case scene::Triangulation::kRadial:
      water.domain = lod::radial_domain(frame.view);
      water.statistics = lod::write_radial_grid(frame.view, budget, water.mesh);
      break;
    case scene::Triangulation::kPlane:
      water.domain = sea_domain(frame.view, budget);
      lod::write_plane(water.domain, water.mesh);
      water.statistics = {.triangles = 2};
      break;
  }
}

void triangulate_land(const Frame& frame) {
  if (!frame.world.terrain) {
    frame.ws.land.statistics = {};  // of an earlier world
    return;
  }
  const terrain::HeightGrid& terrain = *frame.world.terrain;
  lod::AdaptRequest request =
      request_for(frame, frame.options.terrain_triangles, terrain.lowest_m, terrain.highest_m);
  request.relief = frame.world.relief_bounds.get();
  request.frustum_margin = 0.3f;  // the mirrored land lies outside the view at times
  adapt_surface(land_domain(terrain), request, frame.options.triangle_capacity, frame.ws.land);
}

// Positions of the mesh's vertices relative to the eye.
void place_vertices(Surface& surface, std::size_t begin, std::size_t end, glm::dvec2 eye) {
  lod::Domain from_eye = surface.domain;
  from_eye.min_world -= eye;
  for (std::size_t i = begin; i < end; ++i)
    surface.offset[i] = glm::vec2(from_eye.point(surface.mesh.lattice[i]));
}

glm::vec4 to_clip(const View& view, glm::vec2 offset, float z_rel) {
  return view.clip_from_rel * glm::vec4(offset, z_rel, 1.0f);
}

// Heights come from where the vertex is in the world, exactly, not from its rounded offset: a query
// of the surface there gives the same bits.
void displace_water(Frame& frame, std::size_t begin, std::size_t end) {
  Surface& water = frame.ws.water;
  place_vertices(water, begin, end, glm::dvec2(frame.view.eye_world));
  const std::size_t count = end - begin;
  std::array<glm::dvec2, kChunk> p;
  for (std::size_t i = 0; i < count; ++i) p[i] = vertex_world(water, begin + i);
  const auto height_m = std::span(water.height_m).subspan(begin, count);
  const auto error_px = static_cast<float>(frame.options.background_error_px);
  if (frame.world.scene.detail.triangulation == scene::Triangulation::kPlane)
    std::ranges::fill(height_m, 0.0f);
  else if (error_px > 0.0f)
    background_heights(
        Background(frame.view, *frame.world.sea, frame.world.height_bound_m(), error_px),
        water_surface(frame), std::span(p).first(count),
        std::span<const glm::vec2>(water.offset).subspan(begin, count), height_m);
  else
    water_surface(frame).heights(std::span(p).first(count), height_m);
  const auto eye_z = static_cast<float>(frame.view.eye_world.z);
  for (std::size_t i = begin; i < end; ++i)
    water.p_clip[i] = to_clip(frame.view, water.offset[i], water.height_m[i] - eye_z);
}

void displace_land(Frame& frame, std::size_t begin, std::size_t end) {
  Surface& land = frame.ws.land;
  const glm::dvec2 eye(frame.view.eye_world);
  place_vertices(land, begin, end, eye);
  const std::size_t count = end - begin;
  std::array<glm::dvec2, kChunk> p;
  for (std::size_t i = 0; i < count; ++i) p[i] = eye + glm::dvec2(land.offset[begin + i]);
  terrain::sample_heights(*frame.world.terrain, std::span(p).first(count),
                          std::span(land.height_m).subspan(begin, count));

  // Waves lift the waterline: keep a little of the land in the refraction image. Not the other way:
  // the floor mirrored in flat shallow water is a band of sand instead of sky.
  constexpr float kClipMargin_m = 0.3f;
  const auto eye_z = static_cast<float>(frame.view.eye_world.z);
  const auto n = static_cast<float>(frame.world.scene.water.refraction_index);
  LookupTarget &mirrored = frame.ws.reflection, &squeezed = frame.ws.refraction;
  for (std::size_t i = begin; i < end; ++i) {
    const float z = land.height_m[i];
    const glm::vec2 offset = land.offset[i];
    land.p_clip[i] = to_clip(frame.view, offset, z - eye_z);
    mirrored.p_clip[i] = to_clip(frame.view, offset, -z - eye_z);
    mirrored.clip_distance[i] = z;
    const float z_apparent = z < 0.0f ? z * squeeze({offset, z - eye_z}, n) : z;
    squeezed.p_clip[i] = to_clip(frame.view, offset, z_apparent - eye_z);
    squeezed.clip_distance[i] = kClipMargin_m - z;
  }
}

void bake_coast(Frame& frame) {
  Workspace::State& ws = frame.ws;
  constexpr std::size_t kPoints = static_cast<std::size_t>(kCoastMapSize) * kCoastMapSize;
  for (std::vector<float>* map : {&ws.coast_slope_x, &ws.coast_slope_y, &ws.coast_foam})
    map->resize(kPoints);
  ocean::bake_coast(frame.world.coast_maps->waves, frame.t_s, ws.coast_slope_x, ws.coast_slope_y,
                    ws.coast_foam, frame.workers);
}

void pack_patch(const ocean::PatchFrame& patch, texture::PackedMap2& map) {
  // A scale fixed by the sea state, not by the frame, so that codes do not flicker.
  const float scale = 5.0f * std::sqrt(std::max(patch.slope_variance, 1e-8f)) / 127.0f;
  texture::pack_map2(patch.resolution, patch.slope_x, patch.slope_y, scale, map);
}

void resize_surface(Surface& surface) {
  const std::size_t n = surface.mesh.lattice.size();
  surface.offset.resize(n);
  surface.height_m.resize(n);
  surface.p_clip.resize(n);
}

}  // namespace

ocean::WaterSurface water_surface(const Frame& frame) {
  return water_surface(frame.world, frame.ws.sea);
}

float squeeze(glm::vec3 p_rel, float n) {
  const float horizontal2 = p_rel.x * p_rel.x + p_rel.y * p_rel.y;
  const float sin2 = horizontal2 / (horizontal2 + p_rel.z * p_rel.z + 1e-6f);
  return std::sqrt((1.0f - sin2) / (n * n - sin2));
}

glm::dvec2 vertex_world(const Surface& surface, std::size_t vertex) {
  return surface.domain.point(surface.mesh.lattice[vertex]);
}

void advance_sea(Frame& frame) {
  Workspace::State& ws = frame.ws;
  ocean::advance(*frame.world.sea, frame.t_s, ws.sea, frame.workers);
  const bool has_coast = frame.world.coast != nullptr;
  if (has_coast) bake_coast(frame);
  // Pack the maps that shading looks into: the waves', the noise's, the coast's.
  const std::size_t patches = ws.sea.patches.size();
  ws.patch_maps.resize(patches);
  ws.noise_cos.resize(kUvNoiseSize * kUvNoiseSize);
  ws.noise_sin.resize(kUvNoiseSize * kUvNoiseSize);
  frame.workers.for_each(patches + (has_coast ? 3 : 1), [&](std::size_t i, int slot) {
    const WorkScope work(ws.profile, Stage::kSea, slot);
    if (i < patches) {
      pack_patch(ws.sea.patches[i], ws.patch_maps[i]);
    } else if (i == patches) {
      ws.uv_noise.evaluate(kUvNoiseCells_per_s * frame.t_s, ws.noise_cos, ws.noise_sin);
      texture::pack_map2(kUvNoiseSize, ws.noise_cos, ws.noise_sin, 1.0f / 127.0f, ws.uv_noise_map);
    } else if (i == patches + 1) {
      texture::pack_map2(kCoastMapSize, ws.coast_slope_x, ws.coast_slope_y, kCoastSlopeScale,
                         ws.coast_slopes);
    } else {
      texture::pack_map2(kCoastMapSize, frame.world.coast_maps->share, ws.coast_foam, 1.0f / 127.0f,
                         ws.coast_surf);
    }
  });
}

void triangulate(Frame& frame) {
  frame.workers.run_both([&] { triangulate_water(frame); }, [&] { triangulate_land(frame); });
}

void displace(Frame& frame) {
  Workspace::State& ws = frame.ws;
  const auto in_chunks = [&](std::size_t count, auto&& body) {
    frame.workers.for_each((count + kChunk - 1) / kChunk, [&](std::size_t chunk, int slot) {
      const WorkScope work(ws.profile, Stage::kDisplace, slot);
      body(chunk * kChunk, std::min(count, (chunk + 1) * kChunk));
    });
  };
  resize_surface(ws.water);
  in_chunks(ws.water.mesh.lattice.size(),
            [&](std::size_t begin, std::size_t end) { displace_water(frame, begin, end); });
  if (!frame.world.terrain) return;
  resize_surface(ws.land);
  for (LookupTarget* lookup : {&ws.reflection, &ws.refraction}) {
    lookup->p_clip.resize(ws.land.mesh.lattice.size());
    lookup->clip_distance.resize(ws.land.mesh.lattice.size());
  }
  in_chunks(ws.land.mesh.lattice.size(),
            [&](std::size_t begin, std::size_t end) { displace_land(frame, begin, end); });
}

}  // namespace swell::render
