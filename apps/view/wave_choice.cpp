#include "apps/view/wave_choice.h"

#include <utility>

#include "math/elementary.h"
#include "scene/file/sea_state.h"

namespace swell::view {
namespace {

// Three waves of moderate steepness (amplitude 1/60 of the length), fanned about the wind.
std::vector<ocean::SineWave> waves_with_wind(double wind_from_rad) {
  const double to_rad = wind_from_rad + kPi;
  return {{.amplitude_m = 0.9, .wavelength_m = 54.0, .to_rad = to_rad},
          {.amplitude_m = 0.5, .wavelength_m = 31.0, .to_rad = to_rad + 0.4, .phase_rad = 1.0},
          {.amplitude_m = 0.3, .wavelength_m = 18.0, .to_rad = to_rad - 0.5, .phase_rad = 2.0}};
}

}  // namespace

WaveChoice wave_choice(const scene::Scene& scene) {
  const ocean::SeaDescription& sea = scene.sea;
  const WaveModel model = sea.sines.empty()      ? WaveModel::kSpectrum
                          : sea.has_wind_waves() ? WaveModel::kBoth
                                                 : WaveModel::kSines;
  return {model, sea.wind_speed_mps, sea.wind_from_rad, scene.douglas};
}

double wind_speed_mps(const scene::Scene& scene, const WaveChoice& choice) {
  return choice.sea_state ? scene::wind_of_sea_state_mps(*choice.sea_state, scene.sea.gravity_mps2)
                          : choice.wind_speed_mps;
}

EnumTable<WaveModel, const char*> wave_names(const scene::Scene& scene) {
  using enum WaveModel;
  switch (scene.terrain ? scene.coast.model : scene::CoastModel::kNone) {
    case scene::CoastModel::kNone:
    case scene::CoastModel::kFronts:
      break;
    case scene::CoastModel::kTrains:  // which end at the border of the terrain
      return enum_table<WaveModel, const char*>({{kSpectrum, "trains, spectrum beyond"},
                                                 {kSines, "trains, sines beyond"},
                                                 {kBoth, "trains, both beyond"}});
    case scene::CoastModel::kBlend:
      return enum_table<WaveModel, const char*>({{kSpectrum, "spectrum and trains"},
                                                 {kSines, "sines and trains"},
                                                 {kBoth, "spectrum, sines, trains"}});
  }
  if (scene.sea.has_maps())
    return enum_table<WaveModel, const char*>(
        {{kSpectrum, "maps"}, {kSines, "sines"}, {kBoth, "maps and sines"}});
  return enum_table<WaveModel, const char*>(
      {{kSpectrum, "spectrum"}, {kSines, "sines"}, {kBoth, "spectrum and sines"}});
}

scene::Scene with_waves(scene::Scene scene, const WaveChoice& choice) {
  const WaveChoice own = wave_choice(scene);
  if (choice == own) return scene;
  if (choice.sea_state != own.sea_state) {
    scene.douglas.reset();
    if (choice.sea_state) scene = scene::with_sea_state(std::move(scene), *choice.sea_state);
  }
  scene.sea.spectrum = choice.model != WaveModel::kSines && !scene.sea.has_maps();
  if (choice.model == WaveModel::kSines) {
    scene.sea.map_set = ocean::MapSet::kNone;
    scene.sea.maps.clear();
  }
  if (!choice.sea_state && choice.wind_speed_mps != own.wind_speed_mps) {
    scene.beaufort.reset();
    scene.sea.wind_speed_mps = choice.wind_speed_mps;
  }
  scene.sea.wind_from_rad = choice.wind_from_rad;
  if (choice.model == WaveModel::kSpectrum)
    scene.sea.sines.clear();
  else if (scene.sea.sines.empty())
    scene.sea.sines = waves_with_wind(choice.wind_from_rad);
  return scene;
}

}  // namespace swell::view
