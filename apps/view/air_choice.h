// What the panel lets one change about light and air, and the scene that results.
#pragma once

#include "scene/scene.h"

namespace swell::view {

struct AirChoice {
  bool by_time = false;    // sun and moon stand as they do at a time, else as the angles say
  double hour_utc = 12.0;  // [0, 24), on the day of the scene's sky.time_utc or 2026-06-21
  double sun_azimuth_rad = 0.0, sun_elevation_rad = 0.0;
  double thin_cover = 0.0;  // of the thin clouds, [0, 1]
  scene::CloudKind clouds = scene::CloudKind::kNone;
  double cover = 0.0;  // of a layer of them, [0, 1]
  bool fog = false;
  double visibility_m = 1000.0;  // in fog
  bool operator==(const AirChoice&) const = default;
};

// What the scene itself says.
AirChoice air_choice(const scene::Scene& scene);

// `scene` with what of the choice is not the scene's own.
scene::Scene with_air(scene::Scene scene, const AirChoice& choice);

}  // namespace swell::view
