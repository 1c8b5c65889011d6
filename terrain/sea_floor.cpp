#include "terrain/sea_floor.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace swell::terrain {
namespace {

constexpr double kMaxSamples = 0x1p26;
constexpr float kMaxDepth = 1e6f;

void require(bool good, const std::string& what) {
  if (!good) throw std::invalid_argument(what);
}

void check_grid(const Grid& grid) {
  require(grid.samples_x >= 1 && grid.samples_y >= 1 &&
              static_cast<double>(grid.samples_x) * grid.samples_y <= kMaxSamples,
          fmt::format("sea floor of {} x {} samples, allowed 1 to 2^26 in all", grid.samples_x,
                      grid.samples_y));
  require(grid.spacing_m > 0.0 && std::isfinite(grid.spacing_m),
          fmt::format("sea floor spacing {} m, must be positive", grid.spacing_m));
  require(std::isfinite(grid.min_world.x) && std::isfinite(grid.min_world.y),
          fmt::format("sea floor corner ({}, {})", grid.min_world.x, grid.min_world.y));
}

glm::dvec2 left_normal(glm::dvec2 from, glm::dvec2 to) {
  const glm::dvec2 along = glm::normalize(to - from);
  return {-along.y, along.x};
}

void check_beach(const PlaneBeach& beach) {
  require(beach.coast.size() >= 2,
          fmt::format("coast line of {} points, at least 2", beach.coast.size()));
  for (std::size_t n = 0; n < beach.coast.size(); ++n) {
    const glm::dvec2 p = beach.coast[n];
    // NaN fails.
    require(std::isfinite(p.x) && std::isfinite(p.y) &&
                (n == 0 || glm::distance(p, beach.coast[n - 1]) >= kShortestStretch_m),
            fmt::format("coast line point {}: ({}, {}), must be {} m or more from the one before",
                        n, p.x, p.y, kShortestStretch_m));
  }
  require(beach.slope > 0.0, fmt::format("beach slope {}, must be positive", beach.slope));
  require(beach.max_depth_m > 0.0,
          fmt::format("largest depth {} m, must be positive", beach.max_depth_m));
}

}  // namespace

void check_sea_floor(const HeightGrid& floor) {
  check_grid(floor.grid);
  require(floor.height_m.size() == floor.grid.size(),
          fmt::format("sea floor of {} samples with {} depths", floor.grid.size(),
                      floor.height_m.size()));
  // NaN is bad, too. Text is made for a bad depth only: made for each, it was a third of the whole
  // making of a coast.
  const auto bad = std::ranges::find_if_not(
      floor.height_m, [](float height) { return std::abs(height) <= kMaxDepth; });
  if (bad != floor.height_m.end())
    require(false, fmt::format("depth {} m at sample {}, allowed +-1e6", -*bad,
                               bad - floor.height_m.begin()));
}

HeightGrid make_sea_floor(const Grid& grid, FunctionRef<double(glm::dvec2)> depth_m) {
  check_grid(grid);
  HeightGrid floor{grid};
  floor.height_m.reserve(grid.size());
  for (int j = 0; j < grid.samples_y; ++j) {
    for (int i = 0; i < grid.samples_x; ++i) {
      floor.height_m.push_back(-static_cast<float>(depth_m(grid.point(i, j))));
    }
  }
  check_sea_floor(floor);
  return floor;
}

double distance_to_coast(std::span<const glm::dvec2> coast, glm::dvec2 p_world) {
  const std::size_t last = coast.size() - 2;
  double nearest2 = std::numeric_limits<double>::infinity(), side = 1.0;
  for (std::size_t s = 0; s <= last; ++s) {
    // Nearest point of this stretch.
    const glm::dvec2 along = coast[s + 1] - coast[s];
    double t = glm::dot(p_world - coast[s], along) / glm::dot(along, along);
    if (s > 0) t = std::max(t, 0.0);
    if (s < last) t = std::min(t, 1.0);
    const glm::dvec2 away = p_world - (coast[s] + t * along);
    const double distance2 = glm::dot(away, away);
    if (distance2 >= nearest2) continue;
    nearest2 = distance2;
    // At a corner the stretches' own normals may disagree; the sum of both does not.
    glm::dvec2 normal = left_normal(coast[s], coast[s + 1]);
    if (s < last && t == 1.0) normal += left_normal(coast[s + 1], coast[s + 2]);
    if (s > 0 && t == 0.0) normal += left_normal(coast[s - 1], coast[s]);
    side = glm::dot(away, normal) < 0.0 ? -1.0 : 1.0;
  }
  return side * std::sqrt(nearest2);
}

HeightGrid make_plane_beach(const Grid& grid, const PlaneBeach& beach) {
  check_beach(beach);
  return make_sea_floor(grid, [&](glm::dvec2 p) {
    return std::min(beach.slope * distance_to_coast(beach.coast, p), beach.max_depth_m);
  });
}

}  // namespace swell::terrain
