// The land's shadow against rays: a wall's by hand, an island's by walking towards the sun.
#include "render/world/land_shadow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/elementary.h"
#include "math/random.h"
#include "terrain/terrain.h"

namespace swell::render {
namespace {

constexpr double kWaterIndex = 1.333;

glm::dvec3 sun_at(double azimuth_deg, double elevation_deg) {
  const double azimuth = azimuth_deg * kPi / 180.0, elevation = elevation_deg * kPi / 180.0;
  return {std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth),
          std::sin(elevation)};
}

// Sea 5 m deep with a wall from west to east, 40 m high at y = 100 and 8 m broad at its foot.
terrain::HeightGrid wall() {
  terrain::HeightGrid land{{{-200.0, -200.0}, 1.0, 401, 401}};
  for (int j = 0; j < 401; ++j)
    for (int i = 0; i < 401; ++i) {
      const double y = land.grid.point(i, j).y;
      land.height_m.push_back(
          static_cast<float>(std::max(-5.0, 40.0 - 10.0 * std::abs(y - 100.0))));
    }
  land.lowest_m = -5.0f, land.highest_m = 40.0f;
  return land;
}

TEST(LandShadow, OfAWallFallsWhereItsTopStandsBeforeTheSun) {
  Workers workers(2);
  const terrain::HeightGrid land = wall();
  for (const double elevation : {5.0, 15.0, 40.0}) {
    const auto shadow = cast_land_shadow(land, sun_at(0.0, elevation), kWaterIndex, workers);
    ASSERT_TRUE(shadow);
    const auto tangent = [&](double by_rad) { return std::tan(elevation * kPi / 180.0 + by_rad); };
    for (const double away_m : {10.0, 25.0, 60.0, 150.0, 290.0, 350.0, 450.0}) {
      // Nobody asks below the sea floor.
      const double dark = 40.0 - away_m * tangent(kSunRadius_rad);
      const double lit = 40.0 - away_m * tangent(-kSunRadius_rad);
      const ShadowBounds got = shadow_bounds_at(*shadow, {3.7, 100.0 - away_m});
      if (dark > -5.0) {
        EXPECT_NEAR(got.dark_below_m, dark, 0.05) << elevation << " " << away_m;
      }
      if (lit > -5.0) {
        EXPECT_NEAR(got.lit_above_m, lit, 0.05) << elevation << " " << away_m;
      }
      EXPECT_LE(got.dark_below_m, got.lit_above_m);
      if (lit < -5.0) {
        EXPECT_EQ(sun_visible_at(*shadow, {3.7, 100.0 - away_m}, -4.9), 1.0);
      }
    }
    // Before the wall, over it and beside its square it is light.
    for (const glm::dvec2& p : {glm::dvec2(0.0, 120.0), {0.0, 160.0}, {260.0, 90.0}})
      EXPECT_EQ(sun_visible_at(*shadow, p, 0.5), 1.0);
    EXPECT_EQ(sun_visible_at(*shadow, {0.0, 95.0}, 40.1), 1.0);
  }
}

TEST(LandShadow, HalfOfTheSunIsSeenWhereTheTopHalvesIt) {
  Workers workers(2);
  const auto shadow = cast_land_shadow(wall(), sun_at(0.0, 12.0), kWaterIndex, workers);
  const double z = 40.0 - 120.0 * std::tan(12.0 * kPi / 180.0);
  EXPECT_NEAR(sun_visible_at(*shadow, {0.0, -20.0}, z), 0.5, 0.05);
  // The part of a disc above a chord at half the radius: 1/3 - sqrt(3) / (4 pi).
  EXPECT_NEAR(disc_part(0.25f), 1.0 / 3.0 - std::sqrt(3.0) / (4.0 * kPi), 0.01);
  EXPECT_NEAR(disc_part(0.0f), 0.0, 1e-6);
  EXPECT_NEAR(disc_part(1.0f), 1.0, 1e-6);
}

// Whether the land hides a point of the sun at an elevation above the azimuth `sun`.
bool hidden(const terrain::HeightGrid& land, glm::dvec3 p, glm::dvec3 sun, double by_rad) {
  const double level = glm::length(glm::dvec2(sun));
  const double rise = std::tan(std::asin(sun.z) + by_rad);
  for (double way_m = 2.0; way_m < 2000.0; way_m += 0.5) {
    const double z = p.z + way_m * rise;
    if (z > land.highest_m) return false;
    const double height_m =
        terrain::height_at(land, glm::dvec2(p) + glm::dvec2(sun) * (way_m / level));
    if (height_m > std::max(z, 0.0)) return true;
  }
  return false;
}

terrain::HeightGrid island() {
  terrain::TerrainDescription description;
  description.island_height_m = 60.0;
  description.island_radius_m = 130.0;
  return terrain::build_terrain(description);
}

TEST(LandShadow, OfAnIslandIsWhereRaysToTheSunMeetIt) {
  Workers workers(2);
  const terrain::HeightGrid land = island();
  int dark = 0, wrong = 0;
  constexpr int kPoints = 4000;
  for (const double elevation : {4.0, 9.0, 20.0}) {
    const glm::dvec3 sun = sun_at(230.0, elevation);
    const auto shadow = cast_land_shadow(land, sun, kWaterIndex, workers);
    for (int i = 0; i < kPoints; ++i) {
      const auto random = [&](int k) { return random_uniform(5, 3 * i + k); };
      const glm::dvec2 p(500.0 * random(0) - 100.0, 500.0 * random(1) - 100.0);
      const double z = std::max(terrain::height_at(land, p) + 1.0, 0.0) + 10.0 * random(2);
      const bool upper = hidden(land, {p, z}, sun, 2.0 * kSunRadius_rad);
      const bool lower = hidden(land, {p, z}, sun, -2.0 * kSunRadius_rad);
      if (upper != lower) continue;  // at the shadow's edge
      const double visible = sun_visible_at(*shadow, p, z);
      dark += upper;
      wrong += std::abs(visible - (upper ? 0.0 : 1.0)) > 0.02;
    }
  }
  EXPECT_GT(dark, kPoints / 20);
  EXPECT_LE(wrong, 3 * kPoints / 500);
}

TEST(LandShadow, LightsTheGroundAsPointsOnIt) {
  Workers workers(2);
  const terrain::HeightGrid land = island();
  const glm::dvec3 sun = sun_at(90.0, 8.0);
  const auto shadow = cast_land_shadow(land, sun, kWaterIndex, workers);
  ASSERT_EQ(shadow->ground.size, 512);
  // The lowest byte of a word is the sample itself.
  const auto lit = [&](glm::dvec2 p) {
    const glm::dvec2 at = (p - land.grid.min_world) / land.grid.size_m() * 512.0 + 0.5;
    const auto word = static_cast<std::size_t>(at.y) * 512 + static_cast<std::size_t>(at.x);
    return static_cast<std::int8_t>(shadow->ground.words[word + 512u * 512u].fine);
  };
  int east = 0, west = 0, n = 0;
  for (double y = -60.0; y <= 60.0; y += 5.0, ++n) {
    east += lit({170.0, y}) > 120;  // the sun's side
    west += lit({-170.0, y}) < -120;
  }
  EXPECT_GE(east, n - 1);
  EXPECT_GE(west, n / 2);
}

// Snell: light at 60 degrees from the zenith goes on at 40.5.
TEST(LandShadow, LightComesIntoTheWaterAtTheRefractedAngle) {
  const glm::dvec2 slant = underwater_slant(sun_at(90.0, 30.0), kWaterIndex);
  EXPECT_NEAR(slant.x, std::tan(40.52 * kPi / 180.0), 1e-3);
  EXPECT_NEAR(slant.y, 0.0, 1e-9);
}

TEST(LandShadow, IsNoneWithoutSunOrLand) {
  Workers workers(2);
  EXPECT_FALSE(cast_land_shadow(wall(), sun_at(0.0, -1.0), kWaterIndex, workers));
  terrain::HeightGrid floor{{{0.0, 0.0}, 1.0, 65, 65}};
  floor.height_m.assign(65 * 65, -3.0f);
  floor.lowest_m = floor.highest_m = -3.0f;
  const auto none = cast_land_shadow(floor, sun_at(20.0, 0.1), kWaterIndex, workers);
  ASSERT_TRUE(none);
  EXPECT_TRUE(none->is_empty());
  EXPECT_EQ(none->ground.size, 0);
}

TEST(LandShadow, IsTheSameBitsOnAnyThreads) {
  const terrain::HeightGrid land = wall();
  const auto with = [&](int threads) {
    Workers workers(threads);
    return *cast_land_shadow(land, sun_at(33.0, 11.0), kWaterIndex, workers);
  };
  const LandShadow one = with(1);
  for (const int threads : {2, 5}) {
    const LandShadow many = with(threads);
    EXPECT_EQ(many.bounds, one.bounds);
    EXPECT_EQ(many.block_lit_above_m, one.block_lit_above_m);
    EXPECT_EQ(many.ground.words, one.ground.words);
  }
}

}  // namespace
}  // namespace swell::render
