#include "scene/file/sea_state.h"

#include <algorithm>

#include "ocean/spectrum/sea_scale.h"

namespace swell::scene {

std::vector<double> fitting_patch_lengths(const ocean::SeaDescription& sea) {
  double longest_m = 0.0;
  for (const ocean::WaveSystem& system : ocean::wave_systems(sea))
    longest_m = std::max(longest_m, ocean::peak_wavelength_m(system));
  return ocean::patch_lengths_for_peak(longest_m);
}

double wind_of_sea_state_mps(int code, double gravity_mps2) {
  return ocean::wind_of_developed_height(ocean::douglas_step(code).preset, gravity_mps2);
}

Scene with_sea_state(Scene scene, int code) {
  ocean::SeaDescription& sea = scene.sea;
  scene.douglas = code;
  scene.beaufort.reset();
  sea.spectrum = true;
  sea.hs_m = sea.tp_s = sea.fetch_km = sea.gamma = std::nullopt;
  sea.map_set = ocean::MapSet::kNone;
  sea.maps.clear();
  sea.wind_speed_mps = wind_of_sea_state_mps(code, sea.gravity_mps2);
  sea.patch_lengths_m = fitting_patch_lengths(sea);
  return scene;
}

}  // namespace swell::scene
