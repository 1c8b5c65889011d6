#include "ocean/inland/inland_water.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/random.h"
#include "ocean/below/sea_below.h"
#include "ocean/inland/river_bed.h"
#include "ocean/water_surface.h"

namespace swell::ocean {
namespace {

// Land that falls to the east, through the sea's level at x = 380, with waves of hills.
terrain::HeightGrid hilly_land() {
  terrain::HeightGrid land{{{-512.0, -512.0}, 4.0, 257, 257}};
  for (int j = 0; j < 257; ++j)
    for (int i = 0; i < 257; ++i) {
      const glm::dvec2 p = land.grid.point(i, j);
      const double hills = 3.0 * std::sin(p.x / 60.0) * std::cos(p.y / 45.0);
      land.height_m.push_back(
          static_cast<float>(0.03 * (380.0 - p.x) + (p.x < 300.0 ? hills : 0.0)));
    }
  land.lowest_m = *std::ranges::min_element(land.height_m);
  land.highest_m = *std::ranges::max_element(land.height_m);
  return land;
}

std::vector<River> rivers() {
  River main;
  main.name = "main";
  main.from = "lake";
  main.path_m = {{-330, 10}, {-150, 60}, {0, -40}, {150, 40}, {300, 0}, {440, 0}};
  main.width_m = {20, 16, 14, 20, 26, 40};
  main.depth_m = {1.5};
  main.surface_m = {20, 15, 11, 6, 0.8, 0};
  River brook;
  brook.into = "main";
  brook.path_m = {{-60, 330}, {30, 200}, {90, 90}, {140, 35}};
  brook.width_m = {8};
  brook.depth_m = {0.6};
  brook.surface_m = {16, 13, 9, 6.5};
  brook.speed_mps = 1.2;
  return {main, brook};
}

std::vector<Lake> lakes() {
  Lake lake;
  lake.name = "lake";
  lake.level_m = 20.0;
  lake.outline_m = {{-430, -40}, {-330, -30}, {-310, 30}, {-400, 60}};
  lake.depth_m = 3.0;
  return {lake};
}

struct Country {
  Country() {
    land = hilly_land();
    Workers workers(2);
    dig_beds(network, land);
    inland.emplace(network, LakeFill{}, land, std::span<const Obstacle>(), workers);
  }

