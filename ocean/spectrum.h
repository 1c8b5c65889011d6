// The energy of a fully developed wind sea by frequency, direction and wave vector.
//
// Source: Mastin, Watterberg, Mareda, Fourier Synthesis of Ocean Scenes, IEEE CG&A 1987: the
// Pierson-Moskowitz filter times Hasselmann's directional weight. Densities are one-sided: the
// integral over f > 0 and all directions of travel is the variance m0 of the height in m^2.
#pragma once

#include <glm/glm.hpp>

namespace swell::ocean {

// A wind that has blown long enough over deep water.
struct WindSea {
  double wind_speed_mps = 0.0;  // U10, at 10 m height; 0 is a flat sea
  glm::dvec2 travel{0.0, 1.0};  // unit vector the waves travel along: x east, y north
  double gravity_mps2 = 9.81;
};

// wind_from_rad is where the wind comes FROM, clockwise from north.
WindSea make_wind_sea(double wind_speed_mps, double wind_from_rad, double gravity_mps2);

// f_m = 0.13 g / U10 in Hz, where the energy peaks. wind_speed_mps > 0.
double peak_frequency_hz(const WindSea& sea);

// F_PM(f) = alpha g^2 / ((2 pi)^4 f^5) exp(-5/4 (f_m / f)^4) in m^2/Hz; 0 for f <= 0 or no wind.
double frequency_spectrum(const WindSea& sea, double f_hz);

// Integral of F_PM from 0 to f_hz, closed form, in m^2. f_hz may be infinite: m0.
double variance_below(const WindSea& sea, double f_hz);

// p(f / f_m) = 9.77 (f / f_m)^mu, mu = 4.06 below the peak and -2.34 above; f / f_m > 0.
double spreading_exponent(double f_over_peak);

// D = |cos(theta / 2)|^(2p) / N_p per radian, theta from the direction of travel, p >= 0.
double directional_weight(double p, double cos_theta);

// S(k) = F(f, theta) (df/dk) / k in m^4, with deep-water f(k): its integral over the wave-vector
// plane is m0. k_rad_m points to where the wave travels; 0 at k = 0.
double wave_vector_spectrum(const WindSea& sea, glm::dvec2 k_rad_m);

}  // namespace swell::ocean
