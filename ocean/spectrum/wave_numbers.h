// What ocean/spectrum/dispersion.h has for one depth, for many: the same bits, several at a time.
#pragma once

#include <span>

namespace swell::ocean {

// k_rad_m[i] = wave_number(omega_rad_s, depth_m[i], gravity_mps2) for omega_rad_s > 0 and depths
// > 0, which may be infinite. Spans of one length that do not overlap. 10 ns a depth on AVX2. The
// same bits on every SIMD target.
void wave_numbers(double omega_rad_s, double gravity_mps2, std::span<const double> depth_m,
                  std::span<double> k_rad_m);

// coefficient[i] = shoaling_coefficient(k_rad_m[i] * depth_m[i]) for k and depths > 0 as above, one
// of them finite. Spans of one length; coefficient may be k_rad_m or depth_m.
void shoaling_coefficients(std::span<const double> k_rad_m, std::span<const double> depth_m,
                           std::span<double> coefficient);

}  // namespace swell::ocean
