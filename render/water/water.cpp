#include "render/water/water.h"

#include <algorithm>
#include <cmath>

#include "math/check.h"
#include "math/elementary.h"
#include "ocean/coast/coast.h"
#include "ocean/open_sea/sea.h"
#include "ocean/open_sea/whitecaps.h"
#include "ocean/water_surface.h"
#include "render/frame/parts.h"
#include "render/packets/view_rays.h"
#include "render/sea/sea_maps.h"
#include "render/sky/light.h"
#include "render/tile/ripples.h"
#include "render/view/render_view.h"
#include "render/world/water_texture.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

constexpr double kUvNoisePeriod_m = 23.0;
constexpr int kMostLongLayers = 2;

// The least cosine of tilted normals to the eye.
constexpr float kLeastCos = 0.08f;

void add_layer(const SlopeLayer& layer, Water& water) {
  SWELL_DCHECK(water.layer_count < kMaxSlopeLayers, "layers={}", water.layer_count);
  water.layers[water.layer_count++] = layer;
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
  water.base_variance = base_variance(in.world.scene);
  const Ripples ripples = make_ripples(in, eye);
  for (int i = 0; i < ripples.count; ++i) add_layer(ripples.layers[i], water);
  water.bump_detail = ripples.detail;
  water.texture = {};
  if (const auto& texture = in.world.textures.water)
    water.texture = make_tint(texture->maps, in.world.scene.water.texture_length_m, eye);
  for (const ocean::SineFrame& sine : in.sea.frame.sines)
    water.sines[water.sine_count++] = make_sine(sine, eye);
  water.uv_noise = make_layer(in.sea.uv_noise, kUvNoisePeriod_m, 1.0f, eye, {});
}

void fill_coast(const MaterialInputs& in, glm::dvec2 eye, Water& water) {
  water.trains.on = in.world.coast != nullptr;
  if (!water.trains.on) return;
  const terrain::Grid& grid = in.world.coast->trains.grid;
  const double size_m = grid.size_m();
  const glm::dvec2 from_corner = eye - grid.min_world;
  water.trains.slopes = make_square_layer(in.sea.coast_slopes, size_m, from_corner);
  water.trains.surf = make_square_layer(in.sea.coast_surf, size_m, from_corner);
  water.trains.whitecaps = {};
  if (in.world.whitecaps->trains && !in.without.has(Part::kWhitecaps))
    water.trains.whitecaps = make_square_layer(in.sea.coast_whitecaps, size_m, from_corner);
}

// The displacement of the lookups turns with the picture. Across the line of sight it may be less
// (LookUpDistorted), hence the factors of a rolled camera.
void fill_slope_axes(const View& camera, Water& water) {
  const bool level = camera.right.z == 0.0f;
  const glm::vec2 right =
      level ? glm::vec2(camera.right) : glm::vec2(camera.forward.y, -camera.forward.x);
  water.images.view_right = right / std::max(glm::length(right), 1e-6f);
  water.images.view_ahead = glm::vec2(-water.images.view_right.y, water.images.view_right.x);
  if (level) return;
  const glm::vec2 l = water.images.view_right, a = water.images.view_ahead;
  const float cos_r = glm::dot(glm::vec2(camera.right), l);
  const float sin_r = glm::dot(glm::vec2(camera.up), l);
  const float across = water.images.distortion.across;
  water.images.view_right = cos_r * l - 1.0f / across * sin_r * a;
  water.images.view_ahead = cos_r * a + across * sin_r * l;
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

// How high crests are that light shines through.
float crest_height_m(const WorldState& world) {
  const auto sea_m = static_cast<float>(world.sea->significant_height_m());
  return std::max({sea_m, world.water().wakes.height_m, 0.1f});
}

void fill_optics(const MaterialInputs& in, const View& camera, Water& water) {
  const float variance = slope_variance(in, water);
  const float cosine = std::min(std::sqrt(variance), 1.0f);
  const float reflectance = fresnel_reflectance(cosine, in.media.refraction_index);
  water.optics.mirrored_sea = mirrored_sea(in, reflectance);
  water.optics.mirrored_floor_part = 1.0f - reflectance;
  water.short_variance = layer_variance(water, water.long_layer_count);
  water.visible_slopes = in.without.has(Part::kVisibleSlopes) ? 0.0f : 1.0f;
  water.least_cos = in.world.scene.water.tilted_backs ? kLeastCos : 0.0f;
  water.optics.wave_horizon = wave_horizon(variance);
  water.optics.glitter_light =
      in.without.has(Part::kGlitter) ? glm::vec3(0.0f) : in.light.sun_irradiance;
  water.optics.crest_glow = glm::vec3(0.5f, 1.0f, 0.75f) * in.media.body;
  water.optics.inv_crest_height = 1.0f / crest_height_m(in.world);
  water.optics.inv_wave_reach = static_cast<float>(1.0 / in.wave_reach_m);
  water.submerged = in.media.submerged;
  water.optics.reflection_weight =
      static_cast<float>(in.world.scene.water.reflection_weight.value_or(-1.0));
  water.optics.refraction_weight = static_cast<float>(in.world.scene.water.refraction_weight);
  water.images.reflection = in.reflection;
  water.images.refraction = in.refraction;
  water.images.distortion = make_distortion(in.world.scene, camera);
  water.images.max_distortion_px = max_distortion_px(camera);
  if (camera.whole_height_px > 0.0f)
    water.images.max_turn = water.images.max_distortion_px * make_rays(camera).pixel_angle;
  fill_slope_axes(camera, water);
}

}  // namespace

float max_distortion_px(const View& window) { return 0.1f * window.picture_height_px(); }

void fill(const MaterialInputs& in, const RenderView& view, Water& water) {
  if (!shows(view.kind, Water::kSurface)) return;
  water.foam_light = make_foam_light(in);  // rivers' too
  if (in.without.has(Part::kWater)) return;
  const glm::dvec2 eye(view.camera.eye_world);
  fill_waves(in, eye, water);
  fill_coast(in, eye, water);
  water.near_shore = make_near_shore(in, eye);
  water.foam_lace = make_foam_lace(in, eye);
  water.hull_foam_lace = make_foam_lace(in, eye, kHullFoamPeriod_m);
  water.whitecaps = make_whitecaps(in, eye);
  water.wakes = make_wakes(in, water.whitecaps, eye);
  water.glitter = make_glitter(in);
  fill_optics(in, view.camera, water);
}

}  // namespace swell::render
