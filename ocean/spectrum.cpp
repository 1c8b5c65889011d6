#include "ocean/spectrum.h"

#include <cmath>

#include "math/elementary.h"
#include "ocean/dispersion.h"

namespace swell::ocean {
namespace {

constexpr double kTwoPi = 2.0 * kPi;
constexpr double kAlpha = 0.0081;  // Phillips' constant

// exp(-5/4 (f_m / f)^4), the fraction of the energy below f.
double energy_fraction_below(double f_over_peak) {
  const double r2 = 1.0 / (f_over_peak * f_over_peak);
  return exp(-1.25 * r2 * r2);
}

}  // namespace

WindSea make_wind_sea(double wind_speed_mps, double wind_from_rad, double gravity_mps2) {
  const SinCos from = sin_cos_turns(wind_from_rad / kTwoPi);
  return {wind_speed_mps, {-from.sin, -from.cos}, gravity_mps2};
}

double peak_frequency_hz(const WindSea& sea) {
  return 0.13 * sea.gravity_mps2 / sea.wind_speed_mps;
}

double frequency_spectrum(const WindSea& sea, double f_hz) {
  if (!(f_hz > 0.0) || sea.wind_speed_mps == 0.0) return 0.0;
  const double omega = kTwoPi * f_hz;
  const double omega4 = omega * omega * omega * omega;
  const double tail = kAlpha * sea.gravity_mps2 * sea.gravity_mps2 / (omega4 * f_hz);
  return tail * energy_fraction_below(f_hz / peak_frequency_hz(sea));
}

double variance_below(const WindSea& sea, double f_hz) {
  if (!(f_hz > 0.0) || sea.wind_speed_mps == 0.0) return 0.0;
  // d/df exp(-5/4 (f_m / f)^4) = 5 f_m^4 f^-5 exp(...).
  const double omega_m = kTwoPi * peak_frequency_hz(sea);
  const double omega_m4 = omega_m * omega_m * omega_m * omega_m;
  const double m0 = kAlpha * sea.gravity_mps2 * sea.gravity_mps2 / (5.0 * omega_m4);
  return m0 * energy_fraction_below(f_hz / peak_frequency_hz(sea));
}

double spreading_exponent(double f_over_peak) {
  return 9.77 * pow(f_over_peak, f_over_peak < 1.0 ? 4.06 : -2.34);
}

double directional_weight(double p, double cos_theta) {
  // ln N_p, N_p = 2^(1 - 2p) pi Gamma(2p + 1) / Gamma(p + 1)^2: the Gammas alone overflow.
  constexpr double kLn2 = 0.69314718055994530942;
  const double ln_n =
      (1.0 - 2.0 * p) * kLn2 + log(kPi) + log_gamma(2.0 * p + 1.0) - 2.0 * log_gamma(p + 1.0);
  const double cos2_half = 0.5 * (1.0 + cos_theta);
  return cos2_half > 0.0 ? exp(p * log(cos2_half) - ln_n) : 0.0;
}

double wave_vector_spectrum(const WindSea& sea, glm::dvec2 k_rad_m) {
  const double k = std::sqrt(k_rad_m.x * k_rad_m.x + k_rad_m.y * k_rad_m.y);
  if (k == 0.0 || sea.wind_speed_mps == 0.0) return 0.0;
  const double f_hz = deep_water_omega(k, sea.gravity_mps2) / kTwoPi;
  const double energy = frequency_spectrum(sea, f_hz);
  if (energy == 0.0) return 0.0;
  const double p = spreading_exponent(f_hz / peak_frequency_hz(sea));
  const double cos_theta = (k_rad_m.x * sea.travel.x + k_rad_m.y * sea.travel.y) / k;
  const double df_dk = 0.5 * f_hz / k;  // f ~ sqrt(k)
  return energy * directional_weight(p, cos_theta) * df_dk / k;
}

}  // namespace swell::ocean
