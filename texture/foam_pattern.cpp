#include "texture/foam_pattern.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "math/check.h"
#include "math/random.h"

namespace swell::texture {
namespace {

// One point in every square of a periodic lattice of `cells` a side; units of a square.
class CellPoints {
 public:
  CellPoints(int cells, std::uint64_t seed) : cells_(cells), seed_(seed) {}

  // Distance to the second nearest point less that to the nearest: 0 on the rims between cells.
  double rim_distance(double x, double y) const {
    const int i0 = static_cast<int>(std::floor(x)), j0 = static_cast<int>(std::floor(y));
    double nearest2 = 1e9, second2 = 1e9;
    for (int j = j0 - 2; j <= j0 + 2; ++j) {
      for (int i = i0 - 2; i <= i0 + 2; ++i) {
        const double dx = i + offset(i, j, 0) - x, dy = j + offset(i, j, 1) - y;
        const double d2 = dx * dx + dy * dy;
        second2 = std::min(second2, std::max(nearest2, d2));
        nearest2 = std::min(nearest2, d2);
      }
    }
    return std::sqrt(second2) - std::sqrt(nearest2);
  }

 private:
  double offset(int i, int j, std::uint64_t axis) const {
    const int x = (i + 2 * cells_) % cells_, y = (j + 2 * cells_) % cells_;
    const auto point = static_cast<std::uint64_t>(y * cells_ + x);
    return random_uniform(seed_, 2 * point + axis);
  }

  int cells_;
  std::uint64_t seed_;
};

}  // namespace

std::vector<float> make_foam_pattern(int size, std::uint64_t seed) {
  SWELL_CHECK(size >= 32 && size <= 1024 && std::has_single_bit(static_cast<unsigned>(size)),
              "size={}", size);
  const CellPoints large(10, seed), small(25, seed + 1);
  const std::size_t count = static_cast<std::size_t>(size) * size;
  std::vector<double> rim;
  rim.reserve(count);
  for (int j = 0; j < size; ++j) {
    for (int i = 0; i < size; ++i) {
      const double x = static_cast<double>(i) / size, y = static_cast<double>(j) / size;
      rim.push_back(large.rim_distance(10.0 * x, 10.0 * y) +
                    0.6 * small.rim_distance(25.0 * x, 25.0 * y));
    }
  }
  // Rank them, so that every part of the range is as large as it says.
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    return rim[a] != rim[b] ? rim[a] < rim[b] : a < b;
  });
  std::vector<float> threshold(count);
  for (std::size_t k = 0; k < count; ++k)
    threshold[order[k]] =
        static_cast<float>((static_cast<double>(k) + 0.5) / static_cast<double>(count));
  return threshold;
}

}  // namespace swell::texture