  RiverNetwork network{rivers(), lakes()};
  terrain::HeightGrid land;
  std::optional<InlandWater> inland;
};

const Country& country() {
  static const Country made;
  return made;
}

// Places all over the rivers' reach.
std::vector<glm::dvec2> places(int count) {
  std::vector<glm::dvec2> p;
  for (int n = 0; n < count; ++n)
    p.emplace_back(-450.0 + 880.0 * random_uniform(7, 2 * n),
                   -100.0 + 450.0 * random_uniform(7, 2 * n + 1));
  return p;
}

TEST(InlandWater, BedsLieBelowTheSurfaceEverywhereAndBanksAboveIt) {
  int wet = 0, banks = 0;
  for (const glm::dvec2& p : places(60000)) {
    const auto place = country().network.water_near(p);
    if (!place || place->sea_share > 0.0) continue;
    const double ground_m = terrain::height_at(country().land, p);
    if (place->outside_m < 0.0) {
      EXPECT_LT(ground_m, place->level_m - 0.01) << p.x << " " << p.y;
      ++wet;
    }
    // As far away from the water as cells of it are drawn.
    if (place->outside_m > 9.5 && place->outside_m < 10.5) {
      EXPECT_GT(ground_m, place->level_m - 0.05) << p.x << " " << p.y;
      ++banks;
    }
  }
  EXPECT_GT(wet, 2000);
  EXPECT_GT(banks, 200);
}

TEST(InlandWater, SurfaceFallsAllTheWayToTheSea) {
  const Course& course = country().network.courses()[0];
  double above_m = HUGE_VAL;
  for (double s_m = 0.0; s_m < course.length_m() - 15.0; s_m += 5.0) {
    const auto sample = country().inland->at(node_at(course, s_m).p);
    ASSERT_TRUE(sample) << s_m;
    EXPECT_LE(sample->level_m, above_m + 1e-3);
    above_m = sample->level_m;
  }
  EXPECT_NEAR(above_m, 0.0, 0.03);
  EXPECT_NEAR(country().inland->at({-380.0, 10.0})->level_m, 20.0, 1e-4);  // the lake
}

TEST(InlandWater, VelocitiesAreThoseOfTheFlow) {
  const RiverFlow flow(country().network);
  for (double s_m = 120.0; s_m < 500.0; s_m += 7.0) {
    const CourseNode node = node_at(country().network.courses()[0], s_m);
    const InlandSample sample = *country().inland->at(node.p);
    const glm::dvec2 v = flow.velocity(node.p);
    EXPECT_NEAR(sample.east_mps, v.x, 0.03 * glm::length(v) + 0.01);
    EXPECT_NEAR(sample.north_mps, v.y, 0.03 * glm::length(v) + 0.01);
  }
}

TEST(InlandWater, QueriesGiveLevelWavesAndCurrentOfWhateverWaterIsThere) {
  SeaDescription description;
  description.wind_speed_mps = 8.0;
  description.resolution = 64;
  description.patch_lengths_m = {180.0, 27.0};
  const Sea sea(description);
  Workers workers(2);
  SeaFrame frame;
  advance(sea, 3.0, frame, workers);
  WaterParts parts{&sea, {}, &country().land, nullptr, {}, nullptr, &*country().inland};
  const WaterSurface water(parts, frame);
  // In the river: no wave of the sea.
  const CourseNode node = node_at(country().network.courses()[0], 300.0);
  EXPECT_EQ(water.height(node.p), country().inland->at(node.p)->level_m);
  glm::vec2 current;
  water.currents({&node.p, 1}, {&current, 1});
  EXPECT_GT(glm::dot(glm::dvec2(current), node.along), 0.2);
  EXPECT_TRUE(water.in_water({node.p, node.level_m - 0.2}));
  EXPECT_FALSE(water.in_water({node.p, node.level_m + 0.2}));
  const auto hit = water.intersect({node.p, node.level_m + 5.0}, {0.0, 0.0, -1.0}, 50.0);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->p_world.z, node.level_m, 1e-3);
  // On dry land and at sea: as without rivers.
  WaterParts sea_parts = parts;
  sea_parts.inland = nullptr;
  const WaterSurface open_sea(sea_parts, frame);
  for (const glm::dvec2& p : {glm::dvec2(100.0, -200.0), {470.0, 200.0}, {900.0, 0.0}})
    EXPECT_EQ(water.height(p), open_sea.height(p));
}

TEST(InlandWater, RiversFlowAlikeOnTheirWholeDepth) {
  SeaDescription calm;
  calm.spectrum = false;
  const Sea sea(calm);
  SeaBelow now({&sea, {}, &country().land, nullptr, {}, nullptr, &*country().inland}, 3.0);
  const CourseNode node = node_at(country().network.courses()[0], 300.0);
  glm::vec2 current;
  now.surface().currents({&node.p, 1}, {&current, 1});
  const double ground = terrain::height_at(country().land, node.p);
  const double surface = now.surface().height(node.p);
  ASSERT_GT(surface, ground + 0.2);
  for (const double z : {surface, 0.5 * (surface + ground), ground + 0.01}) {
    const WaterMotion m = now.motion({node.p, z});
    EXPECT_EQ(m.place, MotionPlace::kInWater);
    EXPECT_EQ(m.velocity_mps, glm::vec3(current, 0.0f));
    EXPECT_EQ(m.pressure_pa, 0.0f);
  }
  EXPECT_EQ(now.motion({node.p, ground - 0.1}).place, MotionPlace::kInGround);
  EXPECT_EQ(now.motion({node.p, surface + 0.1}).place, MotionPlace::kAbove);
}

TEST(InlandWater, RefusesLakesAboveTheirRimsAndRiversThatEndOnLand) {
  const terrain::HeightGrid land = hilly_land();
  std::vector<Lake> high = lakes();
  high[0].level_m = 30.0;
  EXPECT_THROW(fill_lakes(high, land), RiverError);
  Lake filled;
  filled.level_m = 5.0;
  filled.position_m = {350.0, 0.0};  // runs into the sea and off the map
  EXPECT_THROW(fill_lakes({&filled, 1}, land), RiverError);
  filled.position_m = {-400.0, 0.0};  // a dry place
  EXPECT_THROW(fill_lakes({&filled, 1}, land), RiverError);
  std::vector<River> dry = rivers();
  dry[0].path_m.back() = {340.0, 10.0};
  terrain::HeightGrid dug = land;
  EXPECT_THROW(dig_beds({dry, lakes()}, dug), RiverError);
}

TEST(InlandWater, LakesFillTheLandUpToTheirLevelAndNoFurther) {
  terrain::HeightGrid land{{{-100.0, -100.0}, 4.0, 51, 51}};
  for (int j = 0; j < 51; ++j)
    for (int i = 0; i < 51; ++i)
      land.height_m.push_back(
          static_cast<float>(0.002 * glm::dot(land.grid.point(i, j), land.grid.point(i, j)) + 3.0));
  Lake lake;
  lake.level_m = 8.0;  // a disc of radius 50
  const LakeFill fill = fill_lakes({&lake, 1}, land);
  Workers workers(1);
  const RiverNetwork network({}, {&lake, 1});
  const InlandWater inland(network, fill, land, {}, workers);
  EXPECT_NEAR(inland.at({0.0, 0.0})->level_m, 8.0, 1e-6);
  EXPECT_NEAR(inland.at({20.0, 10.0})->depth_m, 4.0, 0.05);
  EXPECT_GT(inland.at({48.0, 0.0})->depth_m, 0.0f);
  EXPECT_FALSE(inland.at({70.0, 0.0}));
}

}  // namespace
}  // namespace swell::ocean
