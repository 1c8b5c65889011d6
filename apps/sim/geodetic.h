// Places of a flat map on WGS 84's ellipsoid.
#pragma once

#include <glm/glm.hpp>

namespace swell::apps {

struct Geodetic {
  double latitude_rad = 0.0, longitude_rad = 0.0;  // north and east positive
  double altitude_m = 0.0;                         // over the ellipsoid
};

// Where a point (east, north, up) in metres lies whose axes touch the ellipsoid at the origin (over
// it, at its altitude): to 1e-8 m within 1000 km of it.
Geodetic geodetic_of(const Geodetic& origin, const glm::dvec3& enu_m);

}  // namespace swell::apps
