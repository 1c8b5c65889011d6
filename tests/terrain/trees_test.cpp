// Where trees stand.
#include "terrain/trees.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "terrain/poisson_tile.h"
#include "terrain/terrain.h"

namespace swell::terrain {
namespace {

// Heights over a square of `size_m` around the origin, by height_m(x, y) [m].
template <class Height>
HeightGrid land_of(double size_m, const Height& height_m) {
  constexpr int n = 257;
  HeightGrid land{{glm::dvec2(-0.5 * size_m), size_m / (n - 1), n, n}};
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const glm::dvec2 p = land.grid.point(i, j);
      land.height_m.push_back(static_cast<float>(height_m(p.x, p.y)));
    }
  return land;
}

HeightGrid plain(double size_m) {
  return land_of(size_m, [](double, double) { return 10.0; });
}

// The sea in the west, a plane beach, land in the east.
HeightGrid beach(double size_m) {
  return land_of(size_m, [](double x, double) { return 0.1 * x; });
}

TreeStand even_stand(double density_per_m2) {
  TreeStand stand;
  stand.density_per_m2 = density_per_m2;
  stand.clumping = 0.0;
  return stand;
}

Trees plant(const TreeStand& stand, const HeightGrid& land, const WaterLines& lines = {},
            int threads = 2) {
  Workers workers(threads);
  return plant_trees(std::span(&stand, 1), land, lines, workers);
}

glm::dvec2 place_of(const Trees& trees, const Tree& tree) {
  return glm::dvec2(trees.origin) + glm::dvec2(tree.foot);
}

double least_distance(std::vector<glm::dvec2> p) {
  std::ranges::sort(p, {}, &glm::dvec2::x);
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t k = i + 1; k < p.size() && p[k].x - p[i].x < least; ++k)
      least = std::min(least, glm::distance(p[i], p[k]));
  return least;
}

TEST(PoissonTile, FirstPointsKeepTheirDistanceAcrossBorders) {
  const std::vector<glm::dvec2> tile = make_poisson_tile(5);
  ASSERT_EQ(tile.size(), kPoissonPoints);
  for (const std::size_t n : {2u, 9u, 100u, 1000u, 4096u}) {
    std::vector<glm::dvec2> repeated;
    for (std::size_t k = 0; k < n; ++k)
      for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) repeated.push_back(tile[k] + glm::dvec2(i, j));
    EXPECT_GE(least_distance(repeated), kPoissonSpacing / std::sqrt(static_cast<double>(n)));
  }
}

TEST(PoissonTile, LeavesNoHoles) {
  const std::vector<glm::dvec2> tile = make_poisson_tile(5);
  for (const std::size_t n : {256u, 4096u}) {
    double farthest = 0.0;
    for (int j = 0; j < 64; ++j)
      for (int i = 0; i < 64; ++i) {
        const glm::dvec2 p(i / 64.0, j / 64.0);
        double nearest = HUGE_VAL;
        for (std::size_t k = 0; k < n; ++k) {
          const glm::dvec2 d = glm::abs(p - tile[k]);
          nearest = std::min(nearest, glm::length(glm::min(d, 1.0 - d)));
        }
        farthest = std::max(farthest, nearest);
      }
    // In a grid of triangles, the most even of all, it is 0.62 / sqrt(n).
    EXPECT_LT(farthest, 1.15 / std::sqrt(static_cast<double>(n)));
  }
}

TEST(Trees, KeepTheirDistanceAndNumber) {
  constexpr double kDensity = 0.02, kSize_m = 2000.0;  // four and a half tiles a side
  const Trees trees = plant(even_stand(kDensity), plain(kSize_m));
  std::vector<glm::dvec2> p;
  for (const Tree& tree : trees.trees) p.push_back(place_of(trees, tree));
  EXPECT_GE(least_distance(p), 0.9999 * poisson_distance_m(kDensity));
  EXPECT_NEAR(static_cast<double>(p.size()) / (kDensity * kSize_m * kSize_m), 1.0, 0.03);
}

TEST(Trees, OfLowRanksAreAsEvenAsAll) {
  const Trees trees = plant(even_stand(0.02), plain(1500.0));
  for (const float part : {0.1f, 0.4f}) {
    std::vector<glm::dvec2> p;
    for (const Tree& tree : trees.trees)
      if (tree.rank < part) p.push_back(place_of(trees, tree));
    const double found = static_cast<double>(p.size()) / static_cast<double>(trees.trees.size());
    EXPECT_NEAR(found, part, 0.02);
    EXPECT_GE(least_distance(p), 0.9999 * poisson_distance_m(0.02 * part));
  }
}

TEST(Trees, AreTheSameOnAnyThreads) {
  TreeStand stand;
  stand.density_per_m2 = 0.01;
  const HeightGrid land = beach(1000.0);
  const Trees a = plant(stand, land, {}, 1), b = plant(stand, land, {}, 3);
  ASSERT_EQ(a.trees.size(), b.trees.size());
  ASSERT_GT(a.trees.size(), 100u);
  for (std::size_t i = 0; i < a.trees.size(); ++i) {
    EXPECT_EQ(a.trees[i].foot, b.trees[i].foot);
    EXPECT_EQ(a.trees[i].random, b.trees[i].random);
  }
}

