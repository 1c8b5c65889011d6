// What land sends back: the reflectance of what covers it, by the incidence, from any range.
#include "render/measure/lidar_ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/random.h"
#include "render/labels/label_channels.h"
#include "render/measure/lidar.h"
#include "render/shot.h"
#include "render/world/world_state.h"
#include "terrain/height_grid.h"

namespace swell::render {
namespace {

constexpr double kBeachSlope = 0.1;
constexpr glm::vec3 kWhiteSand{0.7f, 0.6f, 0.4f};

// A beach that rises to the south from y = 0, of bare sand without a lee or anything on it.
scene::Scene beach() {
  scene::Scene scene;
  scene.sea.wind_speed_mps = 0.0;
  scene.terrain.emplace();
  scene.terrain->coast_m = {{-500.0, 0.0}, {500.0, 0.0}};
  scene.terrain->beach_slope = kBeachSlope;
  scene.terrain->ground.sand = kWhiteSand;
  scene.terrain->ground.grass_from_m = 1000.0;
  return scene;
}

// Returns from the land at places, each by a beam from the eye.
std::vector<LidarReturn> seen_from(const World& world, glm::dvec3 eye,
                                   const std::vector<glm::dvec2>& places) {
  std::vector<LidarBeam> beams;
  for (const glm::dvec2& p : places) {
    const glm::dvec3 d = glm::dvec3(p, terrain::height_at(*world.state().terrain, p)) - eye;
    beams.push_back({std::atan2(d.y, d.x), std::atan2(d.z, std::hypot(d.x, d.y))});
  }
  std::vector<LidarReturn> returns(beams.size());
  Workers workers(2);
  Lidar(world, workers).scan({.begin = {eye}, .beams = beams, .most_m = 500.0}, returns, workers);
  for (const LidarReturn& r : returns) EXPECT_EQ(r.id, kLandId);
  return returns;
}

// Intensities over the cosine of the incidence, of places from `low_m` to `high_m` above the sea.
std::vector<double> reflectances(const scene::Scene& scene, double low_m, double high_m) {
  std::vector<glm::dvec2> places;
  for (std::uint64_t n = 0; n < 200; ++n)
    places.emplace_back(80.0 * random_uniform(1, 2 * n) - 40.0,
                        -(low_m + (high_m - low_m) * random_uniform(1, 2 * n + 1)) / kBeachSlope);
  std::vector<double> result;
  for (const LidarReturn& r : seen_from(world_of(scene), {0.0, -20.0, 40.0}, places))
    result.push_back(r.intensity / std::cos(static_cast<double>(r.incidence_rad)));
  return result;
}

void expect_all(const std::vector<double>& values, double low, double high) {
  for (const double value : values) {
    EXPECT_GE(value, low);
    EXPECT_LE(value, high);
  }
}

TEST(LidarGround, DrySandReflectsItsRedAndWetSandHalfOfThat) {
  expect_all(reflectances(beach(), 0.71, 3.0), 0.699, 0.701);
  expect_all(reflectances(beach(), 0.02, 0.099), 0.349, 0.351);
  expect_all(reflectances(beach(), 0.1, 0.7), 0.349, 0.701);
}

TEST(LidarGround, RockReflectsItsRed) {
  scene::Scene scene = beach();
  scene.terrain->beach_slope = 0.3;
  scene.terrain->ground.rock_slope = 0.05;
  scene.terrain->ground.rock = {0.25f, 0.5f, 0.5f};
  expect_all(reflectances(scene, 0.3, 0.9), 0.249, 0.251);
}

// Grass sends back 0.45, straw 0.4, whatever their greens; bare soil between them as given.
TEST(LidarGround, WhatGrowsReflectsAsLeavesDo) {
  scene::Scene scene = beach();
  scene.terrain->ground.grass_from_m = 0.0;
  scene.terrain->ground.rock_slope = 100.0;
  scene.terrain->ground.soil = scene.terrain->ground.sand = {0.42f, 0.0f, 0.0f};
  const std::vector<double> found = reflectances(scene, 5.0, 7.0);
  expect_all(found, 0.399, 0.451);
  EXPECT_LT(*std::ranges::min_element(found), 0.43);
  EXPECT_GT(*std::ranges::max_element(found), 0.43);
}

TEST(LidarGround, WhiteCoversAreSnow) {
  scene::Scene scene = beach();
  terrain::GroundMaterials& ground = scene.terrain->ground;
  ground.sand = ground.grass = ground.dry = ground.soil = ground.rock = glm::vec3(0.85f);
  ground.grass_from_m = 1.0;
  expect_all(reflectances(scene, 0.71, 7.0), 0.849, 0.851);
}

TEST(LidarGround, SquaresReflectAsTheyAreDrawn) {
  scene::Scene scene = beach();
  scene.terrain->checker_m = 5.0;
  const std::vector<LidarReturn> r =
      seen_from(world_of(scene), {0.0, -20.0, 40.0},
                {{2.0, -12.0}, {7.0, -12.0}, {-2.0, -12.0}, {7.0, -17.0}, {2.0, -17.0}});
  const auto reflectance = [&](std::size_t n) {
    return r[n].intensity / std::cos(static_cast<double>(r[n].incidence_rad));
  };
  EXPECT_NEAR(reflectance(0), 0.06, 1e-4) << "columns 0, row -3";
  EXPECT_NEAR(reflectance(1), 0.8, 1e-4);
  EXPECT_NEAR(reflectance(2), 0.8, 1e-4);
  EXPECT_NEAR(reflectance(3), 0.06, 1e-4);
  EXPECT_NEAR(reflectance(4), 0.8, 1e-4);
}

// A matt plane: the cosine between the beam and the ground's normal, at any range.
TEST(LidarGround, IntensitiesFollowTheCosineAndNotTheRange) {
  const World world = world_of(beach());
  const glm::dvec2 place(3.0, -15.0), aside(0.05, 0.0), ahead(0.0, 0.05);
  const auto height = [&](glm::dvec2 at) { return terrain::height_at(*world.state().terrain, at); };
  const glm::dvec3 p(place, height(place));
  const glm::dvec3 normal =
      glm::normalize(glm::dvec3(height(place - aside) - height(place + aside),
                                height(place - ahead) - height(place + ahead), 0.1));
  for (const double tilt_rad : {0.0, 0.4, 0.8, 1.2, 1.35}) {
    const glm::dvec3 to_eye =
        std::cos(tilt_rad) * normal +
        std::sin(tilt_rad) * glm::normalize(glm::cross(normal, glm::dvec3(0.0, 1.0, 0.0)));
    for (const double range_m : {5.0, 30.0, 120.0}) {
      const LidarReturn r = seen_from(world, p + range_m * to_eye, {place}).front();
      EXPECT_NEAR(r.range_m, range_m, 2e-3);
      EXPECT_NEAR(r.incidence_rad, tilt_rad, 2e-3) << range_m;
      EXPECT_NEAR(r.intensity, 0.7 * std::cos(tilt_rad), 1e-3) << range_m;
    }
  }
}

}  // namespace
}  // namespace swell::render
