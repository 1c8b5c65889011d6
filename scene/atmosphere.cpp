#include "scene/atmosphere.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "math/earth.h"
#include "math/elementary.h"
#include "math/smoothstep.h"

namespace swell::scene {
namespace {

constexpr double kSeaAlbedo = 0.08;
constexpr double kTop_m = kEarthRadius_m + kAirTop_m;

glm::dvec3 exp_each(glm::dvec3 x) { return {exp(x.x), exp(x.y), exp(x.z)}; }

// ---- Tables

// Where a table is read: between entries `first` and the next.
struct Between {
  int first = 0;
  float part = 0.0f;
};

Between between(double place, int count) {
  const double x = std::clamp(place, 0.0, count - 1.000001);
  const int first = static_cast<int>(x);
  return {first, static_cast<float>(x - first)};
}

glm::vec3 interpolate(const std::vector<glm::vec3>& table, int columns, Between row,
                      Between column) {
  const glm::vec3* p =
      table.data() + static_cast<std::ptrdiff_t>(row.first) * columns + column.first;
  const glm::vec3 low = p[0] + column.part * (p[1] - p[0]);
  p += columns;
  const glm::vec3 high = p[0] + column.part * (p[1] - p[0]);
  return low + row.part * (high - low);
}

// The transmittance: rows by height, columns by the distance to the air's top.
// Source: Bruneton, Neyret 2008, section 4.
constexpr int kHeights = 40, kDistances = 128;
const double kHorizonAtTop_m = std::sqrt(kTop_m * kTop_m - kEarthRadius_m * kEarthRadius_m);

double horizon_distance_m(double radius_m) {
  return std::sqrt(std::max(radius_m * radius_m - kEarthRadius_m * kEarthRadius_m, 0.0));
}

Between height_row(double height_m) {
  const double horizon_m = horizon_distance_m(kEarthRadius_m + height_m);
  return between(horizon_m / kHorizonAtTop_m * (kHeights - 1), kHeights);
}

// Light of optical depth up to the air's top, for a ray that misses the earth.
glm::dvec3 transmittance_to_top(const Air& air, double radius_m, double sine) {
  constexpr int kSteps = 60;
  const double length_m = distance_to_air_top_m(radius_m, sine);
  glm::dvec3 depth(0.0);
  for (int i = 0; i < kSteps; ++i) {
    // Steps that grow from the start, where air is densest or the ray lowest.
    const double begin = double(i) / kSteps, end = double(i + 1) / kSteps;
    const double t = 0.5 * (begin * begin + end * end), dt = end * end - begin * begin;
    depth +=
        air_light(air, height_along(radius_m, sine, t * length_m)).lost_per_m * (dt * length_m);
  }
  return exp_each(-depth);
}

void fill_transmittance(Atmosphere& atmosphere, Workers& workers) {
  atmosphere.transmittance.resize(static_cast<std::size_t>(kHeights) * kDistances);
  workers.for_each(kHeights, [&](std::size_t row, int) {
    const double horizon_m = kHorizonAtTop_m * static_cast<double>(row) / (kHeights - 1);
    const double radius_m = std::sqrt(horizon_m * horizon_m + kEarthRadius_m * kEarthRadius_m);
    const double nearest_m = kTop_m - radius_m, furthest_m = horizon_m + kHorizonAtTop_m;
    for (int column = 0; column < kDistances; ++column) {
      const double d =
          std::max(nearest_m + (furthest_m - nearest_m) * column / (kDistances - 1), 1e-3);
      const double sine = (kTop_m * kTop_m - radius_m * radius_m - d * d) / (2.0 * radius_m * d);
      atmosphere.transmittance[row * kDistances + static_cast<std::size_t>(column)] =
          transmittance_to_top(atmosphere.air, radius_m, std::clamp(sine, -1.0, 1.0));
    }
  });
}

// A height's row in the table of transmittance, and what else of the height a look-up needs.
struct HeightRow {
  Between row;
  double radius_m, nearest_m, inv_span_m, horizon_sine;
};

HeightRow height_row_of(double height_m) {
  const double radius_m = kEarthRadius_m + height_m, horizon_m = horizon_distance_m(radius_m);
  const double nearest_m = kTop_m - radius_m;
  return {height_row(height_m), radius_m, nearest_m,
          1.0 / (horizon_m + kHorizonAtTop_m - nearest_m), -horizon_m / radius_m};
}

// As transmittance(), without regard for the earth.
glm::vec3 transmittance_over_horizon(const Atmosphere& atmosphere, const HeightRow& at,
                                     double sine) {
  const double place =
      (distance_to_air_top_m(at.radius_m, sine) - at.nearest_m) * at.inv_span_m * (kDistances - 1);
  return interpolate(atmosphere.transmittance, kDistances, at.row, between(place, kDistances));
}

glm::vec3 disc_transmittance(const Atmosphere& atmosphere, const HeightRow& at, double sine) {
  const double seen = smoothstep(-kSunRadius_rad, kSunRadius_rad, sine - at.horizon_sine);
  if (seen <= 0.0) return glm::vec3(0.0f);
  return static_cast<float>(seen) *
         transmittance_over_horizon(atmosphere, at, std::max(sine, at.horizon_sine));
}

// Light scattered more than once: rows by height, columns by the sine of the light's elevation,
// finer about the horizon.
constexpr int kSourceHeights = 24, kLowSines = 30, kHighSines = 12;
constexpr int kSourceSines = kLowSines + kHighSines + 1;
constexpr double kLowestSine = -0.34, kMiddleSine = 0.17;

double source_height_m(int row) {
  const double x = static_cast<double>(row) / (kSourceHeights - 1);
  return kAirTop_m * x * x;
}

Between source_row(double height_m) {
  return between(std::sqrt(std::max(height_m, 0.0) / kAirTop_m) * (kSourceHeights - 1),
                 kSourceHeights);
}

double source_sine(int column) {
  if (column < kLowSines) return kLowestSine + (kMiddleSine - kLowestSine) * column / kLowSines;
  return kMiddleSine + (1.0 - kMiddleSine) * (column - kLowSines) / kHighSines;
}

Between source_column(double sine) {
  return between(sine < kMiddleSine
                     ? (sine - kLowestSine) * (kLowSines / (kMiddleSine - kLowestSine))
                     : kLowSines + (sine - kMiddleSine) * (kHighSines / (1.0 - kMiddleSine)),
                 kSourceSines);
}

// ---- A ray through the air

// A piece of a ray: what of the light that is scattered on it arrives at the ray's start.
struct Step {
  HeightRow height;
  Between source;    // its row in the table of sources
  double up, ahead;  // its zenith, in the start's: along the zenith, and along the ray's azimuth
  glm::vec3 rayleigh, mie;  // times the light there
};

struct Path {
  std::vector<Step> steps;
  bool meets_sea = false;
  glm::dvec3 left{1.0};  // what of light from its end arrives
  glm::vec3 sea{0.0f};   // the same of light that falls on the sea
  double sea_up = 1.0, sea_ahead = 0.0;
};

Path trace(const Air& air, double height_m, double sine, int step_count) {
  const double radius_m = kEarthRadius_m + height_m;
  const double cosine = std::sqrt(std::max(1.0 - sine * sine, 0.0));
  Path path;
  const std::optional<double> sea_m = distance_to_sea_m(radius_m, sine);
  path.meets_sea = sea_m.has_value();
  const double length_m = sea_m ? *sea_m : distance_to_air_top_m(radius_m, sine);
  glm::dvec3 left(1.0);
  for (int i = 0; i < step_count; ++i) {
    const double begin = double(i) / step_count, end = double(i + 1) / step_count;
    const double t_m = 0.5 * (begin * begin + end * end) * length_m;
    const double dt_m = (end * end - begin * begin) * length_m;
    const double h_m = std::max(height_along(radius_m, sine, t_m), 0.0);
    const AirLight here = air_light(air, h_m);
    const glm::dvec3 lost = glm::max(here.lost_per_m, 1e-12);
    const glm::dvec3 passes = exp_each(-lost * dt_m);
    const glm::dvec3 weight = left * (1.0 - passes) / lost;
    const double r_m = kEarthRadius_m + h_m;
    path.steps.push_back({height_row_of(h_m), source_row(h_m), (radius_m + t_m * sine) / r_m,
                          t_m * cosine / r_m, weight * here.rayleigh_per_m,
                          weight * here.mie_per_m});
    left *= passes;
  }
  path.left = left;
  path.sea = left * kSeaAlbedo;
  path.sea_up = (radius_m + length_m * sine) / kEarthRadius_m;
  path.sea_ahead = length_m * cosine / kEarthRadius_m;
  return path;
}

// The light's direction as a ray's start has it.
struct LightAngles {
  double up, ahead;  // sine of the elevation; the part along the ray's azimuth
};

struct Scattered {
  glm::vec3 rayleigh{0.0f}, mie{0.0f};  // once, but for the phase functions
};

Scattered scatter_once(const Atmosphere& atmosphere, const Path& path, LightAngles light) {
  Scattered sum;
  for (const Step& step : path.steps) {
    const double sine = light.up * step.up + light.ahead * step.ahead;
    const glm::vec3 arrives = disc_transmittance(atmosphere, step.height, sine);
    sum.rayleigh += step.rayleigh * arrives;
    sum.mie += step.mie * arrives;
  }
  return sum;
}

// `source`: mean radiance of the light to be scattered again.
glm::vec3 scatter_evenly(const std::vector<glm::vec3>& source, const Path& path,
                         LightAngles light) {
  glm::vec3 sum(0.0f);
  for (const Step& step : path.steps) {
    const double sine = light.up * step.up + light.ahead * step.ahead;
    if (sine < kLowestSine) continue;
    sum += (step.rayleigh + step.mie) *
           interpolate(source, kSourceSines, step.source, source_column(sine));
  }
  return sum;
}

// ---- Orders of scattering

// Directions about a point: their sines crowd about the horizon, where twilight is; azimuths of
// half a circle, from the light's.
constexpr int kSines = 12, kAzimuths = 5, kGatherSteps = 14;

struct Gather {
  std::vector<Path> paths;                  // kSines for each height
  std::array<double, kSines> sine, weight;  // of all directions: sum of the weights 1
  std::array<double, kAzimuths> cos_azimuth;
};

Gather make_gather(const Air& air, Workers& workers) {
  Gather gather;
  for (int i = 0; i < kSines; ++i) {
    const double x = -1.0 + (2.0 * i + 1.0) / kSines;
    gather.sine[i] = x * std::abs(x);
    gather.weight[i] = 2.0 * std::abs(x) / (kSines * kAzimuths);
  }
  for (int i = 0; i < kAzimuths; ++i)
    gather.cos_azimuth[i] = sin_cos_turns((i + 0.5) / (2.0 * kAzimuths)).cos;
  gather.paths.resize(static_cast<std::size_t>(kSourceHeights) * kSines);
  workers.for_each(kSourceHeights, [&](std::size_t row, int) {
    for (int i = 0; i < kSines; ++i)
      gather.paths[row * kSines + static_cast<std::size_t>(i)] =
          trace(air, source_height_m(static_cast<int>(row)), gather.sine[i], kGatherSteps);
  });
  return gather;
}

// Calls add(weight, path, light, cos_theta) for the directions about a point of the table.
template <class Add>
void for_each_direction(const Gather& gather, std::size_t row, double sine, const Add& add) {
  const double cosine = std::sqrt(std::max(1.0 - sine * sine, 0.0));
  for (std::size_t i = 0; i < kSines; ++i) {
    const double ray_cosine = std::sqrt(1.0 - gather.sine[i] * gather.sine[i]);
    for (const double cos_azimuth : gather.cos_azimuth) {
      const LightAngles light{sine, cosine * cos_azimuth};
      add(static_cast<float>(gather.weight[i]), gather.paths[row * kSines + i], light,
          sine * gather.sine[i] + light.ahead * ray_cosine);
    }
  }
}

template <class LightOf>
std::vector<glm::vec3> gather_light(const Gather& gather, const LightOf& light_of,
                                    Workers& workers) {
  std::vector<glm::vec3> mean(static_cast<std::size_t>(kSourceHeights) * kSourceSines);
  workers.for_each(kSourceHeights, [&](std::size_t row, int) {
    for (int column = 0; column < kSourceSines; ++column) {
      glm::vec3& sum = mean[row * kSourceSines + static_cast<std::size_t>(column)];
      for_each_direction(gather, row, source_sine(column),
                         [&](float weight, const Path& path, LightAngles light, double cos_theta) {
                           sum += weight * light_of(path, light, cos_theta);
                         });
    }
  });
  return mean;
}

// Mean radiance at each point of light that was scattered once, or that the sea throws back.
std::vector<glm::vec3> gather_first(const Atmosphere& atmosphere, const Gather& gather,
                                    Workers& workers) {
  const HeightRow sea = height_row_of(0.0);
  return gather_light(
      gather,
      [&](const Path& path, LightAngles light, double cos_theta) {
        const Scattered once = scatter_once(atmosphere, path, light);
        glm::vec3 sum = static_cast<float>(rayleigh_phase(cos_theta)) * once.rayleigh +
                        static_cast<float>(mie_phase(cos_theta)) * once.mie;
        const double sine = light.up * path.sea_up + light.ahead * path.sea_ahead;
        if (path.meets_sea && sine > 0.0)
          sum +=
              static_cast<float>(sine / kPi) * path.sea * disc_transmittance(atmosphere, sea, sine);
        return sum;
      },
      workers);
}

// The same of what was scattered once more than `source`.
std::vector<glm::vec3> gather_again(const std::vector<glm::vec3>& source, const Gather& gather,
                                    Workers& workers) {
  return gather_light(
      gather,
      [&](const Path& path, LightAngles light, double) {
        glm::vec3 sum = scatter_evenly(source, path, light);
        const double sine = light.up * path.sea_up + light.ahead * path.sea_ahead;
        if (path.meets_sea)
          sum += path.sea * interpolate(source, kSourceSines, {}, source_column(sine));
        return sum;
      },
      workers);
}

// Three orders one by one; those after them shrink as the third did against the second.
void fill_multiple(Atmosphere& atmosphere, Workers& workers) {
  const Gather gather = make_gather(atmosphere.air, workers);
  const std::vector<glm::vec3> first = gather_first(atmosphere, gather, workers);
  const std::vector<glm::vec3> second = gather_again(first, gather, workers);
  const std::vector<glm::vec3> third = gather_again(second, gather, workers);
  for (std::size_t i = 0; i < first.size(); ++i) {
    const glm::vec3 ratio =
        glm::clamp(third[i] / glm::max(second[i], glm::vec3(1e-30f)), 0.0f, 0.9f);
    atmosphere.multiple.push_back(first[i] + second[i] + third[i] / (1.0f - ratio));
  }
}

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
    const glm::vec3 divisor = divisor_of(path);
    for (int column = 0; column < kColumns; ++column) {
      const double half_sine = static_cast<double>(column) / (kColumns - 1);
      const LightAngles angles{to_light.z, cosine * (1.0 - 2.0 * half_sine * half_sine)};
      const std::size_t i = row * kColumns + static_cast<std::size_t>(column);
      const Scattered once = scatter_once(atmosphere, path, angles);
      light.rayleigh[i] = once.rayleigh / divisor;
      light.mie[i] = once.mie / divisor;
      light.multiple[i] = scatter_evenly(atmosphere.multiple, path, angles) / divisor;
    }
  });
  return light;
}

}  // namespace

Atmosphere make_atmosphere(double turbidity, Workers& workers) {
  Atmosphere atmosphere;
  atmosphere.air = make_air(turbidity);
  fill_transmittance(atmosphere, workers);
  fill_multiple(atmosphere, workers);
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
  const double tangent = std::sqrt(2.0 * height_m / swell::kEarthRadius_m);
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
             interpolate(scattered.rayleigh, kColumns, row, column) +
         static_cast<float>(mie_phase(cos_theta)) *
             interpolate(scattered.mie, kColumns, row, column) +
         interpolate(scattered.multiple, kColumns, row, column);
}

}  // namespace swell::scene
