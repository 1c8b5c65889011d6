// Rays to the ground against closed forms and against fine marching over height_at().
#include "terrain/ground_rays.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/random.h"

namespace swell::terrain {
namespace {

HeightGrid plane(double slope_x, double slope_y) {
  HeightGrid ground{{{-40.0, -40.0}, 2.0, 41, 33}, {}};
  for (int j = 0; j < 33; ++j)
    for (int i = 0; i < 41; ++i) {
      const glm::dvec2 p = ground.grid.point(i, j);
      ground.height_m.push_back(static_cast<float>(slope_x * p.x + slope_y * p.y));
    }
  return ground;
}

// Steps of up to 3 m from sample to sample, which lie 1.5 m apart.
HeightGrid rough() {
  HeightGrid ground{{{-30.0, -20.0}, 1.5, 45, 38}, {}};
  for (std::uint64_t n = 0; n < 45 * 38; ++n)
    ground.height_m.push_back(static_cast<float>(3.0 * random_uniform(1, n)));
  return ground;
}

// In steps of 2 mm; nothing where it never comes below.
std::optional<double> marched(const HeightGrid& ground, glm::dvec3 origin, glm::dvec3 along,
                              double farthest_m) {
  for (double s = 0.0; s <= farthest_m; s += 0.002) {
    const glm::dvec3 p = origin + s * along;
    if (p.z <= height_at(ground, glm::dvec2(p))) return s;
  }
  return std::nullopt;
}

TEST(GroundRays, MeetAPlaneWhereItIs) {
  const HeightGrid ground = plane(0.25, -0.125);
  const GroundRays rays(ground);
  for (std::uint64_t n = 0; n < 1000; ++n) {
    const glm::dvec2 from(60.0 * random_uniform(2, 2 * n) - 30.0,
                          50.0 * random_uniform(2, 2 * n + 1) - 30.0);
    const glm::dvec3 origin(from, 12.0 + 0.25 * from.x - 0.125 * from.y);
    const glm::dvec3 along = glm::normalize(glm::dvec3(random_uniform(3, 3 * n) - 0.5,
                                                       random_uniform(3, 3 * n + 1) - 0.5,
                                                       -0.1 - random_uniform(3, 3 * n + 2)));
    const double closing = 0.25 * along.x - 0.125 * along.y - along.z;
    const double s = 12.0 / closing;
    if (closing <= 0.0 || !ground.grid.holds(glm::dvec2(origin + s * along))) continue;
    const auto met = rays.meet(origin, along, 1000.0);
    ASSERT_TRUE(met) << n;
    EXPECT_NEAR(*met, s, 1e-6);
    EXPECT_FALSE(rays.meet(origin, along, 0.999 * s));
  }
}

TEST(GroundRays, MeetFirstWhatFineMarchingFinds) {
  const HeightGrid ground = rough();
  const GroundRays rays(ground);
  int met_count = 0;
  for (std::uint64_t n = 0; n < 400; ++n) {
    // From all around, over the border as well.
    const glm::dvec3 origin(120.0 * random_uniform(4, 3 * n) - 60.0,
                            100.0 * random_uniform(4, 3 * n + 1) - 50.0,
                            3.2 + 4.0 * random_uniform(4, 3 * n + 2));
    const glm::dvec3 to(60.0 * random_uniform(5, 2 * n) - 28.0,
                        50.0 * random_uniform(5, 2 * n + 1) - 18.0, 1.0);
    const glm::dvec3 along = glm::normalize(to - origin);
    const double farthest_m = 1.5 * glm::distance(to, origin);
    const auto met = rays.meet(origin, along, farthest_m);
    const auto expected = marched(ground, origin, along, farthest_m);
    if (!expected) {  // but for a tip between two steps
      const double s = met.value_or(0.0);
      EXPECT_TRUE(!met || marched(ground, origin + (s - 1e-3) * along, along, 2e-3)) << n;
      continue;
    }
    if (!met || *met > *expected + 1e-6) {  // past a narrow bump beyond the map
      EXPECT_FALSE(ground.grid.holds(glm::dvec2(origin + *expected * along))) << n;
      double end = *expected;
      while ((origin + end * along).z <= height_at(ground, glm::dvec2(origin + end * along)))
        end += 0.002;
      EXPECT_LT(end - *expected, 0.5 * ground.grid.spacing_m + 0.2) << n;
      continue;
    }
    ++met_count;
    const glm::dvec3 p = origin + *met * along;
    EXPECT_NEAR(p.z, height_at(ground, glm::dvec2(p)), 1e-6) << n;
    // Sooner only in a tip that is narrower than a step.
    const glm::dvec3 beyond = origin + (*met + 0.002) * along;
    EXPECT_TRUE(*met > *expected - 0.0021 || beyond.z > height_at(ground, glm::dvec2(beyond))) << n;
  }
  EXPECT_GT(met_count, 300);
}

TEST(GroundRays, MeetTheApronBeyondTheMap) {
  HeightGrid ground = plane(0.0, 0.0);
  ground.apron = {40.0, -10.0};
  ground.highest_m = 0.0f;
  const GroundRays rays(ground);
  for (const double x : {45.0, 60.0, 90.0, 300.0}) {
    const auto met = rays.meet({x, 0.0, 5.0}, {0.0, 0.0, -1.0}, 100.0);
    ASSERT_TRUE(met) << x;
    EXPECT_NEAR(*met, 5.0 - height_at(ground, {x, 0.0}), 1e-6) << x;
  }
  const glm::dvec3 along = glm::normalize(glm::dvec3(1.0, 0.2, -0.05));
  const auto slanting = rays.meet({0.0, 0.0, 5.0}, along, 1000.0);
  const auto expected = marched(ground, {0.0, 0.0, 5.0}, along, 1000.0);
  ASSERT_TRUE(slanting && expected);
  EXPECT_NEAR(*slanting, *expected, 0.003);
}

TEST(GroundRays, BeginAboveTheGround) {
  const HeightGrid ground = plane(0.0, 0.0);
  const GroundRays rays(ground);
  EXPECT_FALSE(rays.meet({0.0, 0.0, -1.0}, {0.0, 0.0, -1.0}, 100.0));
  EXPECT_FALSE(rays.meet({0.0, 0.0, -1.0}, {0.0, 0.0, 1.0}, 100.0));
  EXPECT_FALSE(rays.meet({0.0, 0.0, 1.0}, {0.0, 0.0, 1.0}, 100.0));
  EXPECT_TRUE(rays.meet({0.0, 0.0, 1.0}, {0.0, 0.0, -1.0}, 100.0));
}

TEST(SteepestBetween, IsThatOfTheSamplesThere) {
  HeightGrid ground = plane(0.3, 0.4);
  EXPECT_NEAR(steepest_between(ground, -100.0, 100.0), 0.5, 1e-5);
  EXPECT_EQ(steepest_between(ground, 500.0, 600.0), 0.0);
  ground.height_m[ground.grid.index(20, 20)] += 50.0f;  // a spike, far over the rest
  EXPECT_GT(steepest_between(ground, -100.0, 100.0), 25.0);
  EXPECT_NEAR(steepest_between(ground, -20.0, -10.0), 0.5, 1e-5);
}

}  // namespace
}  // namespace swell::terrain
