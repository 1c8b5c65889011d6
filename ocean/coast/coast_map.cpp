#include "ocean/coast/coast_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/check.h"

namespace swell::ocean {
namespace {

// Crests of waves that are not quite at their limit spill already.
constexpr double kSpilling = 0.6;

using Place = PlaceInTrains;

// v = c0 + c1 x + c2 y + c3 x y, and its slopes per cell.
struct Value {
  float v, dx, dy;
};

Value value_in_cell(const float* c, const Place& at) {
  return {c[0] + c[1] * at.x + (c[2] + c[3] * at.x) * at.y, c[1] + c[3] * at.y, c[2] + c[3] * at.x};
}

// One train at one point, before it is packed.
struct Wave {
  float cycles, slope_x, slope_y, shore_part;
};

Wave wave_at(const TrainSea& sea, std::size_t train, const Place& at, float share, float depth_m) {
  const float* c = sea.waves.data() + 8 * (at.cell * static_cast<std::size_t>(sea.trains) + train);
  const Value theta = value_in_cell(c, at), amplitude = value_in_cell(c + 4, at);
  const float factor = share * amplitude.v / static_cast<float>(sea.grid.spacing_m);
  const double part = shore_part(depth_m, sea.deep_depth_m[train], sea.shallow_depth_m[train]);
  return {theta.v - std::floor(theta.v), factor * theta.dx, factor * theta.dy,
          static_cast<float>(part)};
}

float surf_at(const CoastSea& coast, const Place& at, float depth_m) {
  const TrainSea& sea = coast.trains;
  double sum = 0.0;
  for (int i = 0; i < sea.trains; ++i)
    sum += value_in_cell(sea.waves.data() + 8 * (at.cell * sea.trains + i) + 4, at).v;
  return static_cast<float>(breaking_part(coast, sum, static_cast<double>(depth_m)));
}

// All of the map's points, unpacked: waves by point, then train.
struct CoastPoints {
  std::vector<Wave> wave;
  std::vector<float> surf;
};

CoastPoints find_coast_points(const CoastSea& coast, int size, Workers& workers) {
  const TrainSea& sea = coast.trains;
  const auto n = static_cast<std::size_t>(size), trains = static_cast<std::size_t>(sea.trains);
  const glm::dvec2 step = sea.grid.spacing_m *
                          glm::dvec2(sea.grid.samples_x - 1, sea.grid.samples_y - 1) /
                          static_cast<double>(size);
  CoastPoints points{std::vector<Wave>(n * n * trains), std::vector<float>(n * n)};
  workers.for_each(n, [&](std::size_t j, int) {
    for (std::size_t i = 0; i < n; ++i) {
      const glm::dvec2 p = lattice_point(sea.grid.min_world, step, glm::dvec2(i, j));
      const Place at = find_place(sea, p);
      const float depth_m = depth_at(sea, at);
      float share = 0.0f;
      sample_coast_share(coast, {&p, 1}, {&share, 1});
      const std::size_t k = j * n + i;
      for (std::size_t train = 0; train < trains; ++train)
        points.wave[k * trains + train] = wave_at(sea, train, at, share, depth_m);
      points.surf[k] = share * surf_at(coast, at, depth_m);
    }
  });
  return points;
}

std::uint16_t fixed16(float x) {
  return static_cast<std::uint16_t>(std::clamp(std::nearbyint(x * 65536.0f), 0.0f, 65535.0f));
}

// One group of one train.
void pack_group(std::span<const Wave> wave, std::size_t stride, float unit, std::uint16_t* out) {
  for (std::size_t i = 0; i < kMapGroup; ++i) {
    const Wave& w = wave[i * stride];
    const auto slope = [&](float s) {
      return static_cast<std::uint16_t>(static_cast<std::int16_t>(std::nearbyint(s / unit)));
    };
    // The phase wraps: 65536 is 0.
    out[i] = static_cast<std::uint16_t>(static_cast<std::uint32_t>(w.cycles * 65536.0f));
    out[kMapGroup + i] = slope(w.slope_x);
    out[2 * kMapGroup + i] = slope(w.slope_y);
    out[3 * kMapGroup + i] = fixed16(w.shore_part);
  }
}

}  // namespace

PlaceInTrains find_place(const TrainSea& sea, glm::dvec2 p_world) {
  const glm::dvec2 at = (p_world - sea.grid.min_world) / sea.grid.spacing_m;
  const int i = std::clamp(static_cast<int>(at.x), 0, sea.cells_x - 1);
  const int j = std::clamp(static_cast<int>(at.y), 0, sea.cells_y - 1);
  return {static_cast<std::size_t>(j) * sea.cells_x + i, static_cast<float>(at.x - i),
          static_cast<float>(at.y - j)};
}

float depth_at(const TrainSea& sea, const PlaceInTrains& at) {
  return value_in_cell(sea.depth.data() + 4 * at.cell, at).v;
}

TrainAtPlace train_at(const TrainSea& sea, std::size_t train, const PlaceInTrains& at) {
  const float* c = sea.waves.data() + 8 * (at.cell * static_cast<std::size_t>(sea.trains) + train);
  return {value_in_cell(c, at).v, value_in_cell(c + 4, at).v};
}

double breaking_part(double sum_m, double depth_m) {
  if (!(depth_m > 0.0)) return 0.0;
  const double limit_m = 0.5 * kBreakingRatio * depth_m;
  return smoothstep(kSpilling, 1.0, sum_m / limit_m);
}

double breaking_part(const CoastSea& coast, double sum_m, double depth_m) {
  const double width = coast.surf_width;
  if (width >= 1.0) return breaking_part(sum_m, depth_m / width);
  // Broken waves are at their limit everywhere: nothing of them tells where they began to be.
  const double highest_m = static_cast<double>(coast.trains.height_bound_m);
  return std::min(breaking_part(sum_m, depth_m), breaking_part(highest_m, depth_m / width));
}

CoastMap make_coast_map(const CoastSea& coast, int size, Workers& workers) {
  SWELL_CHECK(size >= kMapGroup && size % kMapGroup == 0, "size={}", size);
  const CoastPoints points = find_coast_points(coast, size, workers);
  const auto trains = static_cast<std::size_t>(coast.trains.trains);
  CoastMap map;
  map.size = size;
  map.period_s = coast.trains.period_s;
  float largest = 1e-6f;
  for (const Wave& w : points.wave)
    largest = std::max({largest, std::abs(w.slope_x), std::abs(w.slope_y)});
  map.slope_unit = largest / 32767.0f;
  map.wave.resize(points.wave.size() * 4);
  map.has_sea.resize(points.surf.size() / kMapGroup);
  for (std::size_t group = 0; group < map.has_sea.size(); ++group) {
    const std::span<const Wave> waves =
        std::span(points.wave).subspan(group * kMapGroup * trains, kMapGroup * trains);
    map.has_sea[group] = std::ranges::any_of(
        waves, [](const Wave& w) { return w.slope_x != 0.0f || w.slope_y != 0.0f; });
    for (std::size_t train = 0; train < trains; ++train)
      pack_group(waves.subspan(train), trains, map.slope_unit,
                 map.wave.data() + (group * trains + train) * 4 * kMapGroup);
  }
  for (const float surf : points.surf) map.surf.push_back(fixed16(surf));
  return map;
}

void sample_surf_foam(const CoastSea& coast, double t_s, std::span<const glm::dvec2> p_world,
                      std::span<float> foam) {
  const TrainSea& sea = coast.trains;
  sample_coast_share(coast, p_world, foam);
  for (std::size_t k = 0; k < foam.size(); ++k) {
    if (foam[k] == 0.0f) continue;
    const Place at = find_place(sea, p_world[k]);
    const float surf = foam[k] * surf_at(coast, at, depth_at(sea, at));
    float sum = 0.0f;
    for (std::size_t n = 0; n < sea.period_s.size(); ++n) {
      const double cycles = t_s / sea.period_s[n];
      const float turns =
          train_at(sea, n, at).cycles - static_cast<float>(cycles - std::floor(cycles));
      const float u = turns - std::floor(turns);
      sum += std::max(u * u * u, 1.0f - 12.0f * u);
    }
    const float mean = sum / static_cast<float>(sea.trains);
    foam[k] = surf * std::clamp(mean * kFoamGain + kFoamBias, 0.0f, 1.0f);
  }
}

}  // namespace swell::ocean
