#include "sky/atmosphere.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "math/earth.h"
#include "math/elementary.h"
#include "sky/air_paths.h"
#include "sky/scattered_light.h"

namespace swell::sky {
namespace {

// ---- The sky that an eye sees

constexpr int kRows = 64, kRowsBelow = 24, kColumns = 49, kViewSteps = 32;
constexpr double kSeaLevelEye_m = 2.0;
constexpr double kOffHorizon = 1e-6;  // where a ray surely meets the sea, or misses it

// The sine at which the straight rays of the tables meet the horizon.
double straight_horizon_sine(double height_m) {
  return height_m > 0.0 ? height_row_of(height_m).horizon_sine : 0.0;
}

// `part` of the way from the horizon to the zenith.
double straight_sine(double horizon_sine, double part) {
  return std::max(horizon_sine + (1.0 - horizon_sine) * part, horizon_sine + kOffHorizon);
}

// The rows of a table: paths at path_of(part), whose light is divided by divisor_of(path).
template <class PathOf, class DivisorOf>
ScatteredLight scatter_rows(const Atmosphere& atmosphere, glm::dvec3 to_light, int rows,
                            Workers& workers, const PathOf& path_of, const DivisorOf& divisor_of) {
  ScatteredLight light;
  const double cosine = std::sqrt(std::max(1.0 - to_light.z * to_light.z, 0.0));
  for (std::vector<glm::vec3>* part : {&light.rayleigh, &light.mie, &light.multiple})
    part->resize(static_cast<std::size_t>(rows) * kColumns);
  workers.for_each(static_cast<std::size_t>(rows), [&](std::size_t row, int) {
    const double x = static_cast<double>(row) / (rows - 1);
    const Path path = path_of(x * x);
    const PathSources sources = sources_along(atmosphere, path, to_light.z);
    const glm::vec3 divisor = divisor_of(path);
    for (int column = 0; column < kColumns; ++column) {
      const double half_sine = static_cast<double>(column) / (kColumns - 1);
      const double cos_azimuth = 1.0 - 2.0 * half_sine * half_sine;
      const LightAngles angles{to_light.z, cosine * cos_azimuth};
      const std::size_t i = row * kColumns + static_cast<std::size_t>(column);
      const Scattered once = scatter_once(atmosphere, path, angles);
      light.rayleigh[i] = once.rayleigh / divisor;
      light.mie[i] = once.mie / divisor;
      light.multiple[i] = scatter_light_again(sources, cos_azimuth, path, angles) / divisor;
    }
  });
  return light;
}

}  // namespace

Atmosphere make_atmosphere(double turbidity, Workers& workers) {
  Atmosphere atmosphere;
  atmosphere.air = make_air(turbidity);
  fill_transmittance(atmosphere, workers);
  fill_scattered_light(atmosphere, workers);
  return atmosphere;
}

glm::vec3 transmittance(const Atmosphere& atmosphere, double height_m, double sin_elevation) {
  const HeightRow at = height_row_of(height_m);
  if (sin_elevation < at.horizon_sine) return glm::vec3(0.0f);
  return transmittance_over_horizon(atmosphere, at, sin_elevation);
}

glm::vec3 disc_transmittance(const Atmosphere& atmosphere, double height_m, double sin_elevation) {
  return disc_transmittance(atmosphere, height_row_of(height_m), sin_elevation);
}

glm::vec3 whole_disc_transmittance(const Atmosphere& atmosphere, double height_m, double sine) {
  const double seen = horizon_sine(height_m), straight = straight_horizon_sine(height_m);
  const double part = std::max((sine - seen) / (1.0 - seen), 0.0);
  return disc_transmittance(atmosphere, height_m,
                            std::max(straight_sine(straight, part), straight + kSunRadius_rad));
}

double horizon_sine(double height_m) {
  const double tangent = std::sqrt(2.0 * height_m / kEffectiveEarthRadius_m);
  return -tangent / std::sqrt(1.0 + tangent * tangent);
}

SkyTable make_sky_table(const Atmosphere& atmosphere, glm::dvec3 to_light, double height_m,
                        Workers& workers) {
  const double eye_m = height_m > 0.0 ? height_m : kSeaLevelEye_m;
  const double straight = straight_horizon_sine(height_m);
  SkyTable table{to_light, horizon_sine(height_m), {}, {}};
  table.sky = scatter_rows(
      atmosphere, to_light, kRows, workers,
      [&](double part) {
        return trace(atmosphere.air, eye_m, straight_sine(straight, part), kViewSteps);
      },
      [](const Path&) { return glm::vec3(1.0f); });
  if (height_m > 0.0)
    table.below = scatter_rows(
        atmosphere, to_light, kRowsBelow, workers,
        [&](double part) {
          const double sine = straight - kOffHorizon - (1.0 + straight - kOffHorizon) * part;
          return trace(atmosphere.air, eye_m, sine, kViewSteps);
        },
        [](const Path& path) { return glm::vec3(1.0 - path.left); });
  return table;
}

glm::vec3 sky_radiance(const SkyTable& table, glm::dvec3 direction) {
  const glm::dvec3& light = table.to_light;
  const double across = std::sqrt((direction.x * direction.x + direction.y * direction.y) *
                                  (light.x * light.x + light.y * light.y));
  const double cos_azimuth =
      across > 1e-12
          ? std::clamp((direction.x * light.x + direction.y * light.y) / across, -1.0, 1.0)
          : 1.0;
  const double horizon = table.horizon_sine, over = direction.z - horizon;
  const bool is_below = over < 0.0 && !table.below.rayleigh.empty();
  const ScatteredLight& scattered = is_below ? table.below : table.sky;
  const int rows = is_below ? kRowsBelow : kRows;
  const double part = is_below ? -over / (1.0 + horizon) : std::max(over, 0.0) / (1.0 - horizon);
  const Between row = between(std::sqrt(part) * (rows - 1), rows);
  const Between column = between(std::sqrt(0.5 * (1.0 - cos_azimuth)) * (kColumns - 1), kColumns);
  const double cos_theta = glm::dot(direction, light);
  return static_cast<float>(rayleigh_phase(cos_theta)) *
             interpolate(scattered.rayleigh.data(), kColumns, row, column) +
         static_cast<float>(mie_phase(cos_theta)) *
             interpolate(scattered.mie.data(), kColumns, row, column) +
         interpolate(scattered.multiple.data(), kColumns, row, column);
}

}  // namespace swell::sky
