#include "render/world/caustic_maps.h"

#include <algorithm>
#include <cmath>

namespace swell::render {
namespace {

// Deeper than this the light is taken to lose its pattern as it does in clear water below the
// focus of all but the longest waves.
constexpr double kDeepest_m = 9.0;
constexpr double kDepthStep = 3.0;      // of each map's depth over the one before
constexpr double kObjectDepth_m = 3.0;  // floating things reach down to about this
constexpr float kLowestLight = 0.02f;   // z of the direction to a light that tells under water

// How far down there is something to be lit, 0: nothing.
double lit_depth_m(const World::State& world) {
  double depth_m = world.scene.objects.empty() ? 0.0 : kObjectDepth_m;
  if (world.terrain) {
    depth_m = std::max(depth_m, -static_cast<double>(world.terrain->lowest_m));
    if (world.terrain->apron.width_m > 0.0)
      depth_m = std::max(depth_m, -world.terrain->apron.floor_m);
  }
  return std::min(depth_m, kDeepest_m);
}

bool shows_caustics(const World::State& world, PartSet without) {
  return !without.has(Part::kCaustics) && world.scene.water.caustics > 0.0 &&
         world.sky->to_light.z > kLowestLight && world.sky->irradiance != glm::vec3(0.0f);
}

// The disc of sun or moon, and the ripples: waves too short for patches focus close under the
// surface, and only scatter below. They are taken to have a fifth of the mean square slope that the
// wind raises. Source: Cox and Munk, Measurement of the Roughness of the Sea Surface, 1954.
float spread_per_m(const World::State& world) {
  const double n = world.scene.water.refraction_index;
  const double disc = 0.5 * kSunRadius_rad / n;
  const double wind_mps = world.scene.sea.has_wind_waves() ? world.scene.sea.wind_speed_mps : 0.0;
  const double slope2 = 0.2 * 0.5 * (0.003 + 0.00512 * wind_mps);  // along one axis
  const double bent = 1.0 - 1.0 / n;
  return static_cast<float>(std::sqrt(disc * disc + bent * bent * slope2));
}

}  // namespace

std::size_t trace_caustics(const World::State& world, const ocean::SeaFrame& sea, PartSet without,
                           CausticMaps& maps, const StageRun& run) {
  maps.patches = 0;
  const double depth_m = lit_depth_m(world);
  if (depth_m <= 0.0 || !shows_caustics(world, without)) return 0;
  double parts = 1.0;
  for (std::size_t k = CausticMaps::kDepths; k-- > 0; parts *= kDepthStep)
    maps.depth_m[k] = static_cast<float>(depth_m / parts);
  maps.spread_per_m = spread_per_m(world);
  // The shortest patch first.
  std::array<const ocean::PatchFrame*, CausticMaps::kMostPatches> patches{};
  for (std::size_t p = sea.patches.size(); p-- > 0 && maps.patches < patches.size();) {
    const ocean::PatchFrame& patch = sea.patches[p];
    if (patch.tiling.on || patch.slope_variance <= 0.0f) continue;
    maps.length_m[maps.patches] = patch.length_m;
    patches[maps.patches++] = &patch;
  }
  const auto n = static_cast<float>(world.scene.water.refraction_index);
  run.for_each(maps.patches, [&](std::size_t p, int) {
    trace_rays(*patches[p], world.sky->to_light, n, maps.rays[p]);
  });
  return maps.patches * CausticMaps::kDepths;
}

void make_caustic_map(CausticMaps& maps, std::size_t number) {
  const CausticRays& rays = maps.rays[number / CausticMaps::kDepths];
  CausticScratch& scratch = maps.scratch[number];
  gather_rays(rays, maps.depth_m[number % CausticMaps::kDepths], maps.spread_per_m, scratch);
  for (float& intensity : scratch.intensity)
    intensity = intensity * (2.0f / CausticMaps::kRange) - 1.0f;
  texture::pack_map1(rays.size, scratch.intensity, maps.map[number]);
}

}  // namespace swell::render
