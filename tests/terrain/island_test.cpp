// Islands from noise.
#include "terrain/island.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "terrain/terrain.h"

namespace swell::terrain {
namespace {

// Part of the samples whose height lies in [low, high].
double part_between(const HeightGrid& terrain, float low, float high) {
  const auto inside = [&](float h) { return h >= low && h <= high; };
  return static_cast<double>(std::ranges::count_if(terrain.height_m, inside)) /
         static_cast<double>(terrain.height_m.size());
}

const HeightGrid& island(std::uint64_t seed) {
  static std::map<std::uint64_t, HeightGrid> islands;
  const auto found = islands.find(seed);
  return found != islands.end()
             ? found->second
             : islands.emplace(seed, build_terrain({.seed = seed})).first->second;
}

class Island : public ::testing::TestWithParam<std::uint64_t> {
 protected:
  const HeightGrid& terrain_ = island(GetParam());
};

TEST_P(Island, HasLandLagoonAndDeepFloor) {
  EXPECT_GT(part_between(terrain_, 0.0f, 1e9f), 0.08);
  EXPECT_GT(part_between(terrain_, -4.0f, -1.0f), 0.12);
  EXPECT_GT(part_between(terrain_, -14.0f, -13.9f), 0.2);
  EXPECT_EQ(terrain_.lowest_m, -14.0f);
  EXPECT_GT(terrain_.highest_m, 20.0f);
  EXPECT_LT(terrain_.highest_m, 60.0f);
}

TEST_P(Island, LiesInTheMiddleWithinItsFloor) {
  const int n = terrain_.grid.samples_x;
  for (int k = 0; k < n; ++k) {
    for (const std::size_t border : {k, (n - 1) * n + k, k * n, k * n + n - 1})
      ASSERT_EQ(terrain_.height_m[border], -14.0f);
  }
  const glm::dvec2 middle = terrain_.grid.min_world + 0.5 * terrain_.grid.size_m();
  EXPECT_NEAR(middle.x, 0.0, 1e-9);
  EXPECT_NEAR(middle.y, 0.0, 1e-9);
  EXPECT_GT(height_at(terrain_, {0, 0}), 5.0f);
}

// Walking out from the middle, every direction meets a beach, then a belt of shallow water.
TEST_P(Island, IsRingedByShallowWater) {
  for (int k = 0; k < 64; ++k) {
    const double angle = 2.0 * 3.14159265358979 * k / 64.0;
    const glm::dvec2 direction(std::cos(angle), std::sin(angle));
    double shore = 0.0, shallow = 0.0;
    for (double r = 500.0; r > 0.0 && shore == 0.0; r -= 0.5) {
      const double height = height_at(terrain_, r * direction);
      if (height > 2.0) shore = r;
      if (height >= -4.0 && height <= -0.5) shallow += 0.5;
    }
    EXPECT_GT(shore, 60.0) << angle;
    EXPECT_LT(shore, 300.0) << angle;
    EXPECT_GT(shallow, 40.0) << angle;
  }
}

TEST_P(Island, HasGentleBeaches) {
  std::vector<float> x(terrain_.height_m.size()), y(x);
  sample_slopes(terrain_, x, y);
  std::vector<float> slopes;
  for (std::size_t k = 0; k < x.size(); ++k)
    if (std::abs(terrain_.height_m[k]) < 1.0f) slopes.push_back(std::hypot(x[k], y[k]));
  std::ranges::sort(slopes);
  ASSERT_FALSE(slopes.empty());
  EXPECT_GT(slopes[slopes.size() / 2], 1.0f / 40.0f);
  EXPECT_LT(slopes[slopes.size() / 2], 1.0f / 15.0f);
  EXPECT_LT(slopes[slopes.size() * 9 / 10], 1.0f / 7.0f);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Island, ::testing::Values(0, 1, 3));

TEST(IslandShape, IsAFunctionOfTheSeed) {
  EXPECT_EQ(build_terrain({.seed = 3}).height_m, island(3).height_m);
  EXPECT_NE(island(3).height_m, island(1).height_m);
}

TEST(IslandShape, IsFiniteAtTheEndsOfTheRanges) {
  struct Ends {
    double radius, height, depth;
  };
  for (const Ends& ends : {Ends{5, 5000, 0.5}, {5, 0, 10000}, {20000, 0, 0.5}}) {
    const HeightGrid terrain = build_terrain({.island_radius_m = ends.radius,
                                              .island_height_m = ends.height,
                                              .floor_depth_m = ends.depth});
    EXPECT_EQ(terrain.lowest_m, static_cast<float>(-ends.depth));
    EXPECT_GT(terrain.highest_m, 0.0f);
    EXPECT_LT(terrain.highest_m, 2.0 * ends.height + 10.0);  // false for NaN
  }
}

TEST(IslandShape, HasItsSizeBeforeItIsMade) {
  const TerrainDescription description{.island_radius_m = 431.0};
  EXPECT_EQ(described_size_m(description), build_terrain(description).grid.size_m());
}

// Land that hangs together, counted on every 8th sample.
int pieces_of_land(const HeightGrid& terrain) {
  constexpr int kStep = 8;
  const int side = (terrain.grid.samples_x - 1) / kStep;
  std::vector<bool> land(static_cast<std::size_t>(side) * side);
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i)
      land[j * side + i] =
          terrain.height_m[static_cast<std::size_t>(j) * kStep * terrain.grid.samples_x +
                           static_cast<std::size_t>(i) * kStep] > 0.0f;
  int pieces = 0;
  std::vector<int> open;
  for (int start = 0; start < side * side; ++start) {
    if (!land[start]) continue;
    ++pieces;
    open.push_back(start);
    while (!open.empty()) {
      const int at = open.back();
      open.pop_back();
      if (!land[at]) continue;
      land[at] = false;
      const int i = at % side, j = at / side;
      if (i > 0) open.push_back(at - 1);
      if (i + 1 < side) open.push_back(at + 1);
      if (j > 0) open.push_back(at - side);
      if (j + 1 < side) open.push_back(at + side);
    }
  }
  return pieces;
}

TEST(Archipelago, HasItsIslandsApartOnItsSquare) {
  const TerrainDescription description{.island_radius_m = 900.0,
                                       .island_height_m = 120.0,
                                       .floor_depth_m = 30.0,
                                       .islands = 12,
                                       .archipelago_size_m = 20000.0};
  const HeightGrid terrain = build_terrain(description);
  EXPECT_EQ(described_size_m(description), 20000.0);
  EXPECT_EQ(terrain.grid.size_m(), 20000.0);
  // Rocks before a coast count, too.
  EXPECT_GE(pieces_of_land(terrain), 12);
  EXPECT_LE(pieces_of_land(terrain), 24);
  EXPECT_EQ(terrain.lowest_m, -30.0f);
  const int n = terrain.grid.samples_x;
  for (int k = 0; k < n; ++k)
    for (const std::size_t border : {k, (n - 1) * n + k, k * n, k * n + n - 1})
      ASSERT_EQ(terrain.height_m[border], -30.0f);
}

// An island that has no room is left out.
TEST(Archipelago, LeavesOutWhatFindsNoRoom) {
  const HeightGrid terrain = build_terrain(
      {.island_radius_m = 900.0, .floor_depth_m = 30.0, .islands = 2, .archipelago_size_m = 100.0});
  EXPECT_EQ(terrain.highest_m, -30.0f);
}

}  // namespace
}  // namespace swell::terrain
