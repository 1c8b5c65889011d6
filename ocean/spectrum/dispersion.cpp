#include "ocean/spectrum/dispersion.h"

#include <limits>

namespace swell::ocean {
namespace {

// kh for y = omega^2 h / g, y >= 0.
double hunt_depth_in_radians(double y) {
  constexpr double kCoefficients[] = {0.6666666666, 0.3555555555, 0.1608465608,
                                      0.0632098765, 0.0217540484, 0.0065407983};
  double sum = 1.0, power = 1.0;
  for (const double c : kCoefficients) sum += c * (power *= y);
  return std::sqrt(y * y + y / sum);
}

// One Newton step of f(x) = x tanh x - y; f' = tanh x + x / cosh^2 x.
double newton_step(double x, double y) {
  const double t = tanh(x);
  return x - (x * t - y) / (t + x * (1.0 - t * t));
}

}  // namespace

double wave_number(double omega_rad_s, double depth_m, double gravity_mps2) {
  if (!(omega_rad_s > 0.0)) return 0.0;
  if (!(depth_m > 0.0)) return std::numeric_limits<double>::infinity();
  const double k_deep = omega_rad_s * omega_rad_s / gravity_mps2;
  const double y = k_deep * depth_m;
  if (y > 25.0) return k_deep;  // tanh(25) = 1 - 4e-22
  const double guess = hunt_depth_in_radians(y);
  return newton_step(newton_step(guess, y), y) / depth_m;
}

double group_ratio(double kh) {
  if (!(kh > 0.0)) return 1.0;
  if (kh > 25.0) return 0.5;
  const double t = tanh(kh);  // 2 kh / sinh 2kh = kh (1 - t^2) / t
  return 0.5 * (1.0 + kh * (1.0 - t * t) / t);
}

double group_speed(double omega_rad_s, double depth_m, double gravity_mps2) {
  if (!(depth_m > 0.0)) return 0.0;
  const double k = wave_number(omega_rad_s, depth_m, gravity_mps2);
  return group_ratio(k * depth_m) * omega_rad_s / k;
}

double shoaling_coefficient(double kh) { return 1.0 / std::sqrt(2.0 * group_ratio(kh) * tanh(kh)); }

}  // namespace swell::ocean
