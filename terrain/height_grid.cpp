#include "terrain/height_grid.h"

#include <algorithm>
#include <array>

#include "math/check.h"
#include "terrain/sample_heights.h"

namespace swell::terrain {
namespace {

// The grid's cell below a point, and the place in it in [0, 1]; along an axis of one sample the
// cell has no width.
struct AxisCell {
  int i0, i1;
  double fraction;
};

AxisCell find_cell(double x, double min, double spacing_m, int samples) {
  // max first, so that NaN becomes 0.
  const double u = std::min(std::max(0.0, (x - min) / spacing_m), static_cast<double>(samples - 1));
  const int i0 = std::min(static_cast<int>(u), std::max(samples - 2, 0));
  return {i0, std::min(i0 + 1, samples - 1), u - i0};
}

struct Corners {
  double h00, h10, h01, h11;
  double fx, fy;
};

Corners find_corners(const HeightGrid& heights, glm::dvec2 p) {
  const Grid& grid = heights.grid;
  const AxisCell x = find_cell(p.x, grid.min_world.x, grid.spacing_m, grid.samples_x);
  const AxisCell y = find_cell(p.y, grid.min_world.y, grid.spacing_m, grid.samples_y);
  const float* south = &heights.height_m[grid.index(0, y.i0)];
  const float* north = &heights.height_m[grid.index(0, y.i1)];
  return {south[x.i0], south[x.i1], north[x.i0], north[x.i1], x.fraction, y.fraction};
}

double between(const Corners& c) {
  const double south = c.h00 + c.fx * (c.h10 - c.h00);
  const double north = c.h01 + c.fx * (c.h11 - c.h01);
  return south + c.fy * (north - south);
}

}  // namespace

double height_at(const HeightGrid& heights, glm::dvec2 p_world) {
  if (heights.apron.width_m > 0.0 && !heights.grid.holds(p_world)) {
    double height_m = 0.0;
    sample_doubles(heights, std::span(&p_world, 1), std::span(&height_m, 1));
    return height_m;
  }
  return between(find_corners(heights, p_world));
}

glm::dvec2 slope_at(const HeightGrid& heights, glm::dvec2 p_world) {
  const Corners c = find_corners(heights, p_world);
  const double dx = (c.h10 - c.h00) + c.fy * ((c.h11 - c.h01) - (c.h10 - c.h00));
  const double dy = (c.h01 - c.h00) + c.fx * ((c.h11 - c.h10) - (c.h01 - c.h00));
  return glm::dvec2(dx, dy) / heights.grid.spacing_m;
}

void sample_heights(const HeightGrid& heights, std::span<const glm::dvec2> p_world,
                    std::span<float> height_m) {
  SWELL_CHECK(p_world.size() == height_m.size(), "p_world={} height_m={}", p_world.size(),
              height_m.size());
  SWELL_CHECK(heights.grid.samples_x >= 1 && heights.grid.samples_y >= 1, "samples={} x {}",
              heights.grid.samples_x, heights.grid.samples_y);
  SWELL_CHECK(heights.height_m.size() == heights.grid.size(), "{} samples, {} heights",
              heights.grid.size(), heights.height_m.size());
  const bool has_cells = heights.grid.samples_x >= 2 && heights.grid.samples_y >= 2;
  std::array<double, 256> some;
  for (std::size_t n = 0; n < p_world.size(); n += some.size()) {
    const std::size_t count = std::min(some.size(), p_world.size() - n);
    if (has_cells)
      sample_doubles(heights, p_world.subspan(n, count), std::span(some).first(count));
    else
      std::ranges::transform(p_world.subspan(n, count), some.begin(),
                             [&](glm::dvec2 p) { return height_at(heights, p); });
    std::copy_n(some.begin(), count, height_m.begin() + static_cast<std::ptrdiff_t>(n));
  }
}

HeightGrid resample(const HeightGrid& heights, const Grid& grid) {
  HeightGrid result{grid, std::vector<float>(grid.size())};
  std::vector<glm::dvec2> p(static_cast<std::size_t>(grid.samples_x));
  for (int j = 0; j < grid.samples_y; ++j) {
    for (int i = 0; i < grid.samples_x; ++i) p[static_cast<std::size_t>(i)] = grid.point(i, j);
    sample_heights(heights, p, std::span(result.height_m).subspan(grid.index(0, j), p.size()));
  }
  return result;
}

void sample_slopes(const HeightGrid& heights, std::span<float> slope_x, std::span<float> slope_y) {
  const Grid& grid = heights.grid;
  SWELL_CHECK(grid.samples_x >= 2 && grid.samples_y >= 2, "samples={} x {}", grid.samples_x,
              grid.samples_y);
  SWELL_CHECK(slope_x.size() == grid.size() && slope_y.size() == grid.size(),
              "samples={} slopes={}, {}", grid.size(), slope_x.size(), slope_y.size());
  const auto height = [&](int i, int j) {
    return static_cast<double>(heights.height_m[grid.index(i, j)]);
  };
  const auto slope = [&](double low, double high, int steps) {
    return static_cast<float>((high - low) / (steps * grid.spacing_m));
  };
  for (int j = 0; j < grid.samples_y; ++j) {
    const int south = std::max(j - 1, 0), north = std::min(j + 1, grid.samples_y - 1);
    for (int i = 0; i < grid.samples_x; ++i) {
      const int west = std::max(i - 1, 0), east = std::min(i + 1, grid.samples_x - 1);
      const std::size_t k = grid.index(i, j);
      slope_x[k] = slope(height(west, j), height(east, j), east - west);
      slope_y[k] = slope(height(i, south), height(i, north), north - south);
    }
  }
}

}  // namespace swell::terrain
