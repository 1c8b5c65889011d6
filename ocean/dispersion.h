// How fast water waves of one length travel: omega^2 = g k tanh(k h).
#pragma once

#include <cmath>

#include "math/elementary.h"

namespace swell::ocean {

// omega in rad/s of waves of k_rad_m >= 0 in deep water: omega^2 = g k.
inline double deep_water_omega(double k_rad_m, double gravity_mps2) {
  return std::sqrt(gravity_mps2 * k_rad_m);
}

// omega in rad/s of waves of k_rad_m >= 0 in water of depth_m >= 0: omega^2 = g k tanh(k h).
inline double water_omega(double k_rad_m, double depth_m, double gravity_mps2) {
  return std::sqrt(gravity_mps2 * k_rad_m * tanh(k_rad_m * depth_m));
}

}  // namespace swell::ocean
