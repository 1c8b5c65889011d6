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

// The other way round: k in rad/m of waves of omega_rad_s >= 0 (2 pi / T; 0 for T = infinity) in
// water of depth_m, which may be infinite. Relative error 1e-13. omega = 0 gives 0, and no depth
// (depth_m <= 0) infinity otherwise. 60 ns.
// Source of the first guess: Hunt, Direct Solution of Wave Dispersion Equation, 1979 (6 terms,
// 0.19 % off); two Newton steps follow.
double wave_number(double omega_rad_s, double depth_m, double gravity_mps2);

// n = cg / c = (1 + 2 kh / sinh 2kh) / 2 in [0.5, 1]: how fast energy travels, in phase speeds.
// kh >= 0 may be infinite. 1 in shallow water, 0.5 in deep water.
double group_ratio(double kh);

// Group velocity d omega / d k in m/s. omega_rad_s > 0; 0 where there is no depth.
double group_speed(double omega_rad_s, double depth_m, double gravity_mps2);

// Ks = sqrt(cg_inf / cg) = (2 n tanh kh)^(-1/2): how much higher waves of constant energy flux are
// than in deep water. Least at kh = 1.1997 (0.912993); infinite at kh = 0.
double shoaling_coefficient(double kh);

}  // namespace swell::ocean
