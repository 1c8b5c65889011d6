#include "render/sea/caustic_maps.h"

#include <algorithm>
#include <cmath>

#include "render/frame/profile.h"
#include "render/sky/sky_maps.h"
#include "render/world/land_shadow.h"
#include "render/world/world_state.h"
#include "terrain/height_grid.h"

namespace swell::render {
namespace {

constexpr double kDepthStep = 3.0;      // of each map's depth over the one before
constexpr double kObjectDepth_m = 3.0;  // floating things reach down to about this
constexpr float kLowestLight = 0.02f;   // z of the direction to a light that tells under water

// How far down there is something to be lit, 0: nothing.
double lit_depth_m(const WorldState& world) {
  double depth_m = world.scene.objects.empty() ? 0.0 : kObjectDepth_m;
  if (world.terrain) {
    depth_m = std::max(depth_m, -static_cast<double>(world.terrain->lowest_m));
    if (world.terrain->apron.width_m > 0.0)
      depth_m = std::max(depth_m, -world.terrain->apron.floor_m);
  }
  return std::min(depth_m, CausticMaps::kDeepest_m);
}

bool shows_caustics(const WorldState& world, PartSet without) {
  return !without.has(Part::kCaustics) && world.scene.water.caustics > 0.0 &&
         world.sky->to_light.z > kLowestLight && world.sky->irradiance != glm::vec3(0.0f);
}

// The disc of sun or moon, as wide as `disc` times in air, and the ripples, each slope of which
// bends light by `bent`: waves too short for patches focus close to the surface, and only scatter
// further off. They are taken to have a fifth of the mean square slope that the wind raises.
// Source: Cox and Munk, Measurement of the Roughness of the Sea Surface, 1954.
float spread_per_m(const WorldState& world, double disc, double bent) {
  const double wind_mps = world.scene.sea.has_wind_waves() ? world.scene.sea.wind_speed_mps : 0.0;
  const double slope2 = 0.2 * 0.5 * (0.003 + 0.00512 * wind_mps);  // along one axis
  const double radius = 0.5 * disc * kSunRadius_rad;
  return static_cast<float>(std::sqrt(radius * radius + bent * bent * slope2));
}

// The shortest waves meet next to the surface, longer ones higher up.
constexpr std::array<float, CausticMaps::kMostPatches> kPlaneHeights_m = {0.3f, 1.5f};

// Returns how many maps of reflected caustics there are to make.
std::size_t begin_mirrored(const WorldState& world, PartSet without, CausticMaps& maps) {
  maps.throws_up = !world.scene.objects.empty() && !without.has(Part::kUplight);
  maps.height_m = kPlaneHeights_m;
  maps.mirrored_spread_per_m = spread_per_m(world, 1.0, 2.0);
  return maps.throws_up ? maps.patches : 0;
}

}  // namespace

std::size_t trace_caustics(const WorldState& world, const ocean::SeaFrame& sea, PartSet without,
                           CausticMaps& maps, const StageRun& run) {
  maps.patches = 0;
  maps.throws_up = false;
  const double depth_m = lit_depth_m(world);
  if (depth_m <= 0.0 || !shows_caustics(world, without)) return 0;
  double parts = 1.0;
  for (std::size_t k = CausticMaps::kDepths; k-- > 0; parts *= kDepthStep)
    maps.depth_m[k] = static_cast<float>(depth_m / parts);
  const double inv_n = 1.0 / world.scene.water.refraction_index;
  maps.spread_per_m = spread_per_m(world, inv_n, 1.0 - inv_n);
  // The shortest patch first.
  std::array<const ocean::PatchFrame*, CausticMaps::kMostPatches> patches{};
  for (std::size_t p = sea.patches.size(); p-- > 0 && maps.patches < patches.size();) {
    const ocean::PatchFrame& patch = sea.patches[p];
    if (patch.tiling.on || patch.slope_variance <= 0.0f) continue;
    maps.length_m[maps.patches] = patch.length_m;
    patches[maps.patches++] = &patch;
  }
  const auto n = static_cast<float>(world.scene.water.refraction_index);
  const std::size_t reflected = begin_mirrored(world, without, maps);
  run.for_each(maps.patches + reflected, [&](std::size_t i, int) {
    if (i < maps.patches)
      trace_rays(*patches[i], world.sky->to_light, n, maps.rays[i]);
    else
      trace_mirrored_rays(*patches[i - maps.patches], world.sky->to_light,
                          maps.mirrored_rays[i - maps.patches]);
  });
  return maps.patches * CausticMaps::kDepths + reflected;
}

void make_caustic_map(CausticMaps& maps, std::size_t number) {
  CausticScratch& scratch = maps.scratch[number];
  const auto make = [&](const CausticRays& rays, float way_m, float spread,
                        texture::PackedMap1& map) {
    gather_rays(rays, way_m, spread, scratch);
    for (float& intensity : scratch.intensity)
      intensity = intensity * (2.0f / CausticMaps::kRange) - 1.0f;
    texture::pack_map1(rays.size, scratch.intensity, map);
  };
  const std::size_t under_water = maps.patches * CausticMaps::kDepths;
  if (number < under_water)
    return make(maps.rays[number / CausticMaps::kDepths],
                maps.depth_m[number % CausticMaps::kDepths], maps.spread_per_m, maps.map[number]);
  const std::size_t patch = number - under_water;
  make(maps.mirrored_rays[patch], maps.height_m[patch], maps.mirrored_spread_per_m,
       maps.mirrored[patch]);
}

}  // namespace swell::render
