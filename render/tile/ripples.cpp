#include "render/tile/ripples.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "math/smoothstep.h"
#include "ocean/open_sea/sea_state.h"
#include "render/frame/parts.h"
#include "render/sea/sea_maps.h"
#include "render/tile/inputs.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

constexpr double kBumpSlope = double{texture::kBumpSlope};

// Slope variance of what is too fine for any map, in a breeze.
constexpr float kBaseVariance = 0.0012f;

// The wind that makes ripples; sines have a breeze of their own.
double ripple_wind_mps(const scene::Scene& scene) {
  return scene.sea.has_wind_waves() ? scene.sea.wind_speed_mps : 3.0;
}

// How much of the ripples there is: below 1 m/s the wind raises fewer and fewer, until the sea is
// glass. Cox and Munk's line, which ends at 0.003, was fitted to winds of 0.7 to 14 m/s.
double ripple_share(double wind_mps) { return smoothstep(0.0, 1.0, wind_mps); }

// How far a map of period length_m has drifted at t_s. In a sea that loops it drifts by whole
// periods a loop along both axes: the nearest ones, but not by none.
glm::dvec2 drift_m(const ocean::SeaDescription& sea, glm::dvec2 direction, double speed_mps,
                   double length_m, double t_s) {
  if (sea.loop_s == 0.0) return direction * (speed_mps * t_s);
  const glm::dvec2 periods = direction * (speed_mps * sea.loop_s / length_m);
  glm::dvec2 whole(std::nearbyint(periods.x), std::nearbyint(periods.y));
  if (whole == glm::dvec2(0.0) && speed_mps != 0.0) {
    const int axis = std::abs(periods.x) > std::abs(periods.y) ? 0 : 1;
    whole[axis] = std::copysign(1.0, periods[axis]);
  }
  return whole * (length_m * (ocean::wave_time_s(sea, t_s) / sea.loop_s));
}

// Slope variance of the ripples, both axes together: they are what the patches' waves leave of the
// sea's whole variance; where those are higher than the wind makes them, a quarter of it.
// Source: Cox and Munk, Measurement of the Roughness of the Sea Surface, 1954.
double ripple_variance(const MaterialInputs& in) {
  const double wind = ripple_wind_mps(in.world.scene);
  const double whole = ripple_share(wind) * (0.003 + 0.00512 * wind);
  if (in.sea.frame.patches.empty()) return 0.25 * whole;
  double rest = whole - static_cast<double>(base_variance(in.world.scene));
  for (const ocean::PatchFrame& patch : in.sea.frame.patches)
    rest -= static_cast<double>(patch.slope_variance);
  return std::max(rest, 0.25 * whole);
}

// Two layers of ripples that drift across each other, downwind.
void add_layers(const MaterialInputs& in, glm::dvec2 eye, Ripples& ripples) {
  const scene::Scene& scene = in.world.scene;
  const texture::PackedMap2& bump = *in.world.textures.bump;
  const float map_variance = std::max(bump.lost_variance.back(), 1e-12f);
  const double variance = ripple_variance(in);
  const double travel = scene.sea.wind_from_rad + kPi;
  struct Layer {
    double length_m, turn_rad, speed_mps, part;
  };
  for (const Layer& l : {Layer{5.3, 0.35, 0.55, 0.5}, Layer{2.1, -0.5, 0.35, 0.5}}) {
    const glm::dvec2 direction(sin(travel + l.turn_rad), cos(travel + l.turn_rad));
    const auto gain =
        static_cast<float>(scene.water.bump_strength * std::sqrt(l.part * variance / map_variance));
    const glm::dvec2 moved_m = drift_m(scene.sea, direction, l.speed_mps, l.length_m, in.t_s);
    SlopeLayer& layer = ripples.layers[ripples.count++];
    layer = make_layer(bump, l.length_m, gain, eye, moved_m);
    layer.uv_noise_m = static_cast<float>(scene.water.uv_noise_amplitude);
  }
}

// The frame of a sequence, which moves by itself, laid over the sea at two scales: one alone shows
// its period from a mast's height.
void add_sequence(const MaterialInputs& in, glm::dvec2 eye, Ripples& ripples) {
  const scene::Scene& scene = in.world.scene;
  const RippleMaps& maps = in.sea.ripples;
  const double length_m = scene.ripples.length_m;
  const auto gain = static_cast<float>(scene.water.bump_strength *
                                       std::sqrt(0.5 * ripple_variance(in)) / kBumpSlope);
  for (const double scale : {1.0, 0.397})
    ripples.layers[ripples.count++] = make_layer(maps.slopes, scale * length_m, gain, eye, {});
  if (scene.ripples.lighting == scene::RippleLighting::kPaper)
    ripples.detail = make_tint(maps.detail, length_m, eye);
}

}  // namespace

float base_variance(const scene::Scene& scene) {
  return std::lerp(kGlassVariance, kBaseVariance,
                   static_cast<float>(ripple_share(ripple_wind_mps(scene))));
}

Ripples make_ripples(const MaterialInputs& in, glm::dvec2 eye) {
  Ripples ripples;
  if (in.without.has(Part::kRipples)) return ripples;
  if (in.world.textures.ripple_sequence && !in.without.has(Part::kSequence))
    add_sequence(in, eye, ripples);
  else
    add_layers(in, eye, ripples);
  return ripples;
}

}  // namespace swell::render