TEST(Trees, LieInTheirCellsSortedByRank) {
  const Trees trees = plant(even_stand(0.02), plain(600.0));
  std::size_t counted = 0;
  for (const TreeCell& cell : trees.cells) {
    EXPECT_EQ(cell.first, counted);
    counted += cell.count;
    float before = 0.0f;
    for (std::uint32_t i = cell.first; i < cell.first + cell.count; ++i) {
      const Tree& tree = trees.trees[i];
      EXPECT_GE(tree.rank, before);
      before = tree.rank;
      const glm::vec3 top = tree.foot + glm::vec3(0.0f, 0.0f, tree.height_m);
      EXPECT_LE(glm::distance(tree.foot, cell.middle), cell.radius_m);
      EXPECT_LE(glm::distance(top, cell.middle), cell.radius_m);
    }
  }
  EXPECT_EQ(counted, trees.trees.size());
}

TEST(Trees, StandOnGroundThatSuitsThem) {
  TreeStand stand = even_stand(0.02);
  stand.ground_m = {5.0, 20.0};
  stand.steepest = 0.2;
  // A slope of 0.1, north of the middle of 0.4.
  const HeightGrid land =
      land_of(800.0, [](double x, double y) { return (y > 0.0 ? 0.4 : 0.1) * x; });
  const Trees trees = plant(stand, land);
  ASSERT_GT(trees.trees.size(), 100u);
  for (const Tree& tree : trees.trees) {
    const glm::dvec2 p = place_of(trees, tree);
    EXPECT_NEAR(tree.foot.z, height_at(land, p), 1e-3);
    EXPECT_GE(tree.foot.z, 5.0f);
    EXPECT_LE(tree.foot.z, 20.0f);
    EXPECT_LT(p.y, land.grid.spacing_m);
  }
}

TEST(Trees, NeverStandInWater) {
  TreeStand stand = even_stand(0.05);
  stand.ground_m = {0.0, 9000.0};
  const Trees trees = plant(stand, beach(600.0));
  ASSERT_GT(trees.trees.size(), 100u);
  for (const Tree& tree : trees.trees) EXPECT_GT(tree.foot.z, 0.0f);
}

// A river along y = 0, 20 m wide, that ends in the sea of beach().
HeightGrid river_distance(const HeightGrid& land) {
  HeightGrid distance = land;
  for (int j = 0; j < land.grid.samples_y; ++j)
    for (int i = 0; i < land.grid.samples_x; ++i)
      distance.height_m[land.grid.index(i, j)] =
          static_cast<float>(std::abs(land.grid.point(i, j).y) - 10.0);
  return distance;
}

TEST(TreesOfBanks, StandAlongRiversAndNotAlongTheSea) {
  TreeStand stand = even_stand(0.1);
  stand.place = TreePlace::kBanks;
  stand.bank_width_m = 15.0;
  stand.ground_m = {0.0, 9000.0};
  const HeightGrid land = beach(800.0), river = river_distance(land);
  const HeightGrid sea = distance_from_sea(land);
  EXPECT_TRUE(plant(stand, land, {.still = &sea}).empty());
  const Trees trees = plant(stand, land, {.rivers = &river, .still = &sea});
  ASSERT_GT(trees.trees.size(), 500u);
  for (const Tree& tree : trees.trees) {
    const glm::dvec2 p = place_of(trees, tree);
    EXPECT_GT(std::abs(p.y), 10.0);
    EXPECT_LE(std::abs(p.y), 25.0);
    EXPECT_GT(p.x, stand.bank_width_m - 2.0 * land.grid.spacing_m);
  }
}

TEST(TreesOfBanks, StandAlongTheSeaIfAskedTo) {
  TreeStand stand = even_stand(0.1);
  stand.place = TreePlace::kBanks;
  stand.lake_shores = true;
  stand.bank_width_m = 15.0;
  stand.ground_m = {0.0, 9000.0};
  const HeightGrid land = beach(800.0), sea = distance_from_sea(land);
  const Trees trees = plant(stand, land, {.still = &sea});
  ASSERT_GT(trees.trees.size(), 500u);
  for (const Tree& tree : trees.trees)
    EXPECT_LE(place_of(trees, tree).x, stand.bank_width_m + land.grid.spacing_m);
}

TEST(WaterLines, DistanceFromTheSeaIsThatOfTheNearestWater) {
  const HeightGrid land = land_of(400.0, [](double x, double y) {
    return std::min(std::hypot(x - 60.0, y) - 30.0, std::hypot(x + 80.0, y - 50.0) - 55.0);
  });
  const HeightGrid distance = distance_from_sea(land);
  for (int j = 0; j < land.grid.samples_y; j += 8)
    for (int i = 0; i < land.grid.samples_x; i += 8) {
      const std::size_t at = land.grid.index(i, j);
      const double expected = std::max(static_cast<double>(land.height_m[at]), 0.0);
      EXPECT_NEAR(distance.height_m[at], expected, 1.5 * land.grid.spacing_m);
    }
}

TEST(Trees, OfTheLeastDensitiesThereAreNone) {
  for (const double density_per_m2 : {5e-324, 1e-308, 1e-305, 1e-300, 1e-30})
    EXPECT_TRUE(plant(even_stand(density_per_m2), plain(1000.0)).empty()) << density_per_m2;
}

TEST(Trees, TooManyAreRefusedInOneLine) {
  const auto fault_of = [](double density_per_m2, double size_m) -> std::string {
    try {
      plant(even_stand(density_per_m2), plain(size_m));
    } catch (const TerrainError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(fault_of(0.1, 1000.0), "");
  EXPECT_EQ(fault_of(10.0, 2000.0),
            "trees[0].density_per_m2, got 10, which makes 4.1e+07 places for trees, allowed at "
            "most 2e+07 of all stands");
  EXPECT_NE(fault_of(1.2, 1000.0).find("trees of all stands, allowed at most 1000000"),
            std::string::npos);
}

}  // namespace
}  // namespace swell::terrain
