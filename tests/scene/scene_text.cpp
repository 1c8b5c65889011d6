#include "scene/scene_text.h"

namespace swell::scene {
namespace {

template <class T>
void compare(const char* name, const T& a, const T& b, std::string& list) {
  if (!(a == b)) list += std::string(name) + "\n";
}

#define SWELL_COMPARE(FIELD) compare(#FIELD, a.FIELD, b.FIELD, list)

void compare_swells(const ocean::Swell& a, const ocean::Swell& b, std::string& list) {
  SWELL_COMPARE(hs_m);
  SWELL_COMPARE(tp_s);
  SWELL_COMPARE(from_rad);
  SWELL_COMPARE(gamma);
  SWELL_COMPARE(spread_rad);
}

void compare_sines(const ocean::SineWave& a, const ocean::SineWave& b, std::string& list) {
  SWELL_COMPARE(amplitude_m);
  SWELL_COMPARE(wavelength_m);
  SWELL_COMPARE(to_rad);
  SWELL_COMPARE(phase_rad);
  SWELL_COMPARE(period_s);
}

void compare_maps(const ocean::MapLayer& a, const ocean::MapLayer& b, std::string& list) {
  SWELL_COMPARE(file);
  SWELL_COMPARE(length_m);
  SWELL_COMPARE(period_s);
  SWELL_COMPARE(hs_m);
  SWELL_COMPARE(offset_m);
  SWELL_COMPARE(offset_s);
}

void compare_objects(const FloatingObject& a, const FloatingObject& b, std::string& list) {
  SWELL_COMPARE(kind);
  SWELL_COMPARE(top_mark);
  SWELL_COMPARE(position_m);
  SWELL_COMPARE(size_m);
  SWELL_COMPARE(heading_rad);
  SWELL_COMPARE(draught);
  SWELL_COMPARE(colour);
  SWELL_COMPARE(name);
  SWELL_COMPARE(label);
  SWELL_COMPARE(motion);
  SWELL_COMPARE(height_m);
  SWELL_COMPARE(roll_rad);
  SWELL_COMPARE(path_m);
  SWELL_COMPARE(speed_mps);
  SWELL_COMPARE(path_closed);
  SWELL_COMPARE(wake);
  SWELL_COMPARE(drift);
  SWELL_COMPARE(roughness);
  SWELL_COMPARE(metalness);
  SWELL_COMPARE(checker_m);
  SWELL_COMPARE(file);
  SWELL_COMPARE(up);
  SWELL_COMPARE(scale);
  SWELL_COMPARE(at_file_origin);
}

void compare_waypoints(const Waypoint& a, const Waypoint& b, std::string& list) {
  SWELL_COMPARE(t_s);
  SWELL_COMPARE(eye_m);
  SWELL_COMPARE(heading_rad);
  SWELL_COMPARE(pitch_rad);
  SWELL_COMPARE(roll_rad);
}

void compare_terrains(const TerrainDescription& a, const TerrainDescription& b, std::string& list) {
  SWELL_COMPARE(height_image);
  SWELL_COMPARE(boundary);
  SWELL_COMPARE(ground_from_boundary);
  SWELL_COMPARE(metres_per_pixel);
  SWELL_COMPARE(low_m);
  SWELL_COMPARE(high_m);
  SWELL_COMPARE(sea_level_m);
  SWELL_COMPARE(centre_m);
  SWELL_COMPARE(island_radius_m);
  SWELL_COMPARE(islands);
  SWELL_COMPARE(archipelago_size_m);
  SWELL_COMPARE(island_height_m);
  SWELL_COMPARE(floor_depth_m);
  SWELL_COMPARE(coast_m);
  SWELL_COMPARE(beach_slope);
  SWELL_COMPARE(beach_size_m);
  SWELL_COMPARE(seed);
  SWELL_COMPARE(checker_m);
}

}  // namespace

std::string error_of(const std::string& text) {
  try {
    parse_scene(text, "test.toml");
  } catch (const SceneError& error) {
    return error.what();
  }
  return {};
}

std::string differences(const Scene& a, const Scene& b) {
  std::string list;
  SWELL_COMPARE(name);
  SWELL_COMPARE(camera.eye_m);
  SWELL_COMPARE(camera.heading_rad);
  SWELL_COMPARE(camera.pitch_rad);
  SWELL_COMPARE(camera.fov_y_rad);
  SWELL_COMPARE(camera.near_m);
  SWELL_COMPARE(camera.velocity_mps);
  SWELL_COMPARE(camera.turn_rad_s);
  SWELL_COMPARE(camera.roll_rad);
  SWELL_COMPARE(camera.quaternion);
  SWELL_COMPARE(camera.focal_px);
  SWELL_COMPARE(camera.principal_px);
  SWELL_COMPARE(camera.size_px);
  SWELL_COMPARE(camera.mount);
  SWELL_COMPARE(camera.mount_offset_m);
  SWELL_COMPARE(camera.exposure_s);
  SWELL_COMPARE(camera.shutter_samples);
  SWELL_COMPARE(camera.f_number);
  SWELL_COMPARE(camera.projection);
  SWELL_COMPARE(camera.fisheye_fov_rad);
  SWELL_COMPARE(camera.fisheye_k);
  SWELL_COMPARE(camera.noise.full_well_e);
  SWELL_COMPARE(camera.noise.iso);
  SWELL_COMPARE(camera.noise.read_noise_e);
  SWELL_COMPARE(camera.noise.seed);
  SWELL_COMPARE(sky.sun_azimuth_rad);
  SWELL_COMPARE(sky.sun_elevation_rad);
  SWELL_COMPARE(sky.sun_direction);
  SWELL_COMPARE(sky.model);
  SWELL_COMPARE(sky.turbidity);
  SWELL_COMPARE(sky.moon_phase);
  SWELL_COMPARE(sky.moon_azimuth_rad);
  SWELL_COMPARE(sky.moon_elevation_rad);
  SWELL_COMPARE(sky.time_utc);
  SWELL_COMPARE(sky.latitude_rad);
  SWELL_COMPARE(sky.longitude_rad);
  SWELL_COMPARE(sky.sun_radiance);
  SWELL_COMPARE(sky.zenith);
  SWELL_COMPARE(sky.horizon);
  SWELL_COMPARE(sky.haze_distance_m);
  SWELL_COMPARE(sky.haze_height_m);
  SWELL_COMPARE(sky.cloud_cover);
  SWELL_COMPARE(sky.cloud_seed);
  SWELL_COMPARE(sky.exposure);
  SWELL_COMPARE(air.visibility_m);
  SWELL_COMPARE(air.attenuation_per_m);
  SWELL_COMPARE(air.rain_mm_h);
  SWELL_COMPARE(air.fog_top_m);
  SWELL_COMPARE(air.profile);
  SWELL_COMPARE(air.scattering);
  SWELL_COMPARE(air.method);
  SWELL_COMPARE(air.forward);
  SWELL_COMPARE(air.banks);
  SWELL_COMPARE(air.bank_length_m);
  SWELL_COMPARE(douglas);
  SWELL_COMPARE(beaufort);
  SWELL_COMPARE(sea.spectrum);
  SWELL_COMPARE(sea.wind_speed_mps);
  SWELL_COMPARE(sea.wind_from_rad);
  SWELL_COMPARE(sea.hs_m);
  SWELL_COMPARE(sea.tp_s);
  SWELL_COMPARE(sea.fetch_km);
  SWELL_COMPARE(sea.gamma);
  SWELL_COMPARE(sea.amplitude_scale);
  SWELL_COMPARE(sea.choppiness);
  SWELL_COMPARE(sea.gravity_mps2);
  SWELL_COMPARE(sea.loop_s);
  SWELL_COMPARE(sea.whitecaps);
  SWELL_COMPARE(sea.tiling);
  SWELL_COMPARE(sea.map_set);
  SWELL_COMPARE(sea.map_heights);
  SWELL_COMPARE(sea.seed);
  SWELL_COMPARE(sea.resolution);
  SWELL_COMPARE(sea.patch_lengths_m);
  SWELL_COMPARE(area.centre_m);
  SWELL_COMPARE(area.size_m);
  SWELL_COMPARE(round_earth);
  SWELL_COMPARE(water.refraction_index);
  SWELL_COMPARE(water.type);
  SWELL_COMPARE(water.body_colour);
  SWELL_COMPARE(water.absorption_per_m);
  SWELL_COMPARE(water.distortion);
  SWELL_COMPARE(water.lookup_scale);
  SWELL_COMPARE(water.bump_strength);
  SWELL_COMPARE(water.uv_noise_amplitude);
  SWELL_COMPARE(water.caustics);
  SWELL_COMPARE(water.tilted_backs);
  SWELL_COMPARE(water.distortion_factor);
  SWELL_COMPARE(water.caustic_distortion);
  SWELL_COMPARE(water.glitter);
  SWELL_COMPARE(water.glitter_distortion);
  SWELL_COMPARE(clouds);
  SWELL_COMPARE(ripples);
  SWELL_COMPARE(water.refraction);
  SWELL_COMPARE(water.reflection_weight);
  SWELL_COMPARE(water.refraction_weight);
  SWELL_COMPARE(water.texture);
  SWELL_COMPARE(water.texture_length_m);
  SWELL_COMPARE(coast.model);
  SWELL_COMPARE(coast.trains);
  SWELL_COMPARE(coast.eikonal);
  SWELL_COMPARE(coast.grid_spacing_m);
  SWELL_COMPARE(coast.seed);
  SWELL_COMPARE(detail.water_triangles);
  SWELL_COMPARE(detail.terrain_triangles);
  SWELL_COMPARE(detail.least_water_triangle_px);
  SWELL_COMPARE(detail.background_error_px);
  SWELL_COMPARE(detail.inverse_distance_priority);
  SWELL_COMPARE(terrain.has_value());
  SWELL_COMPARE(sea.maps.size());
  for (std::size_t i = 0; i < std::min(a.sea.maps.size(), b.sea.maps.size()); ++i)
    compare_maps(a.sea.maps[i], b.sea.maps[i], list);
  SWELL_COMPARE(sea.sines.size());
  SWELL_COMPARE(sea.swells.size());
  for (std::size_t i = 0; i < std::min(a.sea.swells.size(), b.sea.swells.size()); ++i)
    compare_swells(a.sea.swells[i], b.sea.swells[i], list);
  if (a.terrain && b.terrain) compare_terrains(*a.terrain, *b.terrain, list);
  for (std::size_t i = 0; i < std::min(a.sea.sines.size(), b.sea.sines.size()); ++i)
    compare_sines(a.sea.sines[i], b.sea.sines[i], list);
  SWELL_COMPARE(objects.size());
  for (std::size_t i = 0; i < std::min(a.objects.size(), b.objects.size()); ++i)
    compare_objects(a.objects[i], b.objects[i], list);
  SWELL_COMPARE(disturbances);
  SWELL_COMPARE(rivers);
  SWELL_COMPARE(lakes);
  SWELL_COMPARE(camera.path.size());
  for (std::size_t i = 0; i < std::min(a.camera.path.size(), b.camera.path.size()); ++i)
    compare_waypoints(a.camera.path[i], b.camera.path[i], list);
  return list;
}

}  // namespace swell::scene
