#include "ocean/spectrum/spectrum.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/elementary.h"
#include "ocean/spectrum/dispersion.h"

namespace swell::ocean {
namespace {

// exp(-5/4 (f_m / f)^4), the fraction of the energy below f where gamma is 1.
double energy_fraction_below(double f_over_peak) {
  const double r2 = 1.0 / (f_over_peak * f_over_peak);
  return exp(-1.25 * r2 * r2);
}

// Its inverse.
double frequency_of_fraction(double fraction) {
  return std::sqrt(std::sqrt(1.25 / -log(fraction)));
}

double enhancement(const WaveSystem& sea, double f_over_peak) {
  if (sea.gamma == 1.0) return 1.0;
  const double from_peak = (f_over_peak - 1.0) / (f_over_peak < 1.0 ? 0.07 : 0.09);
  return pow(sea.gamma, exp(-0.5 * from_peak * from_peak));
}

// Integral of the enhancement over energy_fraction_below(), from 0 to `fraction`.
double enhanced_fraction(const WaveSystem& sea, double fraction) {
  if (sea.gamma == 1.0) return fraction;
  constexpr int kSteps = 2048;
  double sum = 0.0;
  for (int n = 0; n < kSteps; ++n)
    sum += enhancement(sea, frequency_of_fraction(fraction * (n + 0.5) / kSteps));
  return fraction * sum / kSteps;
}

}  // namespace

WaveSystem make_wind_sea(double wind_speed_mps, double wind_from_rad, double gravity_mps2) {
  const SinCos from = sin_cos_turns(wind_from_rad / kTwoPi);
  const double peak_hz = wind_speed_mps > 0.0 ? 0.13 * gravity_mps2 / wind_speed_mps : 0.0;
  return {peak_hz, {-from.sin, -from.cos}, gravity_mps2};
}

WaveSystem make_fetch_sea(double wind_speed_mps, double wind_from_rad, double gravity_mps2,
                          double fetch_m, double gamma) {
  WaveSystem sea = make_wind_sea(wind_speed_mps, wind_from_rad, gravity_mps2);
  if (wind_speed_mps <= 0.0) return sea;
  const double x = gravity_mps2 * fetch_m / (wind_speed_mps * wind_speed_mps);
  sea.peak_hz = std::max(sea.peak_hz, 3.5 * gravity_mps2 / wind_speed_mps * pow(x, -0.33));
  sea.alpha = std::max(kPhillips, 0.076 * pow(x, -0.22));
  sea.gamma = gamma;
  return sea;
}

WaveSystem with_height(const WaveSystem& system, double height_m) {
  WaveSystem scaled = system;
  const double m0 = variance_below(system, std::numeric_limits<double>::infinity());
  scaled.alpha = m0 > 0.0 ? system.alpha * height_m * height_m / (16.0 * m0) : 0.0;
  return scaled;
}

double frequency_spectrum(const WaveSystem& sea, double f_hz) {
  if (!(f_hz > 0.0) || sea.peak_hz == 0.0) return 0.0;
  const double omega = kTwoPi * f_hz;
  const double omega4 = omega * omega * omega * omega;
  const double tail = sea.alpha * sea.gravity_mps2 * sea.gravity_mps2 / (omega4 * f_hz);
  const double f_over_peak = f_hz / sea.peak_hz;
  return tail * energy_fraction_below(f_over_peak) * enhancement(sea, f_over_peak);
}

double variance_below(const WaveSystem& sea, double f_hz) {
  if (!(f_hz > 0.0) || sea.peak_hz == 0.0) return 0.0;
  // d/df exp(-5/4 (f_m / f)^4) = 5 f_m^4 f^-5 exp(...).
  const double omega_m = kTwoPi * sea.peak_hz;
  const double omega_m4 = omega_m * omega_m * omega_m * omega_m;
  const double m0 = sea.alpha * sea.gravity_mps2 * sea.gravity_mps2 / (5.0 * omega_m4);
  return m0 * enhanced_fraction(sea, energy_fraction_below(f_hz / sea.peak_hz));
}

double frequency_of_energy(const WaveSystem& sea, double part) {
  if (sea.gamma == 1.0) return frequency_of_fraction(part);
  const double wanted = part * enhanced_fraction(sea, 1.0);
  double low = 0.0, high = 1.0;
  for (int step = 0; step < 40; ++step) {
    const double middle = 0.5 * (low + high);
    (enhanced_fraction(sea, middle) < wanted ? low : high) = middle;
  }
  return frequency_of_fraction(0.5 * (low + high));
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

double angle_of_energy(double p, double part) {
  constexpr int kSteps = 512;
  const double step = kTwoPi / kSteps;
  double below = 0.0;
  for (int n = 0; n < kSteps; ++n) {
    const double middle = -kPi + (n + 0.5) * step;
    const double energy = directional_weight(p, cos(middle)) * step;
    if (below + energy >= part) return middle + ((part - below) / energy - 0.5) * step;
    below += energy;
  }
  return kPi;
}

double spreading_of(const WaveSystem& sea, double f_over_peak) {
  return sea.spreading > 0.0 ? sea.spreading : spreading_exponent(f_over_peak);
}

double wave_vector_spectrum(const WaveSystem& sea, glm::dvec2 k_rad_m) {
  const double k = std::sqrt(k_rad_m.x * k_rad_m.x + k_rad_m.y * k_rad_m.y);
  if (k == 0.0 || sea.peak_hz == 0.0) return 0.0;
  const double f_hz = deep_water_omega(k, sea.gravity_mps2) / kTwoPi;
  const double energy = frequency_spectrum(sea, f_hz);
  if (energy == 0.0) return 0.0;
  const double p = spreading_of(sea, f_hz / sea.peak_hz);
  const double cos_theta = (k_rad_m.x * sea.travel.x + k_rad_m.y * sea.travel.y) / k;
  const double df_dk = 0.5 * f_hz / k;  // f ~ sqrt(k)
  return energy * directional_weight(p, cos_theta) * df_dk / k;
}

}  // namespace swell::ocean
