#include "sky/round_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "math/elementary.h"
#include "sky/add_parts.h"
#include "sky/light_moments.h"

namespace swell::sky {
namespace {

// Directions about a place: elevations crowd about the horizon, where haze and twilight are;
// azimuths of half a circle, from the light's.
constexpr int kElevations = 12, kAzimuths = 8;
constexpr int kDirections = kElevations * kAzimuths, kCircle = 2 * kAzimuths, kGatherSteps = 14;
constexpr int kSamples = 4;  // of a cell, along each of its sides

// Rays start from every second height.
constexpr int kGathered = (kSourceHeights + 1) / 2, kGatheredHaze = (kHazeHeights + 1) / 2;
constexpr int kGatheredPoints = kGathered * kRoundSines;
static_assert(kSourceHeights % 2 == 1 && kHazeHeights % 2 == 1);

constexpr int kGatheredOrders = 5;  // that are gathered

// ---- Directions

// Where elevation i begins; its middle lies at i + 0.5.
double sine_of_elevation(double i) {
  const double x = -1.0 + 2.0 * i / kElevations;
  return sin(0.5 * kPi * x * std::abs(x));
}

// The sphere in cells, by elevation and by azimuth around the whole circle.
using Cells = std::array<float, static_cast<std::size_t>(kElevations* kCircle)>;

// The part of light from a direction that haze scatters into each cell; their sum is 1. The peak
// of the phase function is narrower than a cell, which is why it is integrated.
template <class Phase>
Cells scatter_into_cells(double sine, double azimuth_turns, const Phase& phase) {
  Cells cells;
  double sum = 0.0;
  for (int i = 0; i < kElevations; ++i)
    for (int k = 0; k < kCircle; ++k) {
      double part = 0.0;
      for (int a = 0; a < kSamples; ++a) {
        const double low = sine_of_elevation(i + double(a) / kSamples);
        const double high = sine_of_elevation(i + double(a + 1) / kSamples);
        const double z = sine_of_elevation(i + (a + 0.5) / kSamples);
        for (int b = 0; b < kSamples; ++b) {
          const double turns = (k + (b + 0.5) / kSamples) / kCircle - azimuth_turns;
          const double cos_theta =
              sine * z + cosine_of(sine) * cosine_of(z) * sin_cos_turns(turns).cos;
          part += (high - low) * phase(std::min(cos_theta, 1.0));
        }
      }
      cells[static_cast<std::size_t>(i * kCircle + k)] = static_cast<float>(part);
      sum += part;
    }
  for (float& cell : cells) cell /= static_cast<float>(sum);
  return cells;
}

struct Directions {
  std::vector<Path> paths;               // kElevations for each height
  std::array<double, kElevations> sine;  // at the cells' middles
  std::array<float, kElevations> part;   // of the sphere, that one azimuth and its mirror have
  std::array<double, kAzimuths> cos_azimuth;
  std::vector<float> sun_phase;  // mean of a cell: by direction and sine of the light's elevation
  std::vector<float> haze_part;  // of light from a direction (columns) into another (rows)
};

void fill_phases(Workers& workers, Directions& all) {
  all.sun_phase.resize(std::size_t{kDirections} * kRoundSines);
  workers.for_each(kRoundSines, [&](std::size_t column, int) {
    const double sine = source_sine(static_cast<int>(column));
    const Cells once = scatter_into_cells(sine, 0.0, mie_phase);
    for (std::size_t i = 0; i < kElevations; ++i)
      for (std::size_t k = 0; k < kAzimuths; ++k) {
        const std::size_t at = (i * kAzimuths + k) * kRoundSines + column;
        const float solid_angle = static_cast<float>(2.0 * kPi) * all.part[i];
        all.sun_phase[at] = once[i * kCircle + k] / solid_angle;
      }
  });
  all.haze_part.resize(std::size_t{kDirections} * kDirections);
  workers.for_each(kElevations, [&](std::size_t to, int) {
    const Cells cells = scatter_into_cells(all.sine[to], 0.5 / kCircle, mie_phase);
    for (int to_azimuth = 0; to_azimuth < kAzimuths; ++to_azimuth)
      for (int i = 0; i < kElevations; ++i)
        for (int k = 0; k < kAzimuths; ++k) {
          const int here = (k - to_azimuth + kCircle) % kCircle;
          const int mirrored = (2 * kCircle - 1 - k - to_azimuth) % kCircle;
          const std::size_t row = to * kAzimuths + static_cast<std::size_t>(to_azimuth);
          all.haze_part[row * kDirections + static_cast<std::size_t>(i * kAzimuths + k)] =
              cells[static_cast<std::size_t>(i * kCircle + here)] +
              cells[static_cast<std::size_t>(i * kCircle + mirrored)];
        }
  });
}

Directions make_directions(const Air& air, Workers& workers) {
  Directions all;
  for (int i = 0; i < kElevations; ++i) {
    all.sine[i] = sine_of_elevation(i + 0.5);
    all.part[i] =
        static_cast<float>((sine_of_elevation(i + 1) - sine_of_elevation(i)) / (2.0 * kAzimuths));
  }
  for (int k = 0; k < kAzimuths; ++k) all.cos_azimuth[k] = sin_cos_turns((k + 0.5) / kCircle).cos;
  all.paths.resize(std::size_t{kGathered} * kElevations);
  workers.for_each(kGathered, [&](std::size_t row, int) {
    for (std::size_t i = 0; i < kElevations; ++i)
      all.paths[row * kElevations + i] =
          trace(air, source_height_m(2 * static_cast<int>(row)), all.sine[i], kGatherSteps);
  });
  fill_phases(workers, all);
  return all;
}

// ---- Orders of scattering

// Means of the light at each height and sine of the light's elevation.
struct Means {
  std::vector<glm::vec3> all;   // over all directions
  std::vector<glm::vec3> haze;  // as haze scatters it into each direction
};

// A ray of one direction and height, in light of one elevation.
struct Ray {
  const Path& path;
  LightAngles light;
  std::size_t direction, column;
};

// By direction, gathered height and sine of the light's elevation.
using Radiance = std::vector<glm::vec3>;

// Heights between those gathered, and elevations beyond.
void fill_rest(glm::vec3* rows, int heights) {
  for (int row = 1; row < heights; row += 2)
    for (int column = 0; column < kRoundSines; ++column) {
      glm::vec3* at = rows + row * kSourceSines + column;
      *at = 0.5f * (at[-kSourceSines] + at[kSourceSines]);
    }
  for (int row = 0; row < heights; ++row)
    for (int column = kRoundSines; column < kSourceSines; ++column)
      rows[row * kSourceSines + column] = rows[row * kSourceSines + kRoundSines - 1];
}

// radiance_of(ray) of all rays.
template <class RadianceOf>
Radiance gather(const Directions& directions, const RadianceOf& radiance_of, Workers& workers) {
  Radiance radiance(std::size_t{kDirections} * kGatheredPoints);
  workers.for_each(kDirections, [&](std::size_t d, int) {
    glm::vec3* out = radiance.data() + d * kGatheredPoints;
    for (std::size_t row = 0; row < kGathered; ++row) {
      const Path& path = directions.paths[row * kElevations + d / kAzimuths];
      for (int column = 0; column < kRoundSines; ++column) {
        const double sine = source_sine(column);
        const LightAngles light{sine, cosine_of(sine) * directions.cos_azimuth[d % kAzimuths]};
        *out++ = radiance_of(Ray{path, light, d, static_cast<std::size_t>(column)});
      }
    }
  });
  return radiance;
}

using DirectionParts = std::array<float, kDirections>;

// Sums so many gathered rows of the light of all directions.
void sum_directions(std::span<const float, kDirections> parts, const Radiance& radiance,
                    std::size_t rows, glm::vec3* to) {
  for (std::size_t row = 0; row < rows; ++row)
    add_parts(parts, radiance.data() + row * kRoundSines, kGatheredPoints, kRoundSines,
              to + 2 * row * kSourceSines);
}

std::vector<glm::vec3> mean_of(const Directions& directions, const Radiance& radiance) {
  std::vector<glm::vec3> mean(kPoints);
  DirectionParts parts;
  for (std::size_t d = 0; d < kDirections; ++d) parts[d] = directions.part[d / kAzimuths];
  sum_directions(parts, radiance, kGathered, mean.data());
  fill_rest(mean.data(), kSourceHeights);
  return mean;
}

Means means_of(const Directions& directions, const Radiance& radiance, Workers& workers) {
  Means means{mean_of(directions, radiance), {}};
  means.haze.resize(std::size_t{kDirections} * kHazePoints);
  workers.for_each(kDirections, [&](std::size_t to, int) {
    glm::vec3* sum = means.haze.data() + to * kHazePoints;
    const std::span<const float> parts = directions.haze_part;
    sum_directions(parts.subspan(to * kDirections).first<kDirections>(), radiance, kGatheredHaze,
                   sum);
    fill_rest(sum, kHazeHeights);
  });
  return means;
}

// Gathers light that was scattered once, or that the sea throws back.
Radiance gather_first(const Atmosphere& atmosphere, const Directions& directions,
                      Workers& workers) {
  const HeightRow sea = height_row_of(0.0);
  return gather(
      directions,
      [&](const Ray& ray) {
        const auto& [path, light, direction, column] = ray;
        const double cos_theta = light.up * path.sine + light.ahead * cosine_of(path.sine);
        const Scattered once = scatter_once(atmosphere, path, light);
        glm::vec3 sum = static_cast<float>(rayleigh_phase(cos_theta)) * once.rayleigh +
                        directions.sun_phase[direction * kRoundSines + column] * once.mie;
        const double sine = light.up * path.sea_up + light.ahead * path.sea_ahead;
        if (path.meets_sea && sine > 0.0)
          sum +=
              static_cast<float>(sine / kPi) * path.sea * disc_transmittance(atmosphere, sea, sine);
        return sum;
      },
      workers);
}

// Gathers light that was scattered once more than `source`.
Radiance gather_again(const Means& source, const Directions& directions, Workers& workers) {
  return gather(
      directions,
      [&](const Ray& ray) {
        const auto& [path, light, direction, column] = ray;
        const glm::vec3* haze = source.haze.data() + direction * kHazePoints;
        glm::vec3 sum = scatter_again(source.all.data(), haze, path, light);
        const double sine = light.up * path.sea_up + light.ahead * path.sea_ahead;
        if (path.meets_sea)
          sum += path.sea * interpolate(source.all.data(), kSourceSines, {}, source_column(sine));
        return sum;
      },
      workers);
}

void add_later_orders(const Radiance& before, const Radiance& last, Radiance& sum) {
  for (std::size_t i = 0; i < sum.size(); ++i)
    for (int c = 0; c < 3; ++c) sum[i][c] += last[i][c] * later_orders(before[i][c], last[i][c]);
}

// ---- Moments

// The integrals over the cells of the functions that light_moments.h makes light of, over their
// norms, in both halves of the circle.
std::vector<Harmonics> cell_moments() {
  std::vector<Harmonics> all(kDirections, Harmonics{});
  for (int i = 0; i < kElevations; ++i) {
    Harmonics ring{};
    for (int a = 0; a < kSamples; ++a) {
      const double low = sine_of_elevation(i + double(a) / kSamples);
      const double high = sine_of_elevation(i + double(a + 1) / kSamples);
      const Harmonics at = harmonics(sine_of_elevation(i + (a + 0.5) / kSamples));
      for (std::size_t n = 0; n < kMoments; ++n) ring[n] += static_cast<float>(high - low) * at[n];
    }
    for (int k = 0; k < kAzimuths; ++k)
      for (int m = 0; m < kModes; ++m) {
        const auto sine_at = [&](int edge) {
          return sin_cos_turns(double(m * edge) / kCircle).sin;
        };
        const double across = m == 0 ? 2.0 * kPi / kCircle : (sine_at(k + 1) - sine_at(k)) / m;
        const auto part = static_cast<float>(2.0 * mode_norm(m) * across);
        for (int l = m; l < kDegrees; ++l) {
          const auto n = static_cast<std::size_t>(moment_index(l, m));
          all[static_cast<std::size_t>(i * kAzimuths + k)][n] = part * ring[n];
        }
      }
  }
  return all;
}

// The parts of directions in moment n, times what a phase function makes of it.
DirectionParts parts_in_moment(const std::vector<Harmonics>& cells, int n, double phase) {
  DirectionParts parts;
  for (std::size_t d = 0; d < kDirections; ++d)
    parts[d] = static_cast<float>(phase) * cells[d][static_cast<std::size_t>(n)];
  return parts;
}

// Returns what molecules make of the moments (2, m).
std::vector<glm::vec3> uneven_moments(const std::vector<Harmonics>& cells,
                                      const Radiance& radiance) {
  std::vector<glm::vec3> all(std::size_t{kRayleighModes} * kPoints);
  for (int m = 0; m < kRayleighModes; ++m) {
    glm::vec3* const uneven = all.data() + std::size_t{kPoints} * m;
    sum_directions(parts_in_moment(cells, moment_index(2, m), rayleigh_moment(2)), radiance,
                   kGathered, uneven);
    fill_rest(uneven, kSourceHeights);
  }
  return all;
}

std::vector<glm::vec3> haze_moments(const std::vector<Harmonics>& cells, const Radiance& radiance,
                                    Workers& workers) {
  std::vector<glm::vec3> haze(std::size_t{kMoments} * kHazePoints);
  workers.for_each(kModes, [&](std::size_t mode, int) {
    const int m = static_cast<int>(mode);
    for (int l = m; l < kDegrees; ++l) {
      const int n = moment_index(l, m);
      glm::vec3* const moment = haze.data() + static_cast<std::ptrdiff_t>(n) * kHazePoints;
      sum_directions(parts_in_moment(cells, n, mie_moment(l)), radiance, kGatheredHaze, moment);
      fill_rest(moment, kHazeHeights);
    }
  });
  return haze;
}

}  // namespace

RoundLight scatter_on_round_earth(const Atmosphere& atmosphere, Workers& workers) {
  const Directions directions = make_directions(atmosphere.air, workers);
  Radiance last = gather_first(atmosphere, directions, workers), sum = last, before;
  for (int order = 2; order <= kGatheredOrders; ++order) {
    before = std::move(last);
    last = gather_again(means_of(directions, before, workers), directions, workers);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += last[i];
  }
  add_later_orders(before, last, sum);
  const std::vector<Harmonics> cells = cell_moments();
  return {mean_of(directions, sum), uneven_moments(cells, sum), haze_moments(cells, sum, workers)};
}

}  // namespace swell::sky
