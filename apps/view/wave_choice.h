// What the panel lets one change about the waves, and the scene that results.
#pragma once

#include <optional>

#include "math/enum_table.h"
#include "scene/scene.h"

namespace swell::view {

enum class WaveModel { kSpectrum, kSines, kBoth };

struct WaveChoice {
  WaveModel model = WaveModel::kSpectrum;
  double wind_speed_mps = 0.0;  // [0, 60]
  double wind_from_rad = 0.0;
  std::optional<int> sea_state = {};  // WMO code, [0, 9], in place of the wind's speed
  bool operator==(const WaveChoice&) const = default;
};

// What the scene itself says.
WaveChoice wave_choice(const scene::Scene& scene);

// The wind of the choice: that of its sea state if it has one.
double wind_speed_mps(const scene::Scene& scene, const WaveChoice& choice);

// The scene's waves with each model; maps stand in the spectrum's place.
// With a coast they have its trains, too, which no choice takes away.
EnumTable<WaveModel, const char*> wave_names(const scene::Scene& scene);

// `scene` with other waves, its coast as it is. Explicit waves are kept as the scene has them; a
// scene without any gets three that run with the wind. A sea state takes the place of maps.
scene::Scene with_waves(scene::Scene scene, const WaveChoice& choice);

}  // namespace swell::view
