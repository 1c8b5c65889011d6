// The constants of shading, from the scene, the view and the frame's maps.
#include <algorithm>
#include <bit>
#include <cmath>

#include "math/check.h"
#include "math/elementary.h"
#include "render/frame_state.h"

namespace swell::render {
namespace {

constexpr double kUvNoisePeriod_m = 23.0;
constexpr double kTerrainDetailPeriod_m = 7.0;
constexpr double kFoamPeriod_m = 9.0;
constexpr int kMostLongLayers = 2;
constexpr float kFoamAlbedo = 0.8f;
constexpr float kSwashPart = 0.1f;  // how high sheets of water run, of the highest waves

float fraction(double x) { return static_cast<float>(x - std::floor(x)); }

// Lays `map` over the plane with period length_m; `moved_m` is how far it has drifted.
SlopeLayer make_layer(const texture::PackedMap2& map, double length_m, float gain, glm::dvec2 eye,
                      glm::dvec2 moved_m) {
  SlopeLayer layer;
  layer.map = &map;
  layer.inv_length = static_cast<float>(1.0 / length_m);
  layer.u_eye = fraction((eye.x - moved_m.x) / length_m);
  layer.v_eye = fraction((eye.y - moved_m.y) / length_m);
  layer.log2_texels_per_m = static_cast<float>(log(map.size / length_m) * 1.4426950408889634);
  layer.gain = gain;
  // The two coarsest levels (1 and 4 texels) hold nothing worth a sample.
  layer.levels = std::clamp(map.levels - 2, 1, kTableLevels - 1);
  for (int i = 0; i < 2 * kTableLevels; ++i) {
    const int level = i % kTableLevels;
    const float lost = level < layer.levels ? map.lost_variance[level] : map.lost_variance.back();
    layer.lost_variance[i] = lost * gain * gain;
  }
  return layer;
}

void add_water_layer(const SlopeLayer& layer, ShadeContext& c) {
  SWELL_DCHECK(c.water_layer_count < kMaxSlopeLayers, "layers={}", c.water_layer_count);
  c.water_layers[c.water_layer_count++] = layer;
}

// Two layers of ripples that drift across each other, downwind.
void add_bump_layers(const Frame& frame, ShadeContext& c) {
  const scene::Scene& scene = frame.world.scene;
  const texture::PackedMap2& bump = *frame.world.bump;
  const float map_variance = std::max(bump.lost_variance.back(), 1e-12f);
  // Ripple slopes grow with the wind as the sea's whole slope variance does.
  // Source: Cox and Munk, Measurement of the Roughness of the Sea Surface, 1954.
  const double wind = scene.sea.spectrum ? scene.sea.wind_speed_mps : 3.0;
  const double variance = 0.25 * (0.003 + 0.00512 * wind);
  const double travel = scene.sea.wind_from_rad + kPi;
  struct Layer {
    double length_m, turn_rad, speed_mps, share;
  };
  for (const Layer& l : {Layer{5.3, 0.35, 0.55, 0.5}, Layer{2.1, -0.5, 0.35, 0.5}}) {
    const glm::dvec2 direction(sin(travel + l.turn_rad), cos(travel + l.turn_rad));
    const auto gain = static_cast<float>(scene.water.bump_strength *
                                         std::sqrt(l.share * variance / map_variance));
    SlopeLayer layer = make_layer(bump, l.length_m, gain, glm::dvec2(frame.view.eye_world),
                                  direction * (l.speed_mps * frame.t_s));
    layer.uv_noise_m = static_cast<float>(scene.water.uv_noise_amplitude);
    add_water_layer(layer, c);
  }
}

void add_sines(const Frame& frame, ShadeContext& c) {
  const glm::dvec2 eye(frame.view.eye_world);
  for (const ocean::SineFrame& sine : frame.ws.sea.sines) {
    SineLayer& layer = c.sines[c.sine_count++];
    const glm::dvec2 k = sine.cycles_per_m;
    layer.kx = static_cast<float>(k.x);
    layer.ky = static_cast<float>(k.y);
    layer.cycles = fraction(k.x * eye.x + k.y * eye.y + sine.cycles);
    layer.slope_x = static_cast<float>(2.0 * kPi * sine.amplitude_m * k.x);
    layer.slope_y = static_cast<float>(2.0 * kPi * sine.amplitude_m * k.y);
    layer.wavelength_log2 = static_cast<float>(-log(glm::length(k)) * 1.4426950408889634);
  }
}

// The displacement of the lookups turns with the picture. Across the line of sight it is half as
// large (LookUpDistorted), hence the factors of a rolled camera.
void fill_slope_axes(const View& view, ShadeContext& c) {
  const bool level = view.right.z == 0.0f;
  const glm::vec2 right =
      level ? glm::vec2(view.right) : glm::vec2(view.forward.y, -view.forward.x);
  c.view_right = right / std::max(glm::length(right), 1e-6f);
  c.view_ahead = glm::vec2(-c.view_right.y, c.view_right.x);
  if (level) return;
  const glm::vec2 l = c.view_right, a = c.view_ahead;
  const float cos_r = glm::dot(glm::vec2(view.right), l), sin_r = glm::dot(glm::vec2(view.up), l);
  c.view_right = cos_r * l - 2.0f * sin_r * a;
  c.view_ahead = cos_r * a + 0.5f * sin_r * l;
}

void fill_rays(const View& view, ShadeContext& c) {
  c.ray = view.ray(0.5f, 0.5f);
  c.ray_dx = view.right * (2.0f * view.tan_half_x / static_cast<float>(view.width_px));
  c.ray_dy = -view.up * (2.0f * view.tan_half_y / static_cast<float>(view.height_px));
  c.near_m = view.near_m;
  c.eye_z = static_cast<float>(view.eye_world.z);
  c.pixel_angle = 2.0f * view.tan_half_y / static_cast<float>(view.height_px);
  fill_slope_axes(view, c);
}

void fill_light(const Frame& frame, ShadeContext& c) {
  const scene::Sky& sky = frame.world.scene.sky;
  c.sun_direction = sky.sun_direction;
  c.sun_irradiance = sky.sun_direction.z > 0.0f ? sky.sun_radiance : glm::vec3(0.0f);
  c.ambient = frame.world.sky->ambient;
  c.sky_sharp = &frame.world.sky->sharp;
  c.sky_soft = &frame.world.sky->soft;
  c.inv_haze_m = static_cast<float>(1.0 / sky.haze_distance_m);
  c.exposure = static_cast<float>(sky.exposure);
}

void fill_water(const Frame& frame, ShadeContext& c) {
  const scene::WaterOptics& water = frame.world.scene.water;
  c.refraction_index = static_cast<float>(water.refraction_index);
  c.absorption_per_m = water.absorption_per_m;
  // Light that enters the water: the sky's and the sun's, as radiance of a white surface.
  const glm::vec3 light =
      c.ambient + c.sun_irradiance * (std::max(c.sun_direction.z, 0.0f) / static_cast<float>(kPi));
  c.body = water.body_colour * light;
  // Besides its own light the sea mirrors some of the sky.
  c.sea_light = c.body + 0.15f * c.ambient;
  c.crest_glow = glm::vec3(0.5f, 1.0f, 0.75f) * c.body;
  c.inv_crest_height =
      1.0f / std::max(static_cast<float>(frame.world.sea->significant_height_m()), 0.1f);
  c.distortion_px = static_cast<float>(water.distortion * frame.view.height_px);
  c.max_distortion_px = 0.1f * static_cast<float>(frame.view.height_px);
}

void fill_water_layers(const Frame& frame, ShadeContext& c) {
  c.water_layer_count = 0;
  c.sine_count = 0;
  const glm::dvec2 eye(frame.view.eye_world);
  for (std::size_t i = 0; i < frame.ws.patch_maps.size(); ++i)
    add_water_layer(
        make_layer(frame.ws.patch_maps[i], frame.ws.sea.patches[i].length_m, 1.0f, eye, {}), c);
  c.long_layer_count = std::min(c.water_layer_count, kMostLongLayers);
  add_bump_layers(frame, c);
  add_sines(frame, c);
  c.uv_noise = make_layer(frame.ws.uv_noise_map, kUvNoisePeriod_m, 1.0f, eye, {});
  c.base_variance = 0.0012f;
}

// A layer over one square that does not repeat: the eye's place in it is not wrapped.
SlopeLayer make_square_layer(const texture::PackedMap2& map, double size_m,
                             glm::dvec2 from_corner) {
  SlopeLayer layer = make_layer(map, size_m, 1.0f, from_corner, {});
  layer.u_eye = static_cast<float>(from_corner.x / size_m);
  layer.v_eye = static_cast<float>(from_corner.y / size_m);
  return layer;
}

void fill_coast(const Frame& frame, ShadeContext& c) {
  c.has_coast = frame.world.coast != nullptr;
  if (!c.has_coast) return;
  const ocean::FloorGrid& grid = frame.world.coast->trains.grid;
  const double size_m = grid.spacing_m * (grid.samples_x - 1);
  const glm::dvec2 from_corner = glm::dvec2(frame.view.eye_world) - grid.min_world;
  c.coast_slopes = make_square_layer(frame.ws.coast_slopes, size_m, from_corner);
  c.coast_surf = make_square_layer(frame.ws.coast_surf, size_m, from_corner);
}

// Foam lies still; the sheets of water on the beach come and go with the slowest of the trains.
void fill_foam(const Frame& frame, ShadeContext& c) {
  c.swash_m = 0.0f;
  if (!frame.world.coast) return;
  const glm::dvec2 eye(frame.view.eye_world);
  c.foam_pattern = make_layer(*frame.world.coast_maps->foam_pattern, kFoamPeriod_m, 1.0f, eye, {});
  const float sun = std::max(c.sun_direction.z, 0.0f) / static_cast<float>(kPi);
  c.foam_light = kFoamAlbedo * (c.ambient + c.sun_irradiance * sun);

  const ocean::TrainSea& trains = frame.world.coast->trains;
  const double period_s = *std::ranges::max_element(trains.period_s);
  c.swash_m = kSwashPart * trains.height_bound_m;
  c.swash_cycles = fraction(frame.t_s / period_s);
  const auto along = [&](double x_m, double y_m) {
    return glm::vec3(1.0 / x_m, 1.0 / y_m, fraction(eye.x / x_m + eye.y / y_m));
  };
  c.swash_a = along(310.0, 230.0);
  c.swash_b = along(-97.0, 71.0);
}

void fill_terrain(const Frame& frame, ShadeContext& c) {
  if (!frame.world.terrain) return;
  const scene::Terrain& terrain = *frame.world.terrain;
  const TerrainMaps& maps = *frame.world.terrain_maps;
  const glm::dvec2 from_corner = glm::dvec2(frame.view.eye_world) - terrain.min_world;
  c.terrain_slopes = make_square_layer(maps.slopes, terrain.size_m(), from_corner);
  const float detail_gain =
      0.11f / std::sqrt(std::max(frame.world.bump->lost_variance.back(), 1e-12f));
  c.terrain_detail = make_layer(*frame.world.bump, kTerrainDetailPeriod_m, detail_gain,
                                glm::dvec2(frame.view.eye_world), {});
  c.terrain_albedo = &maps.albedo;
  const double texels_per_m = maps.albedo.width / terrain.size_m();
  c.albedo_texels_per_m = static_cast<float>(texels_per_m);
  // Texel centres lie at +0.5, the terrain's samples on the lattice.
  c.albedo_x_eye = static_cast<float>(from_corner.x * texels_per_m + 0.5);
  c.albedo_y_eye = static_cast<float>(from_corner.y * texels_per_m + 0.5);
}

}  // namespace

void fill_shade_context(const Frame& frame, const View& view, ViewKind kind,
                        ShadeContext& context) {
  context.kind = kind;
  context.viewport = {view.width_px, view.height_px};
  context.grid = raster::tile_grid(context.viewport, frame.options.tile_size_px);
  fill_rays(view, context);
  fill_light(frame, context);
  fill_water(frame, context);
  fill_terrain(frame, context);
  context.object_primitives = frame.ws.objects.primitives;
  context.water_primitives = 0;
  context.first_object = land_triangles(frame);
  if (kind != ViewKind::kWindow) return;
  context.water_primitives = water_triangles(frame);
  context.first_object += context.water_primitives;
  fill_water_layers(frame, context);
  fill_coast(frame, context);
  fill_foam(frame, context);
}

}  // namespace swell::render
