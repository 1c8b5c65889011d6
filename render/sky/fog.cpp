#include "render/sky/fog.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "ocean/open_sea/sea.h"
#include "render/sky/sky_maps.h"
#include "render/world/world_state.h"
#include "sky/fog.h"

namespace swell::render {
namespace {

constexpr double kLeastSine = 1e-3;

// Waves of the density: lengths against each other and directions from the wind's. They share no
// period, and no two of them lie across each other, which would be seen as squares. Together their
// deviation is 1/2.
struct BankShape {
  double length, turn_rad, amount;
};
constexpr std::array<BankShape, Fog::kMostBanks> kBanks = {{{1.0, 0.2, 0.30},
                                                            {0.71, 2.6, 0.27},
                                                            {1.45, 1.86, 0.31},
                                                            {0.53, 1.12, 0.22},
                                                            {2.3, 0.66, 0.33},
                                                            {0.37, 3.0, 0.17},
                                                            {0.83, 2.27, 0.24}}};

FogStart start_at(const scene::FoggyAir& air, glm::dvec3 per_m, double sun_sine, double height_m) {
  FogStart start;
  start.height_m = static_cast<float>(height_m);
  const double above_m = sky::fog_above_m(air, height_m);
  start.above_m = static_cast<float>(above_m);
  for (int c = 0; c < 3; ++c)
    start.sun_passes[c] = static_cast<float>(exp(-std::min(per_m[c] * above_m / sun_sine, 80.0)));
  return start;
}

// Fog drifts with the wind; in a sea that loops, by whole waves a loop.
double drifted_turns(const ocean::SeaDescription& sea, glm::dvec2 turns_per_m, double t_s) {
  const glm::dvec2 downwind(-sin(sea.wind_from_rad), -cos(sea.wind_from_rad));
  const double per_s = sea.wind_speed_mps * glm::dot(turns_per_m, downwind);
  if (sea.loop_s <= 0.0) return per_s * t_s;
  const double turns_a_loop = std::round(per_s * sea.loop_s);
  return turns_a_loop * (t_s / sea.loop_s);
}

void fill_banks(const WorldState& world, double t_s, glm::dvec2 eye, Fog& fog) {
  const scene::FoggyAir& air = world.scene.air;
  const ocean::SeaDescription& sea = world.scene.sea;
  if (air.banks <= 0.0) return;
  fog.bank_count = static_cast<int>(Fog::kMostBanks);
  for (std::size_t i = 0; i < Fog::kMostBanks; ++i) {
    const BankShape& shape = kBanks[i];
    const double angle = sea.wind_from_rad + shape.turn_rad;
    const glm::dvec2 per_m =
        glm::dvec2(sin(angle), cos(angle)) / (shape.length * air.bank_length_m);
    const double turns =
        glm::dot(per_m, eye) - drifted_turns(sea, per_m, t_s) + 0.37 * static_cast<double>(i + 1);
    const float rest = static_cast<float>(turns - std::floor(turns));
    fog.banks[i] = {glm::vec2(per_m), rest, static_cast<float>(sin_cos_turns(rest).cos),
                    static_cast<float>(air.banks * shape.amount)};
  }
}

}  // namespace

Fog make_fog(const WorldState& world, double t_s, glm::dvec3 eye_world, PartSet without) {
  Fog fog;
  const scene::FoggyAir& air = world.scene.air;
  const glm::dvec3 per_m = sky::fog_per_m(air);
  fog.on = per_m != glm::dvec3(0.0) && !without.has(Part::kFog);
  if (!fog.on) return fog;
  fog.is_grey = per_m.x == per_m.y && per_m.y == per_m.z;
  fog.is_exponential = air.profile == scene::FogProfile::kExponential;
  fog.is_paper = air.scattering == scene::FogScattering::kPaper;
  fog.per_m = per_m;
  fog.top_m = static_cast<float>(sky::fog_layer_top_m(air));
  fog.drop_per_m2 = drop_per_m2(world.earth_radius_m(without));

  const double thinnest = std::min({per_m.x, per_m.y, per_m.z});
  fog.takes_haze = static_cast<float>(std::min(thinnest * world.scene.sky.haze_distance_m, 1.0));

  const SkyMaps& sky = *world.sky;
  const double sun_sine = std::max(static_cast<double>(sky.to_light.z), kLeastSine);
  fog.to_sun = sky.to_light;
  fog.sun_sine = static_cast<float>(sun_sine);
  fog.forward = static_cast<float>(air.forward);
  const double l = air.forward;
  if (sky.to_light.z > 0.0f)
    fog.scattered = sky.irradiance * static_cast<float>((1.0 - l * l) / (4.0 * kPi));
  fog.even = world.fog_light->even;
  fog.ambient = world.fog_light->ambient;
  fog.even_sun = world.fog_light->even_sun;
  fog.ambient_sun = world.fog_light->ambient_sun;
  fog.at_eye = start_at(air, per_m, sun_sine, eye_world.z);
  fog.at_sea = start_at(air, per_m, sun_sine, 0.0);
  fill_banks(world, t_s, glm::dvec2(eye_world), fog);
  return fog;
}

FogLights light_fog(const scene::FoggyAir& air, const SkyMaps& sky) {
  // What the sea sends back of the light that falls on it.
  constexpr double kSeaReflects = 0.07;
  FogLights lights;
  const glm::dvec3 per_m = sky::fog_per_m(air);
  const double sine = sky.to_light.z > 0.0f ? std::max<double>(sky.to_light.z, kLeastSine) : 0.0;
  for (int c = 0; c < 3; ++c) {
    const double depth = per_m[c] * sky::fog_above_m(air, 0.0);
    const double sun = sky.irradiance[c];
    const auto light_of = [&](double from_sky) {
      return sky::light_in_fog(depth, air.forward, sine, sun, from_sky,
                               kSeaReflects * (from_sky + sun * sine / kPi));
    };
    const sky::FogLight light = light_of(sky.ambient[c]), of_sun = light_of(0.0);
    lights.even[c] = static_cast<float>(light.even);
    lights.ambient[c] = static_cast<float>(light.ambient);
    lights.even_sun[c] = static_cast<float>(of_sun.even);
    lights.ambient_sun[c] = static_cast<float>(of_sun.ambient);
  }
  return lights;
}

}  // namespace swell::render
