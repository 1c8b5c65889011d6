#include "scene/scattered_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "math/elementary.h"

namespace swell::scene {
namespace {

constexpr int kDirections = kElevations * kAzimuths, kCircle = 2 * kAzimuths, kGatherSteps = 14;
constexpr int kPoints = kSourceHeights * kSourceSines, kHazePoints = kHazeHeights * kSourceSines;
constexpr int kSamples = 4;  // of a cell, along each of its sides

constexpr int kOrders = 5;  // that are gathered; 14 differ by less than 1 %
constexpr float kMostRatio = 0.7f;

// ---- Directions

// Where elevation i begins; its middle lies at i + 0.5.
double sine_of_elevation(double i) {
  const double x = -1.0 + 2.0 * i / kElevations;
  return sin(0.5 * kPi * x * std::abs(x));
}

double cosine_of(double sine) { return std::sqrt(std::max(1.0 - sine * sine, 0.0)); }

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
  std::vector<float> repeated_sun_phase;  // the same of repeated_mie_phase()
  std::vector<float> haze_part;           // of light from a direction (columns) into another (rows)
};

void fill_phases(Workers& workers, Directions& all) {
  all.sun_phase.resize(std::size_t{kDirections} * kSourceSines);
  all.repeated_sun_phase.resize(std::size_t{kDirections} * kSourceSines);
  workers.for_each(kSourceSines, [&](std::size_t column, int) {
    const double sine = source_sine(static_cast<int>(column));
    const Cells once = scatter_into_cells(sine, 0.0, mie_phase);
    const Cells repeated = scatter_into_cells(sine, 0.0, repeated_mie_phase);
    for (std::size_t i = 0; i < kElevations; ++i)
      for (std::size_t k = 0; k < kAzimuths; ++k) {
        const std::size_t at = (i * kAzimuths + k) * kSourceSines + column;
        const float solid_angle = static_cast<float>(2.0 * kPi) * all.part[i];
        all.sun_phase[at] = once[i * kCircle + k] / solid_angle;
        all.repeated_sun_phase[at] = repeated[i * kCircle + k] / solid_angle;
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
  all.paths.resize(std::size_t{kSourceHeights} * kElevations);
  workers.for_each(kSourceHeights, [&](std::size_t row, int) {
    for (std::size_t i = 0; i < kElevations; ++i)
      all.paths[row * kElevations + i] =
          trace(air, source_height_m(static_cast<int>(row)), all.sine[i], kGatherSteps);
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

// radiance_of(ray) of all rays.
template <class RadianceOf>
Means gather(const Directions& directions, const RadianceOf& radiance_of, Workers& workers) {
  std::vector<glm::vec3> radiance(std::size_t{kDirections} * kPoints);
  workers.for_each(kDirections, [&](std::size_t d, int) {
    glm::vec3* out = radiance.data() + d * kPoints;
    for (std::size_t row = 0; row < kSourceHeights; ++row) {
      const Path& path = directions.paths[row * kElevations + d / kAzimuths];
      for (int column = 0; column < kSourceSines; ++column) {
        const double sine = source_sine(column);
        const LightAngles light{sine, cosine_of(sine) * directions.cos_azimuth[d % kAzimuths]};
        *out++ = radiance_of(Ray{path, light, d, static_cast<std::size_t>(column)});
      }
    }
  });

  Means means;
  means.all.resize(kPoints);
  for (std::size_t d = 0; d < kDirections; ++d)
    for (std::size_t i = 0; i < kPoints; ++i)
      means.all[i] += directions.part[d / kAzimuths] * radiance[d * kPoints + i];
  means.haze.resize(std::size_t{kDirections} * kHazePoints);
  workers.for_each(kDirections, [&](std::size_t to, int) {
    glm::vec3* sum = means.haze.data() + to * kHazePoints;
    for (std::size_t from = 0; from < kDirections; ++from) {
      const float part = directions.haze_part[to * kDirections + from];
      const glm::vec3* in = radiance.data() + from * kPoints;
      for (std::size_t i = 0; i < kHazePoints; ++i) sum[i] += part * in[i];
    }
  });
  return means;
}

// Of light that was scattered once, or that the sea throws back.
Means gather_first(const Atmosphere& atmosphere, const Directions& directions, Workers& workers) {
  const HeightRow sea = height_row_of(0.0);
  return gather(
      directions,
      [&](const Ray& ray) {
        const auto& [path, light, direction, column] = ray;
        const double cos_theta = light.up * path.sine + light.ahead * cosine_of(path.sine);
        const Scattered once = scatter_once(atmosphere, path, light);
        glm::vec3 sum = static_cast<float>(rayleigh_phase(cos_theta)) * once.rayleigh +
                        directions.sun_phase[direction * kSourceSines + column] * once.mie;
        const double sine = light.up * path.sea_up + light.ahead * path.sea_ahead;
        if (path.meets_sea && sine > 0.0)
          sum +=
              static_cast<float>(sine / kPi) * path.sea * disc_transmittance(atmosphere, sea, sine);
        return sum;
      },
      workers);
}

// The same of what was scattered once more than `source`.
Means gather_again(const Means& source, const Directions& directions, Workers& workers) {
  return gather(
      directions,
      [&](const Ray& ray) {
        const auto& [path, light, direction, column] = ray;
        const glm::vec3* haze = source.haze.data() + direction * kHazePoints;
        glm::vec3 sum = scatter_again(
            source.all,
            [&](Between row, Between at) { return interpolate(haze, kSourceSines, row, at); }, path,
            light);
        const double sine = light.up * path.sea_up + light.ahead * path.sea_ahead;
        if (path.meets_sea)
          sum += path.sea * interpolate(source.all.data(), kSourceSines, {}, source_column(sine));
        return sum;
      },
      workers);
}

void add(const std::vector<glm::vec3>& more, std::vector<glm::vec3>& sum) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += more[i];
}

// Orders after the last shrink as it did. In thick haze the first few may grow, which says nothing
// of those that follow.
void add_later_orders(const std::vector<glm::vec3>& before, const std::vector<glm::vec3>& last,
                      std::vector<glm::vec3>& sum) {
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const glm::vec3 ratio =
        glm::clamp(last[i] / glm::max(before[i], glm::vec3(1e-30f)), 0.0f, kMostRatio);
    sum[i] += last[i] * ratio / (1.0f - ratio);
  }
}

// Catmull and Rom's weights of the entries -1, 0, 1 and 2 at t in [0, 1].
std::array<float, 4> cubic_weights(float t) {
  const float t2 = t * t, t3 = t2 * t;
  return {0.5f * (-t3 + 2.0f * t2 - t), 0.5f * (3.0f * t3 - 5.0f * t2 + 2.0f),
          0.5f * (-3.0f * t3 + 4.0f * t2 + t), 0.5f * (t3 - t2)};
}

}  // namespace

void fill_scattered_light(Atmosphere& atmosphere, Workers& workers) {
  const Directions directions = make_directions(atmosphere.air, workers);
  Means sum = gather_first(atmosphere, directions, workers), before, last = sum;
  for (int order = 2; order <= kOrders; ++order) {
    before = std::move(last);
    last = gather_again(before, directions, workers);
    add(last.all, sum.all);
    add(last.haze, sum.haze);
  }
  add_later_orders(before.all, last.all, sum.all);
  add_later_orders(before.haze, last.haze, sum.haze);

  // Over the phase function of a few orders, which is narrower than a cell.
  for (std::size_t i = 0; i < sum.haze.size(); ++i) {
    const std::size_t direction = i / kHazePoints, column = i % kSourceSines;
    sum.haze[i] /= directions.repeated_sun_phase[direction * kSourceSines + column];
  }
  atmosphere.multiple = std::move(sum.all);
  atmosphere.haze = std::move(sum.haze);
}

HazeRow haze_row(const Atmosphere& atmosphere, double sine) {
  const double part = (0.5 * kPi - acos(sine)) / (0.5 * kPi);  // of a quarter circle
  const double x = std::copysign(std::sqrt(std::abs(part)), part);
  const double place = (0.5 * x + 0.5) * kElevations - 0.5;
  const Between at = between(place, kElevations);
  const std::array<float, 4> weights = cubic_weights(at.part);

  HazeRow row;
  for (std::size_t k = 0; k < kAzimuths; ++k) {
    row.at[k].resize(kHazePoints);
    for (int j = 0; j < 4; ++j) {
      const int i = std::clamp(at.first + j - 1, 0, kElevations - 1);
      const glm::vec3* in =
          atmosphere.haze.data() + (static_cast<std::size_t>(i) * kAzimuths + k) * kHazePoints;
      for (std::size_t n = 0; n < kHazePoints; ++n) row.at[k][n] += weights[j] * in[n];
    }
  }

  // All azimuths meet overhead.
  const double over = std::max(-place, place - (kElevations - 1));
  if (over <= 0.0) return row;
  const float mixed = static_cast<float>(std::min(2.0 * over, 1.0));
  for (std::size_t n = 0; n < kHazePoints; ++n) {
    glm::vec3 mean(0.0f);
    for (const std::vector<glm::vec3>& azimuth : row.at) mean += azimuth[n] / float{kAzimuths};
    for (std::vector<glm::vec3>& azimuth : row.at) azimuth[n] += mixed * (mean - azimuth[n]);
  }
  return row;
}

AzimuthBlend blend_azimuths(double turns) {
  const double place = turns * kCircle + 0.5;  // from the first's mirror image
  const int first = std::min(static_cast<int>(place), kAzimuths);
  AzimuthBlend blend{{}, cubic_weights(static_cast<float>(place - first))};
  for (int j = 0; j < 4; ++j) {
    const int k = first + j - 2;
    blend.azimuth[j] = k < 0 ? -1 - k : k < kAzimuths ? k : kCircle - 1 - k;
  }
  return blend;
}

glm::vec3 scatter_light_again(const Atmosphere& atmosphere, const HazeRow& haze,
                              const AzimuthBlend& blend, const Path& path, LightAngles light) {
  const double cos_theta = light.up * path.sine + light.ahead * cosine_of(path.sine);
  const auto phase = static_cast<float>(repeated_mie_phase(cos_theta));
  return scatter_again(
      atmosphere.multiple,
      [&](Between row, Between column) {
        glm::vec3 sum(0.0f);
        for (std::size_t j = 0; j < blend.azimuth.size(); ++j)
          sum += blend.weight[j] *
                 interpolate(haze.at[static_cast<std::size_t>(blend.azimuth[j])].data(),
                             kSourceSines, row, column);
        return phase * sum;
      },
      path, light);
}

}  // namespace swell::scene
