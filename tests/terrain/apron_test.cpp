// The ground beyond a map: it goes on without step or crease, and ends as floor.
#include "terrain/apron.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "math/random.h"
#include "terrain/terrain.h"

namespace swell::terrain {
namespace {

// 65 x 65 samples, 8 m apart, of height_m(p in [-1, 1]^2).
HeightGrid make_map(const std::function<double(glm::dvec2)>& height_m) {
  HeightGrid map{
      {.min_world = {100.0, -300.0}, .spacing_m = 8.0, .samples_x = 65, .samples_y = 65}};
  for (int j = 0; j < 65; ++j)
    for (int i = 0; i < 65; ++i)
      map.height_m.push_back(static_cast<float>(height_m(glm::dvec2(i, j) / 32.0 - 1.0)));
  const auto [lowest, highest] = std::ranges::minmax_element(map.height_m);
  map.lowest_m = *lowest;
  map.highest_m = *highest;
  map.apron = make_apron(map);
  return map;
}

// Hills of 9 to 71 m, whose slopes meet the border at any angle.
HeightGrid hills() {
  return make_map([](glm::dvec2 p) {
    return 40.0 + 20.0 * std::sin(3.0 * p.x + 1.0) + 11.0 * std::cos(4.0 * p.y - p.x);
  });
}
// 1:40, the sea in the north-west.
HeightGrid plane_beach() {
  return make_map([](glm::dvec2 p) { return 256.0 / 40.0 * (0.6 * p.x - 0.8 * p.y); });
}

struct BorderPoint {
  glm::dvec2 p, outwards;
};

// Points on all four sides, away from corners.
std::vector<BorderPoint> border_points(const HeightGrid& map, int count) {
  const glm::dvec2 low = map.grid.min_world, high = low + map.grid.extent_m();
  std::vector<BorderPoint> points;
  for (int n = 0; n < count; ++n) {
    const double along = 0.02 + 0.96 * random_uniform(5, static_cast<std::uint64_t>(n));
    const glm::dvec2 at = low + along * map.grid.extent_m();
    points.push_back({{low.x, at.y}, {-1, 0}});
    points.push_back({{high.x, at.y}, {1, 0}});
    points.push_back({{at.x, low.y}, {0, -1}});
    points.push_back({{at.x, high.y}, {0, 1}});
  }
  return points;
}

TEST(Apron, GoesOnWithoutAStepOrACrease) {
  const HeightGrid island = build_terrain({});
  const HeightGrid beach = build_terrain({.coast_m = {{-700, -60}, {0, -250}, {700, -150}}});
  const std::vector<HeightGrid> maps = {hills(), plane_beach(), island, beach};
  for (const HeightGrid& map : maps)
    for (const auto& [p, outwards] : border_points(map, 200)) {
      const double border_m = height_at(map, p);
      if (map.highest_m - border_m < 1.0) continue;  // ground does not rise over the map's top
      EXPECT_NEAR(height_at(map, p + 1e-6 * outwards), border_m, 1e-5);
      // Within the last cell the map is a plane; the way out bends by less than a tenth of a degree
      // in a metre.
      const double step_m = 0.01 * map.grid.spacing_m;
      const double inside = (border_m - height_at(map, p - step_m * outwards)) / step_m;
      const double outside = (height_at(map, p + step_m * outwards) - border_m) / step_m;
      EXPECT_NEAR(outside, inside, 0.003 * map.grid.spacing_m) << p.x << " " << p.y;
    }
}

// Along lines around the map and over its corners.
TEST(Apron, HasNoStepAnywhere) {
  const HeightGrid map = hills();
  const glm::dvec2 middle = map.grid.min_world + 0.5 * map.grid.extent_m();
  for (const double part : {1.0, 1.01, 1.2, 1.5, 1.9}) {
    const double half_m = part * 256.0;
    double before_m = height_at(map, middle + half_m * glm::dvec2(1, 0));
    for (int n = 0; n < 40000; ++n) {
      const double turn = 8.0 * n / 40000.0;
      const auto corner_walk = [](double t) {
        return std::clamp(std::abs(std::fmod(t, 8.0) - 4.0) - 2.0, -1.0, 1.0);
      };
      const glm::dvec2 around(corner_walk(turn + 0.0), corner_walk(turn + 6.0));
      const double here_m = height_at(map, middle + half_m * around);
      EXPECT_NEAR(here_m, before_m, 8.0 * 8.0 * half_m / 40000.0) << part << " " << turn;
      before_m = here_m;
    }
  }
}

TEST(Apron, EndsAsFloor) {
  for (const HeightGrid& map : {hills(), plane_beach(), build_terrain({})}) {
    const Grid square = square_with_apron(map);
    EXPECT_EQ(square.size_m(), 2.0 * map.grid.size_m());
    EXPECT_LE(map.apron.floor_m, -60.0);
    for (int n = 0; n < 1000; ++n) {
      const double along = random_uniform(6, static_cast<std::uint64_t>(n)) * square.size_m();
      EXPECT_EQ(height_at(map, square.min_world + glm::dvec2(along, 0.0)), map.apron.floor_m);
      EXPECT_EQ(height_at(map, square.min_world + glm::dvec2(0.0, along)), map.apron.floor_m);
    }
    const double infinity = std::numeric_limits<double>::infinity();
    for (const glm::dvec2& p : {glm::dvec2(1e300, 0.0), glm::dvec2(infinity, infinity),
                                glm::dvec2(std::nan(""), 0.0), glm::dvec2(-1e9, 1e9)})
      EXPECT_EQ(height_at(map, p), map.apron.floor_m);
  }
}

TEST(Apron, IsNeverHigherThanTheMapNorLowerThanTheFloor) {
  for (const HeightGrid& map : {hills(), plane_beach(), build_terrain({})}) {
    const Grid square = square_with_apron(map);
    for (std::uint64_t n = 0; n < 20000; ++n) {
      const glm::dvec2 at(random_uniform(7, 2 * n), random_uniform(7, 2 * n + 1));
      const double height_m = height_at(map, square.min_world + at * square.extent_m());
      ASSERT_LE(height_m, map.highest_m + 1e-4);
      ASSERT_GE(height_m, map.apron.floor_m - 1e-9);
    }
  }
}

// The coast line of a plane crosses the border at an angle, and keeps its direction for a tenth of
// the apron's width; further out the land ends.
TEST(Apron, LetsABeachGoOnAsABeach) {
  const HeightGrid map = plane_beach();
  const auto plane_m = [&](glm::dvec2 p) {
    const glm::dvec2 q = (p - map.grid.min_world) / 256.0 - 1.0;
    return 256.0 / 40.0 * (0.6 * q.x - 0.8 * q.y);
  };
  const glm::dvec2 middle = map.grid.min_world + 0.5 * map.grid.extent_m();
  for (const double side : {-1.0, 1.0}) {
    const glm::dvec2 crossing = middle + 256.0 * glm::dvec2(side, side * 0.75);
    const glm::dvec2 along(side * 0.8, side * 0.6);
    EXPECT_NEAR(plane_m(crossing), 0.0, 1e-9);
    for (const double away_m : {5.0, 15.0, 25.0})
      EXPECT_NEAR(height_at(map, crossing + away_m * along), 0.0, 0.5) << away_m;
  }
}

TEST(Apron, LeavesTheMapAsItIs) {
  HeightGrid map = hills();
  HeightGrid bare = map;
  bare.apron = {};
  for (std::uint64_t n = 0; n < 2000; ++n) {
    const glm::dvec2 at(random_uniform(8, 2 * n), random_uniform(8, 2 * n + 1));
    const glm::dvec2 p = map.grid.min_world + at * map.grid.extent_m();
    EXPECT_EQ(height_at(map, p), height_at(bare, p));
  }
  EXPECT_EQ(height_at(map, map.grid.point(64, 64)), static_cast<double>(map.height_m.back()));
}

// Many points are looked at side by side, on the map, around it, far away and nowhere.
TEST(Apron, HasTheSameHeightsForOnePointAndForMany) {
  const HeightGrid map = hills();
  const double side_m = map.grid.size_m();
  std::vector<glm::dvec2> points;
  for (std::uint64_t n = 0; n < 5000; ++n)
    points.push_back(
        map.grid.min_world +
        side_m * (3.0 * glm::dvec2(random_uniform(9, 2 * n), random_uniform(9, 2 * n + 1)) - 1.0));
  for (const double x : {0.0, 1.0, -0.5, 1.5, 1e9})
    for (const double y : {0.0, 1.0, 0.25, -1e9})
      points.push_back(map.grid.min_world + side_m * glm::dvec2(x, y));
  points.push_back({std::numeric_limits<double>::quiet_NaN(), 0.0});
  std::vector<float> heights(points.size());
  sample_heights(map, points, heights);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_EQ(heights[i], static_cast<float>(height_at(map, points[i]))) << i;
}

}  // namespace
}  // namespace swell::terrain
