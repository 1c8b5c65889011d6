#include "render/measure/lidar_echo.h"

#include <algorithm>

#include "math/elementary.h"

namespace swell::render {

double unresolved_slope(double wind_speed_mps, double resolved) {
  return std::max(0.003 + 0.00512 * wind_speed_mps - resolved, 0.001);
}

double clear_water_echo(glm::dvec3 along, glm::dvec2 slope, double unresolved) {
  const double cosine = -along.z;
  if (cosine < 0.01) return 0.0;
  const glm::dvec2 square = glm::dvec2(along) / cosine;  // slopes of facets square to the beam
  const glm::dvec2 aside = square - slope;
  const double density = exp(-glm::dot(aside, aside) / unresolved) / (kPi * unresolved);
  const double cosine2 = cosine * cosine;
  return std::min(0.25 * kPi * kWaterMirror * density / (cosine2 * cosine2 * cosine), 1.0);
}

double water_echo(double clear, double foam, double cos_incidence) {
  return (1.0 - foam) * clear + foam * kFoamReflectance * cos_incidence;
}

bool is_detected(double echo, double range_m, double reach_m, double gaussian) {
  if (reach_m == 0.0) return true;
  constexpr double kDarkEcho = 0.1, kVariation = 0.1;
  const double share = reach_m / std::max(range_m, 1e-3);
  return echo / kDarkEcho * share * share * (1.0 + kVariation * gaussian) >= 1.0;
}

}  // namespace swell::render
