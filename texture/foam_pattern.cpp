#include "texture/foam_pattern.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "math/check.h"
#include "math/random.h"
#include "math/stop.h"
#include "texture/perlin.h"

namespace swell::texture {
namespace {

// One point in every square of a periodic lattice of `cells` a side; units of a square.
class CellPoints {
 public:
  CellPoints(int cells, std::uint64_t seed) : cells_(cells) {
    for (std::uint64_t n = 0; n < 2 * static_cast<std::uint64_t>(cells) * cells; ++n)
      offset_.push_back(random_uniform(seed, n));
  }

  // Distance to the second nearest point less that to the nearest: 0 on the rims between cells.
  double rim_distance(double x, double y) const {
    const int i0 = static_cast<int>(std::floor(x)), j0 = static_cast<int>(std::floor(y));
    double nearest2 = 1e9, second2 = 1e9;
    const auto add_row = [&](int j, int first, int last, int step) {
      for (int i = first; i <= last; i += step) {
        const double* const offset = offset_of(i, j);
        const double dx = i + offset[0] - x, dy = j + offset[1] - y;
        const double d2 = dx * dx + dy * dy;
        second2 = std::min(second2, std::max(nearest2, d2));
        nearest2 = std::min(nearest2, d2);
      }
    };
    for (int j = j0 - 1; j <= j0 + 1; ++j) add_row(j, i0 - 1, i0 + 1, 1);
    // Points of the squares beyond are further off than one square.
    constexpr double kSurelyNearer = 0.999;
    if (second2 > kSurelyNearer) {
      for (const int j : {j0 - 2, j0 + 2}) add_row(j, i0 - 2, i0 + 2, 1);
      for (int j = j0 - 1; j <= j0 + 1; ++j) add_row(j, i0 - 2, i0 + 2, 4);
    }
    return std::sqrt(second2) - std::sqrt(nearest2);
  }

 private:
  const double* offset_of(int i, int j) const {
    const auto wrap = [&](int n) { return n < 0 ? n + cells_ : n < cells_ ? n : n - cells_; };
    return offset_.data() + 2 * (wrap(j) * cells_ + wrap(i));
  }

  int cells_;
  std::vector<double> offset_;  // two a point
};

void check_size(int size) {
  SWELL_CHECK(size >= 32 && size <= 1024 && std::has_single_bit(static_cast<unsigned>(size)),
              "size={}", size);
}

// The values' ranks, so that every part of the range is as large as it says.
std::vector<float> spread_evenly(const std::vector<double>& values) {
  const std::size_t count = values.size();
  std::vector<std::pair<double, std::uint32_t>> in_order(count);
  for (std::size_t k = 0; k < count; ++k) in_order[k] = {values[k], static_cast<std::uint32_t>(k)};
  std::ranges::sort(in_order);
  std::vector<float> threshold(count);
  for (std::size_t k = 0; k < count; ++k)
    threshold[in_order[k].second] =
        static_cast<float>((static_cast<double>(k) + 0.5) / static_cast<double>(count));
  return threshold;
}

}  // namespace

std::vector<float> make_foam_pattern(int size, std::uint64_t seed) {
  check_size(size);
  const CellPoints large(10, seed), small(25, seed + 1);
  std::vector<double> rim;
  for (int j = 0; j < size; ++j) {
    check_stop();
    for (int i = 0; i < size; ++i) {
      const double x = static_cast<double>(i) / size, y = static_cast<double>(j) / size;
      rim.push_back(large.rim_distance(10.0 * x, 10.0 * y) +
                    0.6 * small.rim_distance(25.0 * x, 25.0 * y));
    }
  }
  return spread_evenly(rim);
}

std::vector<float> make_tear_pattern(int size, std::uint64_t seed) {
  check_size(size);
  constexpr int kCells = 8, kOctaves = 4;
  constexpr double kPersistence = 0.6;
  const PerlinNoise noise(seed);
  std::vector<double> x, value(static_cast<std::size_t>(size) * size);
  for (int i = 0; i < size; ++i) x.push_back(static_cast<double>(kCells * i) / size);
  for (std::size_t j = 0; j < x.size(); ++j) {
    check_stop();
    noise.periodic_fractal3_row(x, x[j], 0.5, kCells, kOctaves, kPersistence,
                                std::span(value).subspan(j * x.size(), x.size()));
  }
  return spread_evenly(value);
}

}  // namespace swell::texture
