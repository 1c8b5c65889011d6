// Stage 2: the triangulations for the view.
#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <limits>
#include <tuple>

#include "lod/plane.h"
#include "lod/radial_grid.h"
#include "ocean/water.h"
#include "render/frame/options.h"
#include "render/frame/profile.h"
#include "render/sky/sky_maps.h"
#include "render/view/meshes.h"
#include "render/world/world_state.h"
#include "sky/fog.h"
#include "terrain/apron.h"

namespace swell::render {
namespace {

// The endless sea: a square around the eye that reaches beyond its horizon, as small as that
// allows, since triangles that nobody sees are missed elsewhere: of 131 km up to about 150 m and
// around a limited sea on a flat earth, of 2097 km at 40 km, where the horizon is 765 km away. Its
// corner moves in steps of a 32nd of that; a step changes triangles wider than half of it alone,
// which lie far from any eye and, without waves, miss the earth's curve by less than a picture
// shows.
constexpr int kLeastSeaBits = 17, kMostSeaBits = 21, kSeaSteps = 32;

// The size is a power of two.
int sea_bits(const lod::AdaptRequest& request, bool limited) {
  if (std::isinf(request.earth_radius_m)) return limited ? kLeastSeaBits : kMostSeaBits;
  const auto horizon_m = [&](double height_m) {
    return std::sqrt(2.0 * request.earth_radius_m * std::max(height_m, 0.0));
  };
  const double eye_m = request.view.eye_world.z - static_cast<double>(request.min_height_m);
  const double waves_m = static_cast<double>(request.max_height_m - request.min_height_m);
  const double seen_m = horizon_m(eye_m) + horizon_m(waves_m);
  int bits = kLeastSeaBits;
  while (bits < kMostSeaBits && seen_m > std::ldexp(0.5 - 1.0 / kSeaSteps, bits)) ++bits;
  return bits;
}

// Vertices every 1 m, 0.25 m or 0.125 m at the closest. A small budget is better spent further off,
// a large one has nothing left to do there: docs/understand/lod.md.
int splits_of_metre(int budget) { return budget < 4000 ? 0 : budget <= 40000 ? 2 : 3; }

lod::Domain domain_around(const View& view, double size_m, double step_m, int lattice_bits) {
  const glm::dvec2 cell = glm::floor(glm::dvec2(view.eye_world) / step_m) * step_m;
  return {cell - 0.5 * size_m, size_m, lattice_bits};
}

bool is_limited(const scene::SeaArea& area) { return area.size_m.x > 0.0 && area.size_m.y > 0.0; }

lod::Domain sea_domain(const lod::AdaptRequest& request, bool limited) {
  const int bits = sea_bits(request, limited);
  const double size_m = std::ldexp(1.0, bits);
  return domain_around(request.view, size_m, size_m / kSeaSteps,
                       bits + splits_of_metre(request.triangle_budget));
}

// Two triangles: larger ones would take the nearest water's depth from corners too far away.
lod::Domain plane_domain(const View& view) { return domain_around(view, 0x1p16, 0x1p12, 1); }

// The terrain with its apron. With 2^n + 1 samples a side, vertices on the map are on samples.
lod::Domain land_domain(const terrain::HeightGrid& terrain, bool has_apron) {
  const terrain::Grid square = has_apron ? terrain::square_with_apron(terrain) : terrain.grid;
  const auto cells = static_cast<unsigned>(std::max(square.samples_x - 1, 2));
  return {square.min_world, square.size_m(), std::clamp<int>(std::bit_width(cells - 1), 1, 13)};
}

// Maps give the land its look, so triangles are needed for its shape alone: fewer where it is flat,
// and under water, which blurs what it shows.
constexpr float kFlatLand = 8.0f, kSunkenLand = 16.0f, kMostTimes = 16.0f;

// Where 1/e of the contrast is left, of things seen level through haze and the fog and rain at the
// eye.
double seen_distance_m(const scene::Scene& scene, double eye_height_m) {
  const double fog_m = sky::fog_above_m(scene.air, eye_height_m);
  const double top_m = sky::fog_layer_top_m(scene.air);
  const bool is_slab = scene.air.profile == scene::FogProfile::kSlab;
  const double density = fog_m <= 0.0 ? 0.0 : is_slab ? 1.0 : fog_m / top_m;
  return 1.0 / (1.0 / scene.sky.haze_distance_m + density * sky::fog_per_m(scene.air).y);
}

// How far things are seen by this light, over how far they are by day: where what is left of the
// contrast is a step of the picture. `white`: what a white level surface shows, 1 by day.
double seen_by_light(double white) {
  constexpr double kSteps = 255.0, kLeast = 0.05;
  return std::clamp(log(std::max(white, 1e-6) * kSteps) / log(kSteps), kLeast, 1.0);
}

double white_shown(const SkyMaps& sky) {
  const float sun = sky.irradiance.y * std::max(sky.to_light.z, 0.0f) / static_cast<float>(kPi);
  return static_cast<double>(sky.exposure * (sky.ambient.y + sun));
}

lod::PriorityFactors priority_factors(const WorldState& world, const View& view) {
  const scene::Scene& scene = world.scene;
  const scene::Detail& detail = scene.detail;
  lod::PriorityFactors factors;
  factors.focus_nearer = static_cast<float>(detail.objects);
  factors.back_facing = static_cast<float>(detail.back_facing);
  factors.flat = static_cast<float>(detail.normal_spread);
  factors.off_silhouette = static_cast<float>(detail.silhouette);
  if (detail.visibility > 0.0)
    factors.haze_distance_m =
        static_cast<float>(seen_distance_m(scene, view.eye_world.z) *
                           seen_by_light(white_shown(*world.sky)) / detail.visibility);
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

// What both surfaces are triangulated for.
struct Wanted {
  const WorldState& world;
  const View& view;
  double t_s;
  const FrameOptions& options;
};

// The hulls, and as much of the water around as their waterlines and their mirror images take. If
// there are more than a triangulation may know: those that look largest.
void find_focuses(const Wanted& wanted, std::vector<lod::Focus>& focuses) {
  focuses.clear();
  const std::vector<scene::FloatingObject>& objects = wanted.world.scene.objects;
  for (const scene::FloatingObject& object : objects)
    focuses.push_back({scene::plan_pose(object, wanted.t_s).position_m + object.middle_m,
                       std::max(object.size_m.x, object.size_m.y)});
  for (const scene::GivenPose& given : wanted.options.poses)
    focuses[given.object].centre_m = glm::dvec2(given.pose.position_world);
  if (focuses.size() <= lod::kMaxFocuses) return;
  const auto looks_m2 = [&](const lod::Focus& f) {
    const glm::dvec3 away(f.centre_m - glm::dvec2(wanted.view.eye_world), wanted.view.eye_world.z);
    return f.radius_m * f.radius_m / std::max(glm::dot(away, away), 1.0);
  };
  std::ranges::sort(focuses, [&](const lod::Focus& a, const lod::Focus& b) {
    const auto rank = [&](const lod::Focus& f) {
      return std::tuple(-looks_m2(f), f.centre_m.x, f.centre_m.y, f.radius_m);
    };
    return rank(a) < rank(b);
  });
  focuses.resize(lod::kMaxFocuses);
}

lod::AdaptRequest request_for(const Wanted& wanted, int budget, float low_m, float high_m) {
  const scene::Detail& detail = wanted.world.scene.detail;
  lod::AdaptRequest request;
  request.view = wanted.view;
  request.triangle_budget = budget;
  request.priority = detail.inverse_distance_priority ? lod::Priority::kInverseDistance
                                                      : lod::Priority::kProjectedSize;
  request.min_height_m = low_m;
  request.max_height_m = high_m;
  request.earth_radius_m = wanted.world.earth_radius_m(wanted.options.without);
  request.factors = priority_factors(wanted.world, wanted.view);
  request.limits = adapt_limits(wanted.options);
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

// Clears what an earlier frame left.
void clear_surface(Surface& surface) {
  surface.statistics = {};
  surface.mesh_revision = 0;
  surface.mesh.lattice.clear();
  surface.mesh.indices.clear();
  surface.mesh.level.clear();
}

void triangulate_water(const Wanted& wanted, Surface& water) {
  if (wanted.options.without.has(Part::kWater)) return clear_surface(water);
  const scene::Detail& detail = wanted.world.scene.detail;
  const int budget = wanted.options.water_triangles;
  if (detail.triangulation != scene::Triangulation::kRoam) water.mesh_revision = 0;
  find_focuses(wanted, water.focuses);
  switch (detail.triangulation) {
    case scene::Triangulation::kRoam: {
      const ocean::WaterBounds bounds = wanted.world.water_bounds(wanted.options.disturbances);
      lod::AdaptRequest request = request_for(wanted, budget, -bounds.height_m, bounds.height_m);
      request.max_slope = bounds.slope;
      request.least_size_px = static_cast<float>(detail.least_water_triangle_px);
      if (bounds.mean_wavelength_m > 0.0) request.largest_size_m = 0.5 * bounds.mean_wavelength_m;
      request.focuses = water.focuses;
      const bool limited = is_limited(wanted.world.scene.area);
      adapt_surface(sea_domain(request, limited), request, wanted.options.triangle_capacity, water);
      // A sea that ends has no waves where triangles are wide.
      if (limited) water.statistics.reach_m = std::numeric_limits<double>::infinity();
      break;
    }
    case scene::Triangulation::kRadial:
      water.domain = lod::radial_domain(wanted.view);
      water.statistics = lod::write_radial_grid(wanted.view, budget, water.mesh);
      break;
    case scene::Triangulation::kPlane:
      water.domain = plane_domain(wanted.view);
      lod::write_plane(water.domain, water.mesh);
      water.statistics = {.triangles = 2};
      break;
  }
}

void triangulate_land(const Wanted& wanted, Surface& land) {
  if (!wanted.world.terrain || wanted.world.land_rays) return clear_surface(land);
  const terrain::HeightGrid& terrain = *wanted.world.terrain;
  const auto floor_m = std::min(terrain.lowest_m, static_cast<float>(terrain.apron.floor_m));
  lod::AdaptRequest request =
      request_for(wanted, wanted.options.terrain_triangles, floor_m, terrain.highest_m);
  const bool has_apron = !wanted.options.without.has(Part::kApron);
  if (has_apron) {
    request.relief = wanted.world.relief_bounds.get();
    request.factors.flat = std::min(kFlatLand * request.factors.flat, kMostTimes);
    request.factors.sunken = kSunkenLand;
  }
  // The mirrored land lies outside the view at times, what an eye under water sees through the
  // surface nearly always.
  request.frustum_margin = wanted.view.eye_world.z < 0.0 ? 3.0f : 0.3f;
  adapt_surface(land_domain(terrain, has_apron), request, wanted.options.triangle_capacity, land);
}

}  // namespace

void triangulate(const WorldState& world, const View& view, double t_s, const FrameOptions& options,
                 Meshes& meshes, const StageRun& run) {
  const Wanted wanted{world, view, t_s, options};
  run.workers.run_both([&] { triangulate_water(wanted, meshes.water); },
                       [&] {
                         triangulate_land(wanted, meshes.land);
                         choose_rivers(world, view, options, meshes.rivers);
                       });
}

}  // namespace swell::render
