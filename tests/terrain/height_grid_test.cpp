// Heights between the samples of a grid and at them.
#include "terrain/height_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include "math/random.h"
#include "terrain/terrain.h"

namespace swell::terrain {
namespace {

// 3 x 3, 2 m apart, from (10, 20): heights i + 10 j, but 100 in the middle.
HeightGrid small_terrain() {
  return {{{10.0, 20.0}, 2.0, 3, 3}, {0, 1, 2, 10, 100, 12, 20, 21, 22}};
}

TEST(HeightGrid, IsBilinearBetweenSamples) {
  const HeightGrid terrain = small_terrain();
  EXPECT_EQ(height_at(terrain, {10, 20}), 0.0);
  EXPECT_EQ(height_at(terrain, {12, 22}), 100.0);
  EXPECT_EQ(height_at(terrain, {14, 24}), 22.0);
  EXPECT_EQ(height_at(terrain, {11, 20}), 0.5);
  EXPECT_EQ(height_at(terrain, {10, 20.5}), 2.5);
  EXPECT_EQ(height_at(terrain, {11, 21}), 27.75);   // (0 + 1 + 10 + 100) / 4
  EXPECT_EQ(height_at(terrain, {13.5, 22}), 34.0);  // 100 + (12 - 100) 3 / 4
}

TEST(HeightGrid, GoesOnBeyondItsBorder) {
  const HeightGrid terrain = small_terrain();
  EXPECT_EQ(height_at(terrain, {-1e9, -1e9}), 0.0);
  EXPECT_EQ(height_at(terrain, {1e300, 20}), 2.0);
  EXPECT_EQ(height_at(terrain, {12, 1e6}), 21.0);
  EXPECT_EQ(height_at(terrain, {9, 23}), 15.0);
}

TEST(HeightGrid, HasTheSameHeightsOnManyThreads) {
  const HeightGrid terrain = build_terrain({});
  std::vector<glm::dvec2> points;
  for (int n = 0; n < 20000; ++n)
    points.push_back(1000.0 * glm::dvec2(random_uniform(1, 2 * n), random_uniform(1, 2 * n + 1)) -
                     500.0);
  std::vector<float> alone(points.size());
  sample_heights(terrain, points, alone);
  std::vector<std::vector<float>> together(4, std::vector<float>(points.size()));
  std::vector<std::thread> threads;
  for (auto& heights : together)
    threads.emplace_back([&] { sample_heights(terrain, points, heights); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& heights : together) EXPECT_EQ(heights, alone);
}

TEST(HeightGrid, HasCentralDifferencesAsSlopesOfItsSamples) {
  const HeightGrid terrain = small_terrain();
  std::vector<float> x(9), y(9);
  sample_slopes(terrain, x, y);
  EXPECT_EQ(x, (std::vector<float>{0.5f, 0.5f, 0.5f, 45.0f, 0.5f, -44.0f, 0.5f, 0.5f, 0.5f}));
  EXPECT_EQ(y, (std::vector<float>{5.0f, 49.5f, 5.0f, 5.0f, 5.0f, 5.0f, 5.0f, -39.5f, 5.0f}));
}

// Inside a cell the heights are 0, 1, 10, 100 at the corners: 50 x per metre more at the top.
TEST(HeightGrid, HasTheSlopeOfTheBilinearSurfaceInACell) {
  const HeightGrid terrain = small_terrain();
  EXPECT_EQ(slope_at(terrain, {10, 20}), glm::dvec2(0.5, 5.0));
  EXPECT_EQ(slope_at(terrain, {11, 20}), glm::dvec2(0.5, 27.25));
  EXPECT_EQ(slope_at(terrain, {11, 21}), glm::dvec2(22.75, 27.25));
}

TEST(HeightGrid, MayHaveOneSampleAlongAnAxis) {
  const HeightGrid row{{{0.0, 0.0}, 2.0, 2, 1}, {3.0f, 7.0f}};
  EXPECT_EQ(height_at(row, {1.0, 99.0}), 5.0);
  EXPECT_EQ(slope_at(row, {1.0, 99.0}), glm::dvec2(2.0, 0.0));
  const HeightGrid point{{{0.0, 0.0}, 2.0, 1, 1}, {3.0f}};
  EXPECT_EQ(height_at(point, {1e300, -5.0}), 3.0);
}

TEST(HeightGrid, HasTheHeightOfItsLowerBorderWhereThereIsNoPlace) {
  EXPECT_EQ(height_at(small_terrain(), {std::nan(""), 24.0}), 20.0);
}

TEST(HeightGrid, ResampledHasTheSurfacesHeightsAtItsPoints) {
  const HeightGrid fine = resample(small_terrain(), {{9.0, 20.0}, 1.0, 4, 2});
  EXPECT_EQ(fine.height_m, (std::vector<float>{0.0f, 0.0f, 0.5f, 1.0f, 5.0f, 5.0f, 27.75f, 50.5f}));
  EXPECT_EQ(fine.grid.point(3, 1), glm::dvec2(12.0, 21.0));
  EXPECT_EQ(fine.grid.size_m(), 3.0);
}

}  // namespace
}  // namespace swell::terrain
