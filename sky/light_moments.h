// Light from all directions about a place, as a sum of spherical harmonics: what scattering makes
// of it is one factor a degree.
//
// With azimuths from the light's, where it is alike on both sides, light is
//
//   I(mu, phi) = sum over m of cos(m phi) sum over l of K_lm(mu) I_lm,
//
// mu the sine of the elevation, K_lm the associated Legendre functions, orthonormal over mu. A
// phase function of moments chi_l, sum of (2 l + 1) / (4 pi) chi_l P_l, makes chi_l I_lm of I_lm.
//
// Source: S. Chandrasekhar, Radiative Transfer, 1950, section 48 (the addition theorem).
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>

namespace swell::sky {

// Haze throws light of moment 18 on by less than a twentieth; what it scattered twice has none.
inline constexpr int kDegrees = 20;
// cos(m phi) for m below this: with 12, light beside a low sun in haze was 10 % too weak.
inline constexpr int kModes = 16;

// Returns the number of moment (l, m), l >= m, in [0, kMoments): all degrees of a mode are
// neighbours.
constexpr int moment_index(int l, int m) { return m * kDegrees - m * (m - 1) / 2 + l - m; }
inline constexpr int kMoments = moment_index(kModes, kModes);

// Molecules: what they make of moments (2, m) is not even, for m below this.
inline constexpr int kRayleighModes = 3;

// K_lm(sine), by moment_index().
using Harmonics = std::array<float, kMoments>;
Harmonics harmonics(double sine);

// 1 over the integral of cos(m phi)^2 around the circle.
double mode_norm(int m);

}  // namespace swell::sky
