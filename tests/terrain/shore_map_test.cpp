// Distances to the water line, against lines whose distance is known and against all of its points.
#include "terrain/shore_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "math/random.h"

namespace swell::terrain {
namespace {

// Heights on 129 x 129 points, 2 m apart, about the origin.
HeightGrid make_land(const std::function<double(glm::dvec2)>& height_m) {
  HeightGrid land{
      {.min_world = {-128.0, -128.0}, .spacing_m = 2.0, .samples_x = 129, .samples_y = 129}};
  for (int j = 0; j < 129; ++j)
    for (int i = 0; i < 129; ++i)
      land.height_m.push_back(static_cast<float>(height_m(land.grid.point(i, j))));
  return land;
}

glm::dvec2 random_place(std::uint64_t n) {
  return {random_uniform(5, 2 * n) * 220.0 - 110.0, random_uniform(5, 2 * n + 1) * 220.0 - 110.0};
}

TEST(ShoreMap, KnowsTheDistanceToAStraightShore) {
  Workers workers(2);
  const glm::dvec2 inland(0.6, 0.8);
  const ShoreMap shore(make_land([&](glm::dvec2 p) { return 0.05 * glm::dot(p, inland); }),
                       workers);
  ASSERT_TRUE(shore.has_line());
  for (std::uint64_t n = 0; n < 300; ++n) {
    // The nearest point of the line has to be on the map.
    const glm::dvec2 p = 0.5 * random_place(n);
    const ShorePoint at = shore.sample(p.x, p.y);
    // The points that are asked are at most half a cell's diagonal from the nearest on the line.
    EXPECT_NEAR(at.signed_distance_m, -glm::dot(p, inland), 0.6);
    EXPECT_NEAR(at.height_m, 0.05 * glm::dot(p, inland), 1e-5);
    if (std::abs(at.signed_distance_m) < 6.0f) continue;
    EXPECT_GT(glm::dot(glm::dvec2(at.towards_shore), inland), std::cos(0.1));
  }
}

TEST(ShoreMap, KnowsTheDistanceToARoundIsland) {
  Workers workers(1);
  const ShoreMap shore(make_land([](glm::dvec2 p) { return 0.1 * (70.0 - glm::length(p)); }),
                       workers);
  for (std::uint64_t n = 0; n < 300; ++n) {
    const glm::dvec2 p = random_place(n);
    const ShorePoint at = shore.sample(p.x, p.y);
    EXPECT_NEAR(at.signed_distance_m, glm::length(p) - 70.0, 0.6) << p.x << ' ' << p.y;
    if (glm::length(p) < 20.0 || std::abs(at.signed_distance_m) < 6.0f) continue;
    EXPECT_GT(glm::dot(glm::dvec2(at.towards_shore), -glm::normalize(p)), std::cos(0.1));
  }
}

// Every point of the map against every point where the line crosses a row or a column.
TEST(ShoreMap, IsExactOverAnyLand) {
  Workers workers(3);
  const HeightGrid land = make_land([](glm::dvec2 p) {
    return 3.0 * std::sin(0.06 * p.x + 1.0) * std::cos(0.05 * p.y) + 2.0 * std::sin(0.11 * p.y);
  });
  const ShoreMap shore(land, workers);
  const Grid& grid = shore.grid();
  ASSERT_EQ(grid.samples_x, 129);
  std::vector<glm::dvec2> line;
  const auto cross = [&](int i, int j, int di, int dj) {
    const double a = land.height_m[grid.index(i, j)], b = land.height_m[grid.index(i + di, j + dj)];
    if ((a > 0.0) != (b > 0.0)) line.push_back(glm::dvec2(i, j) + a / (a - b) * glm::dvec2(di, dj));
  };
  for (int j = 0; j < 129; ++j)
    for (int i = 0; i < 129; ++i) {
      if (i < 128) cross(i, j, 1, 0);
      if (j < 128) cross(i, j, 0, 1);
    }
  ASSERT_GT(line.size(), 300u);
  for (int j = 0; j < 129; j += 5)
    for (int i = 0; i < 129; i += 3) {
      double nearest = 1e9;
      for (const glm::dvec2& q : line) nearest = std::min(nearest, glm::distance(q, {i, j}));
      const float found = shore.signed_distance_m()[grid.index(i, j)];
      EXPECT_NEAR(std::abs(found), 2.0 * nearest, 1e-3);
      EXPECT_EQ(found<0.0f, land.height_m[grid.index(i, j)]> 0.0f);
    }
}

TEST(ShoreMap, HasNoLineWhereThereIsOnlySea) {
  Workers workers(1);
  const ShoreMap shore(make_land([](glm::dvec2) { return -5.0; }), workers);
  EXPECT_FALSE(shore.has_line());
  const ShorePoint at = shore.sample(3.0, 1e9);
  EXPECT_GT(at.signed_distance_m, 256.0f);
  EXPECT_EQ(at.towards_shore, glm::vec2(0.0f));
}

TEST(ShoreMap, IsTheSameWithAnyWorkers) {
  const HeightGrid land = make_land([](glm::dvec2 p) { return std::sin(0.03 * p.x * p.y / 40.0); });
  Workers one(1), three(3);
  const ShoreMap a(land, one), b(land, three);
  EXPECT_EQ(a.signed_distance_m(), b.signed_distance_m());
  EXPECT_EQ(a.height_m(), b.height_m());
}

}  // namespace
}  // namespace swell::terrain
