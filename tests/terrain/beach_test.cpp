// Beaches along a coast line.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "terrain/height_image.h"
#include "terrain/terrain.h"

namespace swell::terrain {
namespace {

// A square of 512 m with samples 1 m apart. The coast goes north along x = 20: sea in the west.
TerrainDescription straight_beach() {
  return {.floor_depth_m = 4.0,
          .coast_m = {{20.0, -50.0}, {20.0, 78.0}},
          .beach_slope = 0.03125,
          .beach_size_m = 512.0};
}

TEST(Beach, FillsItsSquareAroundTheMiddle) {
  TerrainDescription description = straight_beach();
  description.centre_m = {100.0, -30.0};
  const HeightGrid terrain = build_terrain(description);
  EXPECT_EQ(terrain.grid.samples_x, 513);
  EXPECT_EQ(terrain.grid.spacing_m, 1.0);
  EXPECT_EQ(terrain.grid.min_world, glm::dvec2(-156.0, -286.0));
  EXPECT_EQ(terrain.height_m.size(), 513u * 513u);
}

TEST(Beach, IsOnePlaneUpToHalfAMetreAboveTheWater) {
  const HeightGrid terrain = build_terrain(straight_beach());
  for (const double y : {-256.0, -100.0, 0.0, 33.0, 256.0}) {
    EXPECT_EQ(height_at(terrain, {20, y}), 0.0);
    EXPECT_EQ(height_at(terrain, {4, y}), -0.5);  // 16 m out, 1:32
    EXPECT_EQ(height_at(terrain, {-76, y}), -3.0);
    EXPECT_EQ(height_at(terrain, {36, y}), 0.5);
    EXPECT_EQ(height_at(terrain, {21, y}), 0.03125);
  }
}

TEST(Beach, EndsAtTheDepthOfTheFloor) {
  const HeightGrid terrain = build_terrain(straight_beach());
  EXPECT_EQ(terrain.lowest_m, -4.0f);
  EXPECT_EQ(height_at(terrain, {-107, 5}), -3.96875);  // 1 m before
  EXPECT_EQ(height_at(terrain, {-108, 5}), -4.0);
  EXPECT_EQ(height_at(terrain, {-256, 5}), -4.0);
}

// A coast that turns by a right angle at the origin: west of x = 0 and south of y = 0 is land.
TEST(Beach, HasTheDepthOfTheNearestPointOfABrokenCoast) {
  const HeightGrid terrain = build_terrain({.floor_depth_m = 50.0,
                                            .coast_m = {{0.0, 60.0}, {0.0, 0.0}, {60.0, 0.0}},
                                            .beach_slope = 0.125,
                                            .beach_size_m = 512.0});
  EXPECT_EQ(height_at(terrain, {30, 8}), -1.0);    // 8 m from the southern stretch
  EXPECT_EQ(height_at(terrain, {16, 100}), -2.0);  // 16 m from the western one, beyond its end
  EXPECT_EQ(height_at(terrain, {-2, 30}), 0.25);
  EXPECT_NEAR(height_at(terrain, {-2, -2}), 0.35355339, 1e-7);  // sqrt(8) m from the corner
}

TEST(Beach, RisesToLowDunesWithoutPools) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    TerrainDescription description = straight_beach();
    description.seed = seed;
    const HeightGrid terrain = build_terrain(description);
    EXPECT_GT(terrain.highest_m, 4.0f);
    EXPECT_LT(terrain.highest_m, 8.0f);
    for (int j = 0; j < terrain.grid.samples_x; ++j)
      for (int i = 293; i < terrain.grid.samples_x; ++i)  // x >= 37
        ASSERT_GT(terrain.height_m[static_cast<std::size_t>(j) * terrain.grid.samples_x + i], 0.5f);
  }
}

TEST(Beach, KeepsItsPlaneForEverySeedOfTheDunes) {
  TerrainDescription description = straight_beach();
  const HeightGrid a = build_terrain(description);
  EXPECT_EQ(build_terrain(description).height_m, a.height_m);
  ++description.seed;
  const HeightGrid b = build_terrain(description);
  int different = 0;
  for (std::size_t k = 0; k < a.height_m.size(); ++k) {
    if (a.height_m[k] == b.height_m[k]) continue;
    ++different;
    ASSERT_GT(a.height_m[k], 0.5f);
  }
  EXPECT_GT(different, 10000);
}

TEST(Beach, BendsIntoTheDunesWithoutAnEdge) {
  const HeightGrid terrain = build_terrain(straight_beach());
  std::vector<float> x(terrain.height_m.size()), y(x);
  sample_slopes(terrain, x, y);
  for (std::size_t k = 0; k < x.size(); ++k) {
    ASSERT_LT(std::hypot(x[k], y[k]), 0.2f) << k;
    if (std::abs(terrain.height_m[k] - 0.5f) < 0.05f) {
      ASSERT_NEAR(x[k], 0.03125f, 0.003f) << k;
    }
  }
}

TEST(Beach, IsFiniteAtTheEndsOfTheRanges) {
  for (const double slope : {0.001, 1.0}) {
    for (const double size : {50.0, 20000.0}) {
      const HeightGrid terrain = build_terrain({.centre_m = {1e6, 1e6},
                                                .floor_depth_m = 10000.0,
                                                .coast_m = {{-1e6, -1e6}, {-1e6, 1e6}},
                                                .beach_slope = slope,
                                                .beach_size_m = size});
      EXPECT_GT(terrain.lowest_m, 0.5f);  // false for NaN: all of it lies inland
      EXPECT_LT(terrain.highest_m, 8.0f);
    }
  }
}

TEST_F(HeightImage, CoastsThatMakeNoBeachAreRefused) {
  EXPECT_EQ(error_of({.coast_m = {{1, 2}}}), "terrain.coast_m, got 1 point, allowed 2 or more");
  EXPECT_EQ(error_of({.coast_m = {{1, 2}, {3, 4}, {3, 4}}}),
            "terrain.coast_m[2], got [3, 4], allowed a point 0.001 m or more from the one "
            "before");
  EXPECT_EQ(error_of({.coast_m = {{1, 2}, {3, HUGE_VAL}}}),
            "terrain.coast_m, north, got inf, allowed finite and over -inf");
  EXPECT_EQ(error_of({.coast_m = {{1, 2}, {3, 4}}, .beach_slope = 0.0}),
            "terrain.beach_slope, got 0, allowed finite and over 0");
  EXPECT_EQ(error_of({.coast_m = {{1, 2}, {3, 4}}, .beach_size_m = std::nan("")}),
            "terrain.beach_size_m, got nan, allowed finite and over 0");
  EXPECT_EQ(
      error_of({.height_image = write_exr("a.exr", 1, 1, {0.0f}), .coast_m = {{1, 2}, {3, 4}}}),
      "terrain.coast_m, got it besides height_image, allowed one of them");
}

TEST(Beach, HasItsSizeBeforeItIsMade) {
  const TerrainDescription beach{.coast_m = {{0.0, 0.0}, {9.0, 0.0}}, .beach_size_m = 777.7};
  EXPECT_EQ(described_size_m(beach), build_terrain(beach).grid.size_m());
  EXPECT_EQ(described_size_m({.height_image = "a.png"}), std::nullopt);
}

}  // namespace
}  // namespace swell::terrain
