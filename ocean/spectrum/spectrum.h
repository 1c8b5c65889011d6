// The energy of a wind sea or a swell by frequency, direction and wave vector.
//
// Sources: Mastin, Watterberg, Mareda, Fourier Synthesis of Ocean Scenes, IEEE CG&A 1987: the
// Pierson-Moskowitz filter times Hasselmann's directional weight. Hasselmann et al., Measurements
// of Wind-Wave Growth and Swell Decay during the Joint North Sea Wave Project (JONSWAP), 1973: the
// peak's enhancement and its growth with the fetch. Densities are one-sided: the integral over
// f > 0 and all directions of travel is the variance m0 of the height in m^2.
#pragma once

#include <glm/glm.hpp>

namespace swell::ocean {

// Phillips' constant of a fully developed sea.
inline constexpr double kPhillips = 0.0081;

// Waves of one origin: a wind's, or a swell's that it left behind.
struct WaveSystem {
  double peak_hz = 0.0;         // f_m, where the energy peaks; 0 is a flat sea
  glm::dvec2 travel{0.0, 1.0};  // unit vector the waves travel along: x east, y north
  double gravity_mps2 = 9.81;
  double alpha = kPhillips;
  double gamma = 1.0;      // enhancement of the peak, >= 1; 1 is Pierson's and Moskowitz's spectrum
  double spreading = 0.0;  // p of directional_weight() at all frequencies; 0: Hasselmann's
};

// A wind that has blown long enough over deep water: f_m = 0.13 g / U10. wind_from_rad is where it
// comes FROM, clockwise from north; no wind is a flat sea.
WaveSystem make_wind_sea(double wind_speed_mps, double wind_from_rad, double gravity_mps2);

// A wind that has blown over so much water, in m, > 0: JONSWAP's f_m = 3.5 (g / U10) x^-0.33 and
// alpha = 0.076 x^-0.22, x = g fetch / U10^2, until the sea is fully developed.
WaveSystem make_fetch_sea(double wind_speed_mps, double wind_from_rad, double gravity_mps2,
                          double fetch_m, double gamma);

// The system with alpha such that its significant height 4 sqrt(m0) is height_m.
WaveSystem with_height(const WaveSystem& system, double height_m);

// F(f) = alpha g^2 / ((2 pi)^4 f^5) exp(-5/4 (f_m / f)^4) gamma^r in m^2/Hz,
// r = exp(-(f / f_m - 1)^2 / (2 s^2)), s = 0.07 below the peak and 0.09 above; 0 for f <= 0 and in
// a flat sea.
double frequency_spectrum(const WaveSystem& sea, double f_hz);

// Integral of F from 0 to f_hz in m^2; f_hz may be infinite: m0. Closed form where gamma is 1, else
// to 1e-6.
double variance_below(const WaveSystem& sea, double f_hz);

// f / f_m below which `part` in (0, 1) of the energy lies: the inverse of variance_below().
double frequency_of_energy(const WaveSystem& sea, double part);

// Hasselmann's p(f / f_m) = 9.77 (f / f_m)^mu, mu = 4.06 below the peak and -2.34 above; f / f_m >
// 0.
double spreading_exponent(double f_over_peak);

// D = |cos(theta / 2)|^(2p) / N_p per radian, theta from the direction of travel, p >= 0.
double directional_weight(double p, double cos_theta);

// Angle in [-pi, pi] from the direction of travel below which `part` in [0, 1] of the energy of one
// frequency lies, which directional_weight() spreads with exponent p. 5 us.
double angle_of_energy(double p, double part);

// p at f / f_m > 0, with the system's own where it has one.
double spreading_of(const WaveSystem& sea, double f_over_peak);

// S(k) = F(f, theta) (df/dk) / k in m^4, with deep-water f(k): its integral over the wave-vector
// plane is m0. k_rad_m points to where the wave travels; 0 at k = 0.
double wave_vector_spectrum(const WaveSystem& sea, glm::dvec2 k_rad_m);

}  // namespace swell::ocean
