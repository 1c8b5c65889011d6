// Sea states by number: the WMO (Douglas) scale of wave heights and the Beaufort scale of winds.
//
// Every wind here is U10, at 10 m above the sea, and every height is the significant height
// Hs = 4 sqrt(m0) of the fully developed sea of ocean/spectrum/spectrum.h, for which Hs = 0.2413
// U10^2 / g. Tables that give U19.5, the wind at 19.5 m (Pierson-Moskowitz: Hs = 0.21 U19.5^2 / g),
// have winds 7 % stronger for the same sea.
#pragma once

#include <string_view>
#include <vector>

#include "ocean/spectrum/spectrum.h"

namespace swell::ocean {

inline constexpr int kMaxDouglas = 9, kMaxBeaufort = 12;

// A row of a scale. An exact bound belongs to the lower number, as 4 m does to "rough".
struct SeaScaleStep {
  std::string_view name;  // "rough", "fresh breeze"
  double low = 0.0;       // bounds of the step: Hs in m (Douglas) or U10 in m/s (Beaufort);
  double high = 0.0;      // `high` of the last step is infinite
  double preset = 0.0;    // inside the step
};

// Sea state code in [0, 9]. Source: WMO Manual on Codes, code table 3700.
SeaScaleStep douglas_step(int code);

// Beaufort number in [0, 12]; the preset is 0.836 B^1.5 m/s. Source: WMO Manual on Codes, section
// on the Beaufort scale.
SeaScaleStep beaufort_step(int number);

// The code whose step holds a significant height >= 0.
int douglas_code(double significant_height_m);

// Hs of the fully developed sea of a wind, and the wind that makes a sea of this Hs. gravity > 0.
double developed_height_m(double wind_speed_mps, double gravity_mps2);
double wind_of_developed_height(double significant_height_m, double gravity_mps2);

// Wavelength of the spectrum's peak in deep water; 0 without wind.
double peak_wavelength_m(double wind_speed_mps, double gravity_mps2);
double peak_wavelength_m(const WaveSystem& system);

// Three patch lengths that hold a sea from waves four times as long as its longest peak's down to
// ripples; none over 12 km, the longest at least 60 m, so that a calm sea does not repeat visibly.
std::vector<double> patch_lengths_for_peak(double peak_wavelength_m);

}  // namespace swell::ocean
