#include "apps/sim/geodetic.h"

#include <cmath>

#include "math/elementary.h"

namespace swell::apps {
namespace {

// Source: NGA.STND.0036, World Geodetic System 1984, 2014, tables 3.1 and 3.3.
constexpr double kSemiMajor_m = 6378137.0, kFlattening = 1.0 / 298.257223563;
constexpr double kEccentricity2 = kFlattening * (2.0 - kFlattening);

// The prime vertical's radius of curvature.
double vertical_radius_m(double sin_latitude) {
  return kSemiMajor_m / std::sqrt(1.0 - kEccentricity2 * sin_latitude * sin_latitude);
}

}  // namespace

Geodetic geodetic_of(const Geodetic& origin, const glm::dvec3& enu_m) {
  const double sin_lat = sin(origin.latitude_rad), cos_lat = cos(origin.latitude_rad);
  const double sin_lon = sin(origin.longitude_rad), cos_lon = cos(origin.longitude_rad);
  // From the earth's middle: towards longitude 0, towards 90 degrees east, towards the north pole.
  const double n = vertical_radius_m(sin_lat);
  const double out_m = (n + origin.altitude_m) * cos_lat - sin_lat * enu_m.y + cos_lat * enu_m.z;
  const double x = out_m * cos_lon - sin_lon * enu_m.x;
  const double y = out_m * sin_lon + cos_lon * enu_m.x;
  const double z = (n * (1.0 - kEccentricity2) + origin.altitude_m) * sin_lat + cos_lat * enu_m.y +
                   sin_lat * enu_m.z;
  // Each step leaves less than 0.007 of the latitude's error: the eccentricity's square.
  const double p = std::sqrt(x * x + y * y);
  double latitude = atan2(z, p * (1.0 - kEccentricity2));
  for (int step = 0; step < 8; ++step) {
    const double s = sin(latitude);
    latitude = atan2(z + kEccentricity2 * vertical_radius_m(s) * s, p);
  }
  const double s = sin(latitude), c = cos(latitude);
  return {latitude, atan2(y, x),
          p * c + z * s - kSemiMajor_m * std::sqrt(1.0 - kEccentricity2 * s * s)};
}

}  // namespace swell::apps
