// The sea of a WMO sea state, by its number.
#pragma once

#include <vector>

#include "scene/scene.h"

namespace swell::scene {

// Patches that hold the longest of the sea's own waves and swells, longest patch first [m].
std::vector<double> fitting_patch_lengths(const ocean::SeaDescription& sea);

// The wind over a fully developed sea of sea.douglas, code in [0, 9], under this gravity [m/s^2].
double wind_of_sea_state_mps(int code, double gravity_mps2);

// `scene` as a file would describe it that has sea.douglas = code in place of what it says of the
// wind's speed, height, period, fetch, maps and patches.
Scene with_sea_state(Scene scene, int code);

}  // namespace swell::scene
