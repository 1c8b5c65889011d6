#include "lod/relief_bounds.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "math/random.h"

namespace swell::lod {
namespace {

struct Slopes {
  double x, y;
};

// One corner of a square of four samples; the bilinear surface's slopes are extreme at corners.
Slopes corner_slopes(const std::vector<float>& z, int samples, double spacing_m, int i, int j,
                     int corner) {
  const auto at = [&](int x, int y) {
    return static_cast<double>(z[static_cast<std::size_t>(y * samples + x)]);
  };
  const int row = j + corner / 2, column = i + corner % 2;
  return {(at(i + 1, row) - at(i, row)) / spacing_m,
          (at(column, j + 1) - at(column, j)) / spacing_m};
}

const ReliefCell& cell_at(const ReliefBounds& bounds, int q, int i, int j) {
  return bounds.cells()[static_cast<std::size_t>(relief_level_begin(q) + (j << q) + i)];
}

float bound(const ReliefBounds& bounds, int q, int i, int j, std::size_t which) {
  return bounds.slope_unit() * static_cast<float>(cell_at(bounds, q, i, j).slope[which]);
}

float height_bound_m(const ReliefBounds& bounds, int q, int i, int j, std::size_t which) {
  return bounds.height_unit_m() * static_cast<float>(cell_at(bounds, q, i, j).height[which]);
}

TEST(ReliefBounds, EveryCellOfEveryLevelBoundsTheSlopesAndHeightsInIt) {
  for (const int samples : {2, 3, 7, 9, 50}) {
    std::vector<float> z(static_cast<std::size_t>(samples * samples));
    for (std::size_t k = 0; k < z.size(); ++k)
      z[k] = static_cast<float>(random_uniform(5, k) * random_uniform(6, k));
    const double spacing_m = 0.7;
    const ReliefBounds bounds(z, samples, spacing_m);
    ASSERT_GE(2 << (bounds.levels() - 1), samples - 1);
    for (int q = 0; q < bounds.levels(); ++q) {
      const double cell = (samples - 1.0) / (1 << q);  // in samples
      for (int j = 0; j < samples - 1; ++j)
        for (int i = 0; i < samples - 1; ++i)
          for (int corner = 0; corner < 4; ++corner) {
            const Slopes s = corner_slopes(z, samples, spacing_m, i, j, corner);
            // The cells that the square overlaps.
            const auto first = [&](int k) { return static_cast<int>(k / cell + 1e-9); };
            const auto last = [&](int k) { return static_cast<int>((k + 1) / cell - 1e-9); };
            for (int b = first(j); b <= last(j); ++b)
              for (int a = first(i); a <= last(i); ++a) {
                SCOPED_TRACE(fmt::format("{} samples, level {}, cell ({}, {})", samples, q, a, b));
                ASSERT_LE(s.x, bound(bounds, q, a, b, 0) + 1e-5);
                ASSERT_LE(-s.x, bound(bounds, q, a, b, 1) + 1e-5);
                ASSERT_LE(s.y, bound(bounds, q, a, b, 2) + 1e-5);
                ASSERT_LE(-s.y, bound(bounds, q, a, b, 3) + 1e-5);
                const std::size_t at =
                    static_cast<std::size_t>((j + corner / 2) * samples + i + corner % 2);
                ASSERT_LE(z[at], height_bound_m(bounds, q, a, b, 0) + 1e-5);
                ASSERT_LE(-z[at], height_bound_m(bounds, q, a, b, 1) + 1e-5);
              }
          }
    }
  }
}

TEST(ReliefBounds, APlaneHasItsSlopeInEveryCellAndItsHeights) {
  std::vector<float> z;
  for (int y = 0; y < 33; ++y)
    for (int x = 0; x < 33; ++x) z.push_back(0.25f * static_cast<float>(x - 2 * y));
  const ReliefBounds bounds(z, 33, 0.5);
  EXPECT_EQ(bounds.levels(), 6);
  for (int q = 0; q < 6; ++q) {
    const int middle = (1 << q) / 2;
    EXPECT_NEAR(bound(bounds, q, middle, middle, 0), 0.5f, 0.01f);
    EXPECT_NEAR(bound(bounds, q, middle, middle, 1), -0.5f, 0.01f);
    EXPECT_NEAR(bound(bounds, q, middle, middle, 2), -1.0f, 0.01f);
    EXPECT_NEAR(bound(bounds, q, middle, middle, 3), 1.0f, 0.01f);
    // z = 0.25 (i - 2 j), from the corner in the south-west of the cell in the middle.
    const float corner = -0.25f * 32.0f * static_cast<float>(middle) / static_cast<float>(1 << q);
    const float side = 32.0f / static_cast<float>(1 << q);
    EXPECT_NEAR(height_bound_m(bounds, q, middle, middle, 0), corner + 0.25f * side, 0.01f);
    EXPECT_NEAR(height_bound_m(bounds, q, middle, middle, 1), -corner + 0.5f * side, 0.01f);
  }
}

TEST(ReliefBounds, HeightsMoreThanTheFinestLevelHoldsShareCells) {
  std::vector<float> z(1100 * 1100, 0.0f);
  z[800 * 1100 + 700] = 1.0f;  // one spike
  const ReliefBounds bounds(z, 1100, 1.0);
  EXPECT_EQ(bounds.levels(), 11);
  int steep = 0;
  for (int j = 0; j < 1024; ++j)
    for (int i = 0; i < 1024; ++i) steep += bound(bounds, 10, i, j, 0) > 0.5f;
  EXPECT_GE(steep, 1);
  EXPECT_LE(steep, 6);
}

TEST(ReliefBoundsDeathTest, RefusesWhatIsNoGrid) {
  EXPECT_DEATH(ReliefBounds(std::vector<float>(8), 3, 1.0), "samples=3");
  EXPECT_DEATH(ReliefBounds(std::vector<float>(9), 3, 0.0), "spacing_m=0");
  EXPECT_DEATH(ReliefBounds(std::vector<float>(9, NAN), 3, 1.0), "finite heights");
}

}  // namespace
}  // namespace swell::lod
