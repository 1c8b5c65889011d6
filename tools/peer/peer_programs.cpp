#include "tools/peer/peer_programs.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/workspace.h"
#include "tools/peer/peer_maps.h"
#include "tools/peer/shaders.h"
#include "tools/peer/texture_units.h"

namespace swell::apps {
namespace {

using render::Shading;
using render::SlopeLayer;

bool has_planar_maps(const Shading& window) {
  return window.material<render::Water>().images.reflection.image != nullptr;
}

// --- Texts

// Where a layer lies, for maps that are as long along both axes.
std::string place_text(const SlopeLayer& layer) {
  if (layer.y_texels_fx8_per_m == layer.texels_fx8_per_m) return "p.xy";
  return fmt::format("p.xy * vec2(1.0, {:#.9g})",
                     layer.y_texels_fx8_per_m / layer.texels_fx8_per_m);
}

// The calls that sample the water's layers, in the order of render/water/topside-inl.h: after
// each of the long waves the footprint's level is that on the waves so far.
std::string layers_text(const render::Water& water) {
  std::string text;
  const auto next_level = [&] {
    text +=
        "long_cosine = cosine_of_slopes(to_eye, s.slope);\n"
        "level_m = footprint_level(point.across, clamp(long_cosine, 0.02, 1.0));\n"
        "fine_variance = s.variance + short_variance;\n";
  };
  const std::string blend =
      water.trains.on ? "blend_coast(p.xy, level_flat_m, surf.x, inside, s);\n" : "";
  if (water.long_layer_count == 0) {
    text += blend;
    next_level();
  }
  for (int i = 0; i < water.layer_count; ++i) {
    const bool is_bent = i >= water.first_ripples;
    if (i == water.first_ripples)
      text +=
          "bend = sample_map(noise, noise_place, p.xy, level_m).rg * noise_scale.x + "
          "noise_scale.y;\n";
    const SlopeLayer& layer = water.layers[static_cast<std::size_t>(i)];
    const bool is_tiled = layer.tiling.on;
    text +=
        fmt::format("{1}(layer_{0}, layer_place[{0}], layer_scale[{0}], {2}{3}{4}, level_m, s);\n",
                    i, is_tiled ? "add_tiled_slopes" : "add_slopes",
                    is_tiled ? fmt::format("layer_tiles[{}], ", i) : "", place_text(layer),
                    is_bent ? fmt::format(" + bend * layer_scale[{}].w", i) : "");
    if (i >= water.long_layer_count) continue;
    if (i == water.long_layer_count - 1) text += blend;
    next_level();
  }
  return text;
}

std::string replaced(std::string text, std::string_view mark, std::string_view by) {
  return text.replace(text.find(mark), mark.size(), by);
}

// What all that is shaded by surface_point() needs.
std::string surface_text() {
  return std::string(kLightShader) + kSurfacePointShader + kSlopesShader + kFoamShader;
}

ProgramText water_text(const ShaderFeatures& features) {
  return {features.water_defines, kScreenShader,
          surface_text() + replaced(kWaterShader, "ADD_LAYERS();", features.water_layers)};
}

ViewPrograms view_programs(const Gl& gl, const ShaderFeatures& features, const char* view) {
  const std::string define = fmt::format("#define {}\n", view);
  const std::string light = kLightShader;
  return {GlProgram(gl, {define + "#define OBJECT\n", kVertexShader, light + kObjectShader}),
          GlProgram(gl, {define, kVertexShader, kDistanceShader}),
          GlProgram(gl, {define + features.terrain_defines, kScreenShader,
                         surface_text() + kTerrainShader})};
}

// --- Constants

// What the vertex shader and light.glsl read.
void set_view(const Shading& s, const View& camera, const GlProgram& program) {
  glm::mat4 clip_from_rel = camera.clip_from_rel;
  // OpenGL's rows go up, Swell's down: a picture upside down makes them the same.
  for (int column = 0; column < 4; ++column) clip_from_rel[column].y *= -1.0f;
  program.set("clip_from_rel", clip_from_rel);
  program.set("level_rel_m", -s.rays.eye_z);
  program.set("refraction_index", s.media.refraction_index);
  program.set("eye_z", s.rays.eye_z);
  program.set("pixel_angle_log2", std::log2(s.rays.pixel_angle));
  program.set("sun_direction", s.light.sun_direction);
  program.set("sun_irradiance", s.light.sun_irradiance);
  program.set("to_disc", s.light.to_disc);
  program.set("disc_radiance", s.light.disc_radiance);
  program.set("sky_range", s.light.sky_map->range);
  program.set("sky_azimuth", s.light.sky_azimuth);
  program.set("horizon_sine", s.light.horizon_sine);
  program.set("pixel_angle", s.rays.pixel_angle);
  program.set("ambient", s.light.ambient);
  program.set("horizon", s.light.horizon);
  program.set("inv_haze_m", s.media.inv_haze_m);
  program.set("inv_haze_height_m", s.media.inv_haze_height_m);
  program.set("drop_per_m2", s.rays.drop_per_m2);
  program.set("exposure", s.exposure);
  program.set("body", s.media.body);
  program.set("absorption_per_m", s.media.absorption_per_m);
  // Through window point (0, 0), not through the first pixel's middle.
  program.set("ray", s.rays.ray - 0.5f * (s.rays.ray_dx + s.rays.ray_dy));
  program.set("ray_dx", s.rays.ray_dx);
  program.set("ray_dy", s.rays.ray_dy);
  for (const SamplerName& sampler : kSamplerNames) program.set_sampler(sampler.name, sampler.unit);
  program.set_sampler("distance_map", kWindowDistanceUnit + static_cast<int>(s.kind));
}

void set_layer(const SlopeLayer& layer, const std::string& name, const GlProgram& program) {
  if (!layer.map) return;
  program.set(name + "_place", texture_place(layer));
  program.set(name + "_scale", texture_scale(layer));
}

void set_foam(const Shading& s, const GlProgram& program) {
  const auto& water = s.material<render::Water>();
  set_layer(water.foam_lace, "foam", program);
  const float cos_sun = std::max(s.light.sun_direction.z, 0.0f);
  program.set("foam_light", water.foam_light.sky + cos_sun * water.foam_light.sun);
}

void set_waves(const render::Water& water, const GlProgram& program) {
  std::vector<glm::vec4> place, scale, tiles, wave, slope;
  for (int i = 0; i < water.layer_count; ++i) {
    const SlopeLayer& layer = water.layers[static_cast<std::size_t>(i)];
    place.push_back(texture_place(layer));
    scale.push_back(texture_scale(layer));
    tiles.emplace_back(layer.eye_column, layer.eye_row, layer.tiling.seed >> 16,
                       layer.tiling.seed & 0xffff);
    program.set_sampler(fmt::format("layer_{}", i), kFirstLayerUnit + i);
  }
  for (int i = 0; i < water.sine_count; ++i) {
    const render::SineLayer& sine = water.sines[static_cast<std::size_t>(i)];
    wave.emplace_back(sine.kx, sine.ky, sine.cycles, sine.wavelength_log2 - 1.0f);
    const glm::vec2 slopes(sine.slope_x, sine.slope_y);
    slope.emplace_back(slopes, 0.5f * glm::dot(slopes, slopes), 0.0f);
  }
  program.set("layer_place", place);
  program.set("layer_scale", scale);
  program.set("layer_tiles", tiles);
  program.set("sine_wave", wave);
  program.set("sine_slope", slope);
  set_layer(water.uv_noise, "noise", program);
}

void set_water(const Shading& s, const GlProgram& program) {
  const auto& water = s.material<render::Water>();
  program.set("base_variance", water.base_variance);
  program.set("short_variance", water.short_variance);
  program.set("visible_slopes", water.visible_slopes);
  program.set("least_cos", water.least_cos);
  set_waves(water, program);
  if (water.trains.on) {
    set_layer(water.trains.slopes, "coast_slopes", program);
    set_layer(water.trains.surf, "coast_surf", program);
    set_foam(s, program);
  }
  program.set("mirrored_sea", water.optics.mirrored_sea);
  program.set("mirrored_floor_part", water.optics.mirrored_floor_part);
  program.set("wave_horizon", water.optics.wave_horizon);
  program.set("crest_glow", water.optics.crest_glow);
  program.set("inv_crest_height", water.optics.inv_crest_height);
  program.set("inv_wave_reach", water.optics.inv_wave_reach);
  program.set("inv_window", 1.0f / glm::vec2(s.viewport.width_px, s.viewport.height_px));
  program.set("distortion_px", water.images.distortion.px_per_slope);
  program.set("max_distortion_px", water.images.max_distortion_px);
  program.set("distortion_by_sine", water.images.distortion.by_sine);
  program.set("least_distortion", water.images.distortion.least);
  program.set("view_right", water.images.view_right);
  program.set("view_ahead", water.images.view_ahead);
}

void set_ground(const render::SlopeLayer& slopes, const render::AlbedoLayer& albedo,
                const std::string& name, const GlProgram& program) {
  set_layer(slopes, name + "slopes", program);
  const auto size = static_cast<float>(albedo.texels->width);
  program.set(name + "albedo_place",
              glm::vec3(albedo.texels_per_m, albedo.x_eye, albedo.y_eye) / size);
}

void set_terrain(const Shading& s, const GlProgram& program) {
  const auto& terrain = s.material<render::Terrain>();
  if (!terrain.albedo.map.texels) return;
  set_ground(terrain.slopes, terrain.albedo.map, "", program);
  set_ground(terrain.slopes_around, terrain.albedo.around, "around_", program);
  set_layer(terrain.detail, "detail", program);
  program.set("swash_reach_m", terrain.swash.reach_m);
  program.set("swash_cycles", terrain.swash.cycles);
  program.set("lag_a", terrain.swash.lag_a);
  program.set("lag_b", terrain.swash.lag_b);
  program.set("lag_c", terrain.swash.lag_c);
  set_foam(s, program);
}

void set_view_programs(const Shading& s, const render::RenderView& view,
                       const ViewPrograms& programs) {
  for (const GlProgram* program : {&programs.object, &programs.distance, &programs.terrain}) {
    set_view(s, view.camera, *program);
    program->set("clip_margin_m", view.clip_margin_m);
  }
  set_terrain(s, programs.terrain);
  programs.object.set("sea_light", s.material<render::Object>().sea_light);
}

}  // namespace

ShaderFeatures features_of(const render::FrameState& frame) {
  const Shading& s = frame.shading;
  const auto& water = s.material<render::Water>();
  ShaderFeatures features;
  features.water_defines =
      fmt::format("#define LAYERS {}\n#define SINES {}\n", water.layer_count, water.sine_count);
  for (int i = 0; i < water.layer_count; ++i)
    features.water_defines += fmt::format("uniform sampler2D layer_{};\n", i);
  if (water.trains.on) features.water_defines += "#define COAST\n";
  if (has_planar_maps(s)) features.water_defines += "#define LOOKUPS\n";
  features.water_layers = layers_text(water);
  if (s.material<render::Terrain>().swash.reach_m > 0.0f)
    features.terrain_defines = "#define SWASH\n";
  return features;
}

PeerPrograms::PeerPrograms(const Gl& gl, const ShaderFeatures& features)
    : water(gl, water_text(features)),
      sky(gl, {"", kScreenShader, std::string(kLightShader) + kSkyShader}),
      window(view_programs(gl, features, "WINDOW")),
      reflection(view_programs(gl, features, "REFLECTION")),
      refraction(view_programs(gl, features, "REFRACTION")) {}

void set_constants(const render::FrameState& frame, const PeerPrograms& programs) {
  const Shading& s = frame.shading;
  for (const GlProgram* program : {&programs.water, &programs.sky})
    set_view(s, frame.window.camera, *program);
  set_water(s, programs.water);
  set_view_programs(s, frame.window, programs.window);
  if (!has_planar_maps(s)) return;
  set_view_programs(frame.planar_maps.reflection.shading, frame.planar_maps.reflection.view,
                    programs.reflection);
  set_view_programs(frame.planar_maps.refraction.shading, frame.planar_maps.refraction.view,
                    programs.refraction);
}

}  // namespace swell::apps
