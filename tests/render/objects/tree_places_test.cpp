// Where the trees of a scene stand, against queries of its water.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "ocean/inland/inland_water.h"
#include "render/lake_and_river.h"
#include "render/shot.h"
#include "render/world/forest.h"
#include "render/world/world_state.h"
#include "scene/scene.h"
#include "scene/terrain.h"
#include "scene/water.h"

namespace swell::render {
namespace {

// TRE-02, by queries: no tree stands in a river or lake, of either way to say what a lake is, and
// none of the banks' at a lake.
TEST(TreesOfScenes, StandBesideRiversAndNeitherInNorByLakes) {
  const scene::Scene scene =
      scene::parse_scene(std::string("[wind]\nspeed_mps = 0.0\n") + kLakeAndRiver + R"(
    [[trees]]
    density_per_m2 = 0.05
    ground_m = [0.0, 100.0]
    [[trees]]
    place = "banks"
    species = "reed"
    density_per_m2 = 0.5
    bank_width_m = 8.0
    ground_m = [0.0, 100.0]
)",
                         "banks.toml");
  const World world = world_of(scene);
  const scene::Water water(scene);
  const terrain::Trees& trees = world.state().forest->trees;
  int by_the_river = 0, on_land = 0;
  for (const terrain::Tree& tree : trees.trees) {
    const glm::dvec2 p = glm::dvec2(trees.origin) + glm::dvec2(tree.foot);
    // The line of the water is right to a sample of the land.
    const auto inland = water.inland()->at(p);
    EXPECT_FALSE(inland && inland->depth_m > 0.3f) << p.x << " " << p.y;
    if (tree.species != terrain::TreeSpecies::kReed) {
      ++on_land;
      continue;
    }
    ++by_the_river;
    // The river leaves the lake in the north.
    EXPECT_GT(p.y, -195.0);
    EXPECT_LT(std::abs(p.x), 8.0 + 4.5 + 8.0 + 1.0);
    EXPECT_LT(p.y, 0.0);
  }
  EXPECT_GT(on_land, 500);
  EXPECT_GT(by_the_river, 100);
}

// A bowl whose lake has no outline: it is filled to its level, 50 m from the middle.
struct Bowl {
  static constexpr double kShore_m = 50.0;
  static constexpr double kSpacing_m = 2.0;
  // Shores are known to a cell of the land, across.
  static constexpr double kError_m = 1.42 * kSpacing_m;

  Bowl() {
    land.grid = {{-100.0, -100.0}, kSpacing_m, 101, 101};
    for (int j = 0; j < land.grid.samples_y; ++j)
      for (int i = 0; i < land.grid.samples_x; ++i) {
        const glm::dvec2 p = land.grid.point(i, j);
        land.height_m.push_back(static_cast<float>(0.002 * glm::dot(p, p) + 3.0));
      }
    ocean::Lake lake;
    lake.level_m = 8.0;
    scene.lakes = {lake};
  }
  // How far from the middle each tree stands.
  std::vector<double> distances_m(const terrain::TreeStand& stand) {
    scene.trees = {stand};
    Workers workers(2);
    const ocean::InlandWater inland({{}, scene.lakes}, ocean::fill_lakes(scene.lakes, land), land,
                                    {}, workers);
    const Forest forest = grow_forest(scene, land, &inland, {0.0f, 0.0f, 1.0f}, workers);
    std::vector<double> all;
    for (const terrain::Tree& tree : forest.trees.trees)
      all.push_back(glm::length(glm::dvec2(forest.trees.origin) + glm::dvec2(tree.foot)));
    return all;
  }

  scene::Scene scene;
  terrain::HeightGrid land;
};

TEST(TreesOfScenes, DoNotStandInFilledLakes) {
  Bowl bowl;
  const auto distances =
      bowl.distances_m({.density_per_m2 = 0.05, .clumping = 0.0, .ground_m = {0.0, 100.0}});
  EXPECT_GT(distances.size(), 500u);
  EXPECT_GT(std::ranges::min(distances), Bowl::kShore_m - Bowl::kError_m);
}

TEST(TreesOfScenes, StandAlongLakesIfAskedTo) {
  Bowl bowl;
  terrain::TreeStand stand{.place = terrain::TreePlace::kBanks,
                           .density_per_m2 = 0.2,
                           .clumping = 0.0,
                           .bank_width_m = 10.0,
                           .ground_m = {0.0, 100.0}};
  EXPECT_TRUE(bowl.distances_m(stand).empty());
  stand.lake_shores = true;
  const auto distances = bowl.distances_m(stand);
  ASSERT_GT(distances.size(), 100u);
  EXPECT_GT(std::ranges::min(distances), Bowl::kShore_m - Bowl::kError_m);
  EXPECT_LT(std::ranges::max(distances), Bowl::kShore_m + stand.bank_width_m + Bowl::kError_m);
}

TEST(TreesOfScenes, TooManyAreRefusedWithTheirPlace) {
  const scene::Scene scene = scene::parse_scene(
      "[terrain]\nisland_radius_m = 2000\n[[trees]]\n[[trees]]\ndensity_per_m2 = 10\n",
      "test.toml");
  Workers workers(2);
  try {
    grow_forest(scene, *scene::build_terrain(scene), nullptr, glm::vec3(0.0f, 0.0f, 1.0f), workers);
    FAIL();
  } catch (const scene::SceneError& error) {
    EXPECT_TRUE(std::string(error.what())
                    .starts_with("test.toml:5: column 18: trees[1].density_per_m2, got 10, which "
                                 "makes "))
        << error.what();
  }
}

}  // namespace
}  // namespace swell::render
