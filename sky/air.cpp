#include "sky/air.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"

namespace swell::sky {
namespace {

constexpr double kRayleighHeight_m = 8000.0, kMieHeight_m = 1200.0;
constexpr double kOzoneMiddle_m = 25000.0, kOzoneHalfWidth_m = 15000.0;
constexpr double kMieAlbedo = 0.92, kAngstrom = 0.7;
constexpr double kNarrow = 0.88, kWide = 0.45, kNarrowPart = 0.53;

// Source: L. G. Henyey, J. L. Greenstein, Diffuse radiation in the galaxy, 1941, eq. 2.
double henyey_greenstein(double cos_theta, double g) {
  const double base = 1.0 + g * g - 2.0 * g * cos_theta;
  return (1.0 - g * g) / (4.0 * kPi * base * std::sqrt(base));
}

}  // namespace

Air make_air(double turbidity) {
  Air air;
  const double depth = (turbidity - 1.0) * air.rayleigh_per_m.y * kRayleighHeight_m;
  const auto at = [&](double wavelength_nm) {
    return depth / kMieHeight_m * pow(wavelength_nm / 550.0, -kAngstrom);
  };
  air.mie_per_m = {at(680.0), at(550.0), at(440.0)};
  return air;
}

AirLight air_light(const Air& air, double height_m) {
  const glm::dvec3 rayleigh = air.rayleigh_per_m * exp(-height_m / kRayleighHeight_m);
  const glm::dvec3 mie = air.mie_per_m * exp(-height_m / kMieHeight_m);
  const double ozone = 1.0 - std::abs(height_m - kOzoneMiddle_m) / kOzoneHalfWidth_m;
  return {rayleigh, kMieAlbedo * mie, rayleigh + mie + air.ozone_per_m * std::max(ozone, 0.0)};
}

// Source: Rayleigh 1871.
double rayleigh_phase(double cos_theta) {
  return 3.0 / (16.0 * kPi) * (1.0 + cos_theta * cos_theta);
}

// Haze throws a narrow beam forward, and the rest widely: two terms, of mean cosine 0.68.
// Source: G. W. Kattawar, A three-parameter analytic phase function for multiple scattering
// calculations, 1975.
double mie_phase(double cos_theta) {
  return kNarrowPart * henyey_greenstein(cos_theta, kNarrow) +
         (1.0 - kNarrowPart) * henyey_greenstein(cos_theta, kWide);
}

double rayleigh_moment(int degree) { return degree == 0 ? 1.0 : degree == 2 ? 0.1 : 0.0; }

// Source: H. C. van de Hulst, Multiple Light Scattering, 1980, section 10.1.
double mie_moment(int degree) {
  return kNarrowPart * pow(kNarrow, degree) + (1.0 - kNarrowPart) * pow(kWide, degree);
}

double height_along(double radius_m, double sine, double t_m) {
  return std::sqrt(std::max(radius_m * radius_m + t_m * (t_m + 2.0 * radius_m * sine), 0.0)) -
         kEarthRadius_m;
}

std::optional<double> distance_to_sea_m(double radius_m, double sine) {
  const double in_circle =
      kEarthRadius_m * kEarthRadius_m - radius_m * radius_m * (1.0 - sine * sine);
  if (sine >= 0.0 || in_circle < 0.0) return std::nullopt;
  return std::max(-radius_m * sine - std::sqrt(in_circle), 0.0);
}

}  // namespace swell::sky
