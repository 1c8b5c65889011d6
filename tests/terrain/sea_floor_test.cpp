#include "terrain/sea_floor.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace swell::terrain {
namespace {

TEST(SeaFloor, HasDepthsBelowTheSea) {
  const HeightGrid floor{{{10.0, 20.0}, 2.0, 2, 2}, {-1.0f, -3.0f, -5.0f, 11.0f}};
  EXPECT_EQ(depth_at(floor, {10.0, 20.0}), 1.0);
  EXPECT_EQ(depth_at(floor, {12.0, 22.0}), -11.0);
  EXPECT_EQ(depth_at(floor, {11.0, 20.0}), 2.0);
  EXPECT_EQ(depth_at(floor, {11.0, 21.0}), -0.5);  // the mean of all four
  EXPECT_EQ(depth_of_sample(floor, 2), 5.0);
  EXPECT_EQ(depth_of_sample(floor, 3), -11.0);
}

TEST(SeaFloor, MayHaveOneSample) {
  const HeightGrid floor = make_sea_floor({{0.0, 0.0}, 1.0, 1, 1}, [](glm::dvec2) { return 7.0; });
  EXPECT_EQ(depth_at(floor, {3.0, -4.0}), 7.0);
  EXPECT_EQ(slope_at(floor, {3.0, -4.0}), glm::dvec2(0.0));
}

TEST(SeaFloor, AsksForTheDepthAtEachPoint) {
  const HeightGrid floor = make_sea_floor({{10.0, 20.0}, 2.0, 2, 2},
                                          [](glm::dvec2 p) { return p.x - 2.0 * (p.y - 20.0); });
  EXPECT_EQ(floor.height_m, (std::vector<float>{-10.0f, -12.0f, -6.0f, -8.0f}));
}

TEST(SeaFloor, RefusesWhatIsNoFloor) {
  const auto depth = [](glm::dvec2) { return 1.0; };
  const auto nan = [](glm::dvec2) { return std::nan(""); };
  const Grid good{{0.0, 0.0}, 1.0, 3, 3};
  EXPECT_NO_THROW(make_sea_floor(good, depth));
  EXPECT_THROW(make_sea_floor(good, nan), std::invalid_argument);
  EXPECT_THROW(make_sea_floor({{0.0, 0.0}, -1.0, 3, 3}, depth), std::invalid_argument);
  EXPECT_THROW(make_sea_floor({{0.0, 0.0}, std::nan(""), 3, 3}, depth), std::invalid_argument);
  EXPECT_THROW(make_sea_floor({{0.0, 0.0}, 1.0, 0, 3}, depth), std::invalid_argument);
  EXPECT_THROW(make_sea_floor({{0.0, 0.0}, 1.0, 100000, 100000}, depth), std::invalid_argument);
  EXPECT_THROW(make_sea_floor({{std::nan(""), 0.0}, 1.0, 3, 3}, depth), std::invalid_argument);
  EXPECT_THROW(check_sea_floor({good, {1.0f}}), std::invalid_argument);
}

TEST(PlaneBeach, MeasuresTheDistanceToItsCoastLine) {
  // A headland: the coast comes from the south, points east, goes on to the north; sea to the east
  // means walking from north to south keeps it on the left.
  const std::array<glm::dvec2, 3> coast{{{0.0, 10.0}, {10.0, 0.0}, {0.0, -10.0}}};
  EXPECT_NEAR(distance_to_coast(coast, {20.0, 0.0}), 10.0, 1e-12);  // to the cape
  EXPECT_NEAR(distance_to_coast(coast, {0.0, 0.0}), -std::sqrt(50.0), 1e-12);
  EXPECT_NEAR(distance_to_coast(coast, {10.0, 10.0}), std::sqrt(50.0), 1e-12);
  // The ends go on: 30 further along the first stretch's line is still coast.
  EXPECT_NEAR(distance_to_coast(coast, {-30.0, 40.0}), 0.0, 1e-12);
  // A bay: walked the other way round the same line has the sea in the west.
  const std::array<glm::dvec2, 3> bay{{{0.0, -10.0}, {10.0, 0.0}, {0.0, 10.0}}};
  EXPECT_NEAR(distance_to_coast(bay, {20.0, 0.0}), -10.0, 1e-12);
  EXPECT_NEAR(distance_to_coast(bay, {0.0, 0.0}), std::sqrt(50.0), 1e-12);
}

TEST(PlaneBeach, DeepensInProportionToTheDistance) {
  const PlaneBeach beach{{{100.0, 0.0}, {100.0, 1.0}}, 0.02, 1.5};  // sea in the west
  const HeightGrid floor = make_plane_beach({{0.0, 0.0}, 10.0, 13, 2}, beach);
  EXPECT_FLOAT_EQ(floor.height_m[0], -1.5f);  // 2 m by the slope
  EXPECT_FLOAT_EQ(floor.height_m[5], -1.0f);
  EXPECT_FLOAT_EQ(floor.height_m[10], -0.0f);
  EXPECT_FLOAT_EQ(floor.height_m[12], 0.4f);
}

TEST(PlaneBeach, RefusesABadCoast) {
  const Grid grid{{0.0, 0.0}, 1.0, 3, 3};
  const std::vector<glm::dvec2> coast{{0.0, 0.0}, {1.0, 0.0}};
  EXPECT_NO_THROW(make_plane_beach(grid, {coast, 0.1, 5.0}));
  EXPECT_THROW(make_plane_beach(grid, {{{0.0, 0.0}}, 0.1, 5.0}), std::invalid_argument);
  EXPECT_THROW(make_plane_beach(grid, {{{0.0, 0.0}, {0.0, 0.0}}, 0.1, 5.0}), std::invalid_argument);
  EXPECT_THROW(make_plane_beach(grid, {{{0.0, 0.0}, {1e-300, 0.0}}, 0.1, 5.0}),
               std::invalid_argument);
  EXPECT_THROW(make_plane_beach(grid, {coast, 0.0, 5.0}), std::invalid_argument);
  EXPECT_THROW(make_plane_beach(grid, {coast, std::nan(""), 5.0}), std::invalid_argument);
  EXPECT_THROW(make_plane_beach(grid, {coast, 0.1, -5.0}), std::invalid_argument);
}

}  // namespace
}  // namespace swell::terrain
