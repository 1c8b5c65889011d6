#include "ocean/spectrum/sea_scale.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/check.h"
#include "math/elementary.h"

namespace swell::ocean {
namespace {

constexpr std::array<SeaScaleStep, kMaxDouglas + 1> kDouglas = {{
    {"calm (glassy)", 0.0, 0.0, 0.0},
    {"calm (rippled)", 0.0, 0.1, 0.05},
    {"smooth", 0.1, 0.5, 0.3},
    {"slight", 0.5, 1.25, 0.88},
    {"moderate", 1.25, 2.5, 1.88},
    {"rough", 2.5, 4.0, 3.25},
    {"very rough", 4.0, 6.0, 5.0},
    {"high", 6.0, 9.0, 7.5},
    {"very high", 9.0, 14.0, 11.5},
    {"phenomenal", 14.0, kInfinity<double>, 16.5},
}};

constexpr std::array<std::string_view, kMaxBeaufort + 1> kBeaufortNames = {
    "calm",         "light air",     "light breeze", "gentle breeze", "moderate breeze",
    "fresh breeze", "strong breeze", "near gale",    "gale",          "strong gale",
    "storm",        "violent storm", "hurricane"};

// Where each Beaufort number's winds begin, in m/s.
constexpr std::array<double, kMaxBeaufort + 1> kBeaufortFrom_mps = {
    0.0, 0.3, 1.6, 3.4, 5.5, 8.0, 10.8, 13.9, 17.2, 20.8, 24.5, 28.5, 32.7};

}  // namespace

SeaScaleStep douglas_step(int code) {
  SWELL_CHECK(code >= 0 && code <= kMaxDouglas, "code={}", code);
  return kDouglas[static_cast<std::size_t>(code)];
}

SeaScaleStep beaufort_step(int number) {
  SWELL_CHECK(number >= 0 && number <= kMaxBeaufort, "number={}", number);
  const auto i = static_cast<std::size_t>(number);
  const double high = number < kMaxBeaufort ? kBeaufortFrom_mps[i + 1] : kInfinity<double>;
  return {kBeaufortNames[i], kBeaufortFrom_mps[i], high, 0.836 * number * std::sqrt(number)};
}

int douglas_code(double significant_height_m) {
  SWELL_CHECK(significant_height_m >= 0.0, "height={}", significant_height_m);
  int code = 0;
  while (significant_height_m > kDouglas[static_cast<std::size_t>(code)].high) ++code;
  return code;
}

double developed_height_m(double wind_speed_mps, double gravity_mps2) {
  if (std::isinf(wind_speed_mps)) return kInfinity<double>;  // the last step's bound
  return 4.0 * std::sqrt(variance_below(make_wind_sea(wind_speed_mps, 0.0, gravity_mps2),
                                        kInfinity<double>));
}

double wind_of_developed_height(double significant_height_m, double gravity_mps2) {
  return std::sqrt(significant_height_m / developed_height_m(1.0, gravity_mps2));  // Hs ~ U10^2
}

double peak_wavelength_m(const WaveSystem& system) {
  if (system.peak_hz == 0.0) return 0.0;
  return system.gravity_mps2 / (2.0 * kPi * system.peak_hz * system.peak_hz);
}

double peak_wavelength_m(double wind_speed_mps, double gravity_mps2) {
  return peak_wavelength_m(make_wind_sea(wind_speed_mps, 0.0, gravity_mps2));
}

std::vector<double> patch_lengths_for_peak(double peak_wavelength_m) {
  // One sea out of many differs from the spectrum's height by its standard deviation: 7 % for three
  // peak wavelengths, 5 % for four, when the steps of the Douglas scale are 20 % wide each way.
  const double longest_m = std::clamp(4.0 * peak_wavelength_m, 60.0, 12000.0);
  return {longest_m, longest_m / 6.6, longest_m / 38.0};
}

}  // namespace swell::ocean
