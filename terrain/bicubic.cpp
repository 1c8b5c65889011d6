#include "terrain/bicubic.h"

#include <algorithm>
#include <array>

namespace swell::terrain {
namespace {

// Returns the weights of the samples at -1, 0, 1 and 2 at the place t in [0, 1).
std::array<float, 4> weights(float t) {
  const float t2 = t * t, t3 = t2 * t;
  return {0.5f * (-t3 + 2.0f * t2 - t), 0.5f * (3.0f * t3 - 5.0f * t2 + 2.0f),
          0.5f * (-3.0f * t3 + 4.0f * t2 + t), 0.5f * (t3 - t2)};
}

// Writes `factor` samples for each step between `count` samples that lie `stride` apart, and the
// last one: `out_stride` apart.
void refine_line(const float* from, int count, std::size_t stride, int factor, float* to,
                 std::size_t out_stride) {
  const auto at = [&](int i) {
    const auto sample = [&](int k) { return from[static_cast<std::size_t>(k) * stride]; };
    if (i < 0) return 2.0f * sample(0) - sample(1);
    if (i >= count) return 2.0f * sample(count - 1) - sample(count - 2);
    return sample(i);
  };
  for (int i = 0; i + 1 < count; ++i)
    for (int k = 0; k < factor; ++k) {
      const std::array<float, 4> w = weights(static_cast<float>(k) / static_cast<float>(factor));
      *to = ((w[0] * at(i - 1) + w[1] * at(i)) + w[2] * at(i + 1)) + w[3] * at(i + 2);
      to += out_stride;
    }
  *to = at(count - 1);
}

}  // namespace

HeightGrid refine_bicubic(const HeightGrid& heights, Workers& workers) {
  const Grid& grid = heights.grid;
  const int most = std::max(grid.samples_x, grid.samples_y) - 1;
  int factor = 4;
  while (factor > 1 && most * factor >= kMostRefined) factor /= 2;
  if (factor == 1) return heights;
  HeightGrid fine = heights;
  fine.grid.spacing_m = grid.spacing_m / factor;
  fine.grid.samples_x = (grid.samples_x - 1) * factor + 1;
  fine.grid.samples_y = (grid.samples_y - 1) * factor + 1;
  fine.height_m.resize(fine.grid.size());
  // Rows first, into every factor-th one, then columns between these.
  workers.for_each(static_cast<std::size_t>(grid.samples_y), [&](std::size_t j, int) {
    const auto row = static_cast<int>(j);
    refine_line(&heights.height_m[grid.index(0, row)], grid.samples_x, 1, factor,
                &fine.height_m[fine.grid.index(0, row * factor)], 1);
  });
  workers.for_each(static_cast<std::size_t>(grid.samples_y) - 1, [&](std::size_t j, int) {
    const auto row = static_cast<int>(j);
    const auto coarse = [&](int k, int i) { return fine.height_m[fine.grid.index(i, k * factor)]; };
    for (int k = 1; k < factor; ++k) {
      const std::array<float, 4> w = weights(static_cast<float>(k) / static_cast<float>(factor));
      for (int i = 0; i < fine.grid.samples_x; ++i) {
        const float h1 = coarse(row, i), h2 = coarse(row + 1, i);
        const float h0 = row > 0 ? coarse(row - 1, i) : 2.0f * h1 - h2;
        const float h3 = row + 2 < grid.samples_y ? coarse(row + 2, i) : 2.0f * h2 - h1;
        fine.height_m[fine.grid.index(i, row * factor + k)] =
            ((w[0] * h0 + w[1] * h1) + w[2] * h2) + w[3] * h3;
      }
    }
  });
  return fine;
}

}  // namespace swell::terrain
