#include "render/materials/water.h"

#include <algorithm>
#include <cmath>

#include "math/check.h"
#include "math/elementary.h"
#include "math/smoothstep.h"
#include "ocean/sea_state.h"

namespace swell::render {
namespace {

constexpr double kUvNoisePeriod_m = 23.0;
constexpr int kMostLongLayers = 2;

// Slope variance of what is too fine for any map: in a breeze, and of glass, which spreads the
// sun's disc to about twice its width.
constexpr float kBaseVariance = 0.0012f, kGlassVariance = 2e-5f;

// Of tilted normals to the eye, at least.
constexpr float kLeastCos = 0.08f;

// The wind that makes ripples; sines have a breeze of their own.
double ripple_wind_mps(const scene::Scene& scene) {
  return scene.sea.has_wind_waves() ? scene.sea.wind_speed_mps : 3.0;
}

// How much of the ripples there is: below 1 m/s the wind raises fewer and fewer, until the sea is
// glass. Cox and Munk's line, which ends at 0.003, was fitted to winds of 0.7 to 14 m/s.
double ripple_share(double wind_mps) { return smoothstep(0.0, 1.0, wind_mps); }

void add_layer(const SlopeLayer& layer, Water& water) {
  SWELL_DCHECK(water.layer_count < kMaxSlopeLayers, "layers={}", water.layer_count);
  water.layers[water.layer_count++] = layer;
}

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
double ripple_variance(const MaterialInputs& in, const Water& water) {
  const double wind = ripple_wind_mps(in.world.scene);
  const double whole = ripple_share(wind) * (0.003 + 0.00512 * wind);
  if (in.sea.frame.patches.empty()) return 0.25 * whole;
  double rest = whole - static_cast<double>(water.base_variance);
  for (const ocean::PatchFrame& patch : in.sea.frame.patches)
    rest -= static_cast<double>(patch.slope_variance);
  return std::max(rest, 0.25 * whole);
}

// Two layers of ripples that drift across each other, downwind.
void add_ripples(const MaterialInputs& in, glm::dvec2 eye, Water& water) {
  const scene::Scene& scene = in.world.scene;
  const texture::PackedMap2& bump = *in.world.bump;
  const float map_variance = std::max(bump.lost_variance.back(), 1e-12f);
  const double variance = ripple_variance(in, water);
  const double travel = scene.sea.wind_from_rad + kPi;
  struct Ripples {
    double length_m, turn_rad, speed_mps, part;
  };
  for (const Ripples& r : {Ripples{5.3, 0.35, 0.55, 0.5}, Ripples{2.1, -0.5, 0.35, 0.5}}) {
    const glm::dvec2 direction(sin(travel + r.turn_rad), cos(travel + r.turn_rad));
    const auto gain =
        static_cast<float>(scene.water.bump_strength * std::sqrt(r.part * variance / map_variance));
    const glm::dvec2 moved_m = drift_m(scene.sea, direction, r.speed_mps, r.length_m, in.t_s);
    SlopeLayer layer = make_layer(bump, r.length_m, gain, eye, moved_m);
    layer.uv_noise_m = static_cast<float>(scene.water.uv_noise_amplitude);
    add_layer(layer, water);
  }
}

SineLayer make_sine(const ocean::SineFrame& sine, glm::dvec2 eye) {
  const glm::dvec2 k = sine.cycles_per_m;
  SineLayer layer;
  layer.kx = static_cast<float>(k.x);
  layer.ky = static_cast<float>(k.y);
  layer.cycles = fraction(k.x * eye.x + k.y * eye.y + sine.cycles);
  layer.slope_x = static_cast<float>(2.0 * kPi * sine.amplitude_m * k.x);
  layer.slope_y = static_cast<float>(2.0 * kPi * sine.amplitude_m * k.y);
  layer.wavelength_log2 = static_cast<float>(-log(glm::length(k)) * 1.4426950408889634);
  return layer;
}

void fill_waves(const MaterialInputs& in, glm::dvec2 eye, Water& water) {
  water.layer_count = water.sine_count = 0;
  for (std::size_t i = 0; i < in.sea.patch_slopes.size(); ++i) {
    const ocean::PatchFrame& patch = in.sea.frame.patches[i];
    add_layer(make_patch_layer(in.sea.patch_slopes[i], patch.length_m, patch.tiling, eye), water);
  }
  water.long_layer_count = std::min(water.layer_count, kMostLongLayers);
  water.first_ripples = water.layer_count;
  water.base_variance =
      std::lerp(kGlassVariance, kBaseVariance,
                static_cast<float>(ripple_share(ripple_wind_mps(in.world.scene))));
  if (!in.without.has(Part::kRipples)) add_ripples(in, eye, water);
  for (const ocean::SineFrame& sine : in.sea.frame.sines)
    water.sines[water.sine_count++] = make_sine(sine, eye);
  water.uv_noise = make_layer(in.sea.uv_noise, kUvNoisePeriod_m, 1.0f, eye, {});
}

void fill_coast(const MaterialInputs& in, glm::dvec2 eye, Water& water) {
  water.has_coast = in.world.coast != nullptr;
  if (!water.has_coast) return;
  const terrain::Grid& grid = in.world.coast->trains.grid;
  const double size_m = grid.size_m();
  const glm::dvec2 from_corner = eye - grid.min_world;
  water.coast_slopes = make_square_layer(in.sea.coast_slopes, size_m, from_corner);
  water.coast_surf = make_square_layer(in.sea.coast_surf, size_m, from_corner);
}

// The displacement of the lookups turns with the picture. Across the line of sight it is half as
// large (LookUpDistorted), hence the factors of a rolled camera.
void fill_slope_axes(const View& camera, Water& water) {
  const bool level = camera.right.z == 0.0f;
  const glm::vec2 right =
      level ? glm::vec2(camera.right) : glm::vec2(camera.forward.y, -camera.forward.x);
  water.view_right = right / std::max(glm::length(right), 1e-6f);
  water.view_ahead = glm::vec2(-water.view_right.y, water.view_right.x);
  if (level) return;
  const glm::vec2 l = water.view_right, a = water.view_ahead;
  const float cos_r = glm::dot(glm::vec2(camera.right), l);
  const float sin_r = glm::dot(glm::vec2(camera.up), l);
  water.view_right = cos_r * l - 2.0f * sin_r * a;
  water.view_ahead = cos_r * a + 0.5f * sin_r * l;
}

// As FresnelReflectance() of the shaders.
float fresnel_reflectance(float c, float n) {
  const float g = std::sqrt(c * c + n * n - 1.0f);
  const float s = (g - c) / (g + c), p = (c * (g + c) - 1.0f) / (c * (g - c) + 1.0f);
  return 0.5f * s * s * (1.0f + p * p);
}

// Slope variance that the layers' maps have, from one layer on.
float layer_variance(const Water& water, int first) {
  float variance = 0.0f;
  for (int i = first; i < water.layer_count; ++i) {
    const SlopeLayer& layer = water.layers[static_cast<std::size_t>(i)];
    variance += layer.map->lost_variance.back() * layer.gain * layer.gain;
  }
  return variance;
}

// Slope variance of all waves, both axes together.
float slope_variance(const MaterialInputs& in, const Water& water) {
  float variance = water.base_variance + layer_variance(water, water.first_ripples);
  for (const ocean::PatchFrame& patch : in.sea.frame.patches) variance += patch.slope_variance;
  for (int i = 0; i < water.sine_count; ++i) {
    const SineLayer& sine = water.sines[static_cast<std::size_t>(i)];
    variance += 0.5f * (sine.slope_x * sine.slope_x + sine.slope_y * sine.slope_y);
  }
  return variance;
}

// The sine of the elevation at which half of the rays that leave waves of this slope variance, both
// axes together, meet another wave: 1 / (1 + Lambda) = 1/2.
// Source: Smith, Geometrical Shadowing of a Random Rough Surface, 1967.
float wave_horizon(float variance) { return 0.195f * std::sqrt(variance); }

// Light that leaves the sea towards a wave that mirrors it: the water body's and the mean sky's.
// The ray goes down by about the slopes' standard deviation, and the facets that it meets are
// turned to it by as much again. No brighter than the horizon, whose place it takes.
glm::vec3 mirrored_sea(const MaterialInputs& in, float reflectance) {
  return glm::min(glm::mix(in.media.body, in.light.ambient, reflectance), in.light.horizon);
}

void fill_optics(const MaterialInputs& in, const View& camera, Water& water) {
  const float variance = slope_variance(in, water);
  const float cosine = std::min(std::sqrt(variance), 1.0f);
  const float reflectance = fresnel_reflectance(cosine, in.media.refraction_index);
  water.mirrored_sea = mirrored_sea(in, reflectance);
  water.mirrored_floor_part = 1.0f - reflectance;
  water.short_variance = layer_variance(water, water.long_layer_count);
  water.seen_slopes = in.without.has(Part::kSeenSlopes) ? 0.0f : 1.0f;
  water.least_cos = in.world.scene.water.tilted_backs ? kLeastCos : 0.0f;
  water.wave_horizon = wave_horizon(variance);
  water.crest_glow = glm::vec3(0.5f, 1.0f, 0.75f) * in.media.body;
  water.inv_crest_height =
      1.0f / std::max(static_cast<float>(in.world.sea->significant_height_m()), 0.1f);
  water.inv_wave_reach = static_cast<float>(1.0 / in.wave_reach_m);
  water.submerged = in.media.submerged;
  water.reflection = in.reflection;
  water.refraction = in.refraction;
  water.distortion_px = static_cast<float>(in.world.scene.water.distortion * camera.height_px);
  water.max_distortion_px = max_distortion_px(camera);
  fill_slope_axes(camera, water);
}

}  // namespace

float max_distortion_px(const View& window) { return 0.1f * static_cast<float>(window.height_px); }

void fill(const MaterialInputs& in, const RenderView& view, Water& water) {
  if (!shows(view.kind, Water::kSurface)) return;
  const glm::dvec2 eye(view.camera.eye_world);
  fill_waves(in, eye, water);
  fill_coast(in, eye, water);
  water.foam = make_foam(in, eye);
  water.hull_foam = make_foam(in, eye, kHullFoamPeriod_m);
  water.whitecaps = make_whitecaps(in, eye);
  fill_optics(in, view.camera, water);
}

}  // namespace swell::render
