#include "terrain/poisson_tile.h"

#include <algorithm>
#include <array>

#include "math/check.h"
#include "math/random.h"
#include "math/stop.h"

namespace swell::terrain {
namespace {

constexpr int kCells = 64;  // a side, of about one point each
constexpr std::uint64_t kMostTries = 1'000'000;

double from_next_tile(double d) {
  d = std::abs(d);
  return std::min(d, 1.0 - d);
}

// The points so far, by cells of the square.
class PointGrid {
 public:
  // Whether a point is nearer to p than `distance`.
  bool has_near(glm::dvec2 p, double distance) const {
    const int reach = std::min(static_cast<int>(distance * kCells) + 1, kCells / 2 - 1);
    const int x = cell(p.x), y = cell(p.y);
    for (int j = y - reach; j <= y + reach; ++j)
      for (int i = x - reach; i <= x + reach; ++i)
        for (const glm::dvec2& q : at(i, j)) {
          const double dx = from_next_tile(p.x - q.x), dy = from_next_tile(p.y - q.y);
          if (dx * dx + dy * dy < distance * distance) return true;
        }
    return false;
  }

  void add(glm::dvec2 p) { cells_[index(cell(p.x), cell(p.y))].push_back(p); }

 private:
  static int cell(double x) { return static_cast<int>(x * kCells); }
  static std::size_t index(int i, int j) {
    return static_cast<std::size_t>(((j + kCells) % kCells) * kCells + (i + kCells) % kCells);
  }
  const std::vector<glm::dvec2>& at(int i, int j) const { return cells_[index(i, j)]; }

  std::array<std::vector<glm::dvec2>, static_cast<std::size_t>(kCells) * kCells> cells_;
};

}  // namespace

std::vector<glm::dvec2> make_poisson_tile(std::uint64_t seed) {
  std::vector<glm::dvec2> points;
  PointGrid grid;
  std::uint64_t tries = 0;
  while (points.size() < kPoissonPoints) {
    check_stop();
    const double distance = kPoissonSpacing / std::sqrt(static_cast<double>(points.size() + 1));
    const glm::dvec2 p(random_uniform(seed, 2 * tries), random_uniform(seed, 2 * tries + 1));
    SWELL_CHECK(++tries < kMostTries, "points={} distance={}", points.size(), distance);
    // The first few are farther apart than cells of the square reach: they need a look at all.
    if (distance < 0.4 ? grid.has_near(p, distance)
                       : std::ranges::any_of(points, [&](const glm::dvec2& q) {
                           return glm::length(glm::dvec2(from_next_tile(p.x - q.x),
                                                         from_next_tile(p.y - q.y))) < distance;
                         }))
      continue;
    points.push_back(p);
    grid.add(p);
  }
  return points;
}

}  // namespace swell::terrain
