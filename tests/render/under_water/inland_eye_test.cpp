// An eye in a lake or a river sees what one in the sea does: Snell's window in the level over it,
// the water's light, the bed through it, and both sides of a surface that cuts the picture.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "constants.h"
#include "math/simd_target.h"
#include "render/measures.h"
#include "render/shot.h"
#include "render/view/render_view.h"
#include "scene/scene.h"
#include "scene/water.h"

namespace swell::render {
namespace {

constexpr double kLevel_m = 3.3;
constexpr double kWindow = 1.134542;  // radius of Snell's window over the depth: 1 / sqrt(n^2 - 1)
constexpr glm::dvec2 kMiddle_m(0.0, -217.0);

// A lake that is 80 m wide, of glass, as clear as a scene may be and black below, under a sky of
// radiance 1.
scene::Scene glass_lake(const std::string& more = "") {
  scene::Scene scene = scene::parse_scene(R"(
[sky]
zenith = [1, 1, 1]
horizon = [1, 1, 1]
sun_radiance = [0, 0, 0]
cloud_cover = 0
[wind]
speed_mps = 0
[coast]
model = "none"
[terrain]
coast_m = [[-100, 0], [100, 0]]
beach_slope = 0.03
beach_size_m = 800
floor_depth_m = 5
[[lake]]
name = "lake"
level_m = 3.3
outline_m = [[-40, -245], [40, -245], [40, -190], [-40, -190]]
depth_m = 3.2
[[river]]
from = "lake"
path_m = [[0, -205], [0, -160], [0, -110], [0, -50], [0, 40]]
width_m = [9]
depth_m = [1]
surface_m = [3.3, 2.7, 1.8, 0.5, 0]
)" + more,
                                          "lake.toml");
  scene.round_earth = false;
  return scene;
}

constexpr const char* kBlackWater =
    "[water]\nbody_colour = [0, 0, 0]\nabsorption_per_m = [0.001, 0.001, 0.001]\n";

const World& black_lake() {
  static const World world = world_of(glass_lake(kBlackWater));
  return world;
}

View view_at(double z_m, double pitch_rad, double fov_y_rad, int width_px, int height_px) {
  const scene::Camera camera = {
      .eye_m = {kMiddle_m, z_m}, .pitch_rad = pitch_rad, .fov_y_rad = fov_y_rad};
  return scene::camera_view(camera, 0.0, width_px, height_px);
}

Shot drawn(const World& world, const View& view, FrameOptions options = {}) {
  options.keep_linear = true;
  options.edge_samples = 0;
  return Shot(world, view, 3.0, options);
}

TEST(UnderALake, SnellsWindowIsACircleOfItsRadiusInTheLakesLevel) {
  constexpr int kSize = 200;
  FrameOptions with_depth;
  with_depth.labels.add(Label::kDepth);
  for (const double depth_m : {0.5, 1.6, 2.5}) {
    const Shot shot = drawn(
        black_lake(), view_at(kLevel_m - depth_m, 0.5 * kPiRef, 2.0, kSize, kSize), with_depth);
    const double radius_px = kWindow * 0.5 * kSize / std::tan(1.0);
    // Banks stand on its rim.
    int lit = 0;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const double r = std::hypot(x + 0.5 - 0.5 * kSize, y + 0.5 - 0.5 * kSize);
        lit += shot.linear(x, y).y > 0.3f;
        if (r < 0.9 * radius_px) {
          ASSERT_GT(shot.linear(x, y).y, 0.3f) << depth_m << ": " << x << ' ' << y;
        } else if (r > radius_px + 2.0) {
          ASSERT_LT(shot.linear(x, y).y, 0.25f) << depth_m << ": " << x << ' ' << y;
        }
      }
    const double lit_px = std::sqrt(lit / kPiRef);
    EXPECT_LT(lit_px, radius_px + 1.0) << depth_m;
    EXPECT_GT(lit_px, 0.96 * radius_px) << depth_m;
    // The surface lies where the level is.
    const std::size_t middle = shot.at(kSize / 2, kSize / 2);
    EXPECT_NEAR(static_cast<double>(shot.target.labels.depth_m[middle]), depth_m, 0.02);
  }
}

// Straight up 1 - 0.0204 passes, and less towards the rim: the light of the ray in air.
TEST(UnderALake, TheWindowIsAsBrightAsFresnelSays) {
  constexpr int kSize = 128;
  constexpr double kN = 1.333, kDeep_m = 2.0;
  const Shot shot =
      drawn(black_lake(), view_at(kLevel_m - kDeep_m, 0.5 * kPiRef, 1.8, kSize, kSize));
  for (const int x : {64, 70, 80, 95}) {
    const double tan_water =
        std::hypot((x + 0.5 - 64.0) / 64.0 * std::tan(0.9), 0.5 / 64.0 * std::tan(0.9));
    const double water = std::atan(tan_water), air = std::asin(kN * std::sin(water));
    const double s = std::sin(air - water) / std::sin(air + water);
    const double p = std::tan(air - water) / std::tan(air + water);
    const double passes = 1.0 - 0.5 * (s * s + p * p);
    const double clear = std::exp(-0.001 * kDeep_m / std::cos(water));
    EXPECT_NEAR(static_cast<double>(shot.linear(x, 64).y), passes * clear, 0.015) << x;
  }
}

// A long level way shows the water's own light, and the bed below it through less and less.
TEST(UnderALake, TheBedFadesIntoTheWatersLight) {
  const World murky = world_of(glass_lake(
      "[water]\nbody_colour = [0.02, 0.05, 0.06]\nabsorption_per_m = [0.9, 0.6, 0.5]\n"));
  FrameOptions with_id;
  with_id.labels.add(Label::kId);
  const View down = view_at(kLevel_m - 1.6, -0.5 * kPiRef, 0.8, 40, 40);
  const Shot clear_bed = drawn(black_lake(), down, with_id),
             murky_bed = drawn(murky, down, with_id);
  EXPECT_EQ(clear_bed.target.labels.id[clear_bed.at(20, 20)], kLandId);
  EXPECT_LT(murky_bed.linear(20, 20).x, 0.3f * clear_bed.linear(20, 20).x);
  // Level, 30 m before the bank: what water without end shows there, and the same all along the
  // row.
  const Shot level = drawn(murky, view_at(kLevel_m - 1.6, 0.0, 0.6, 80, 41));
  for (int x = 1; x < 80; ++x) {
    EXPECT_GT(level.linear(x, 20).y, 0.01f);
    EXPECT_NEAR(level.linear(x, 20).y / level.linear(x - 1, 20).y, 1.0f, 0.03f) << x;
  }
}

TEST(UnderALake, TheSurfaceCutsThePictureInHalves) {
  FrameOptions with_flags;
  with_flags.labels.add(Label::kFlags);
  const Shot shot = drawn(black_lake(), view_at(kLevel_m, 0.0, 1.0, 100, 60), with_flags);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 100; ++x)
      ASSERT_EQ((shot.target.labels.flags[shot.at(x, y)] & kSeenInWater) != 0, y >= 30)
          << x << ' ' << y;
}

// From above the level to below it a picture changes little at a time.
TEST(UnderALake, AnEyeThatDivesSeesSomethingAllTheWay) {
  const World world = world_of(glass_lake());
  double before = 0.0;
  for (int i = 0; i < 40; ++i) {
    const double z = kLevel_m + 1.0 - 3.0 * i / 39.0;
    const Shot shot = drawn(world, view_at(z, 0.1, 1.0, 48, 27));
    double sum = 0.0;
    for (const float light : shot.target.linear) {
      ASSERT_TRUE(std::isfinite(light) && light >= 0.0f) << z;
      sum += std::min(static_cast<double>(light), 1.0);
    }
    const double mean = sum / static_cast<double>(shot.target.linear.size());
    EXPECT_GT(mean, 0.01) << z;
    if (i > 0) {
      EXPECT_LT(std::abs(mean - before), 0.4) << z;
    }
    before = mean;
  }
}

// Mirrored around the window: the bed, which lies as far below the level as it seems above it.
TEST(UnderALake, TheSurfaceMirrorsTheBed) {
  const View view = view_at(kLevel_m - 2.0, radians(20.0), 0.3, 60, 40);
  const Shot with = drawn(black_lake(), view);
  const Shot without = drawn(black_lake(), view, {.without = {Part::kReflection}});
  double bed = 0.0, none = 0.0;
  for (int x = 0; x < 60; ++x) bed += with.linear(x, 20).y, none += without.linear(x, 20).y;
  EXPECT_GT(bed, 60 * 0.02);
  EXPECT_LT(none, 0.2 * bed);
}

TEST(UnderALake, IsTheSameBitsOverThreadsTargetsTilesAndFramesBefore) {
  const World world = world_of(glass_lake());
  const View view = view_at(kLevel_m - 1.0, 0.3, 1.2, 121, 67);
  const Shot one(world, view, 3.0, {}, 1);
  Shot other(3);
  other.draw(world, view_at(kLevel_m + 3.0, -0.3, 1.2, 121, 67), 2.0);
  for (const SimdTarget target : simd_targets()) {
    if (!simd_target_available(target)) continue;
    select_simd_target(target);
    EXPECT_EQ(other.draw(world, view, 3.0, {.tile_size_px = 32}).rgba, one.target.rgba);
  }
}

// Where a river comes down to the sea an eye passes from one into the other.
TEST(UnderARiver, TheSurfaceIsOverAnEyeAllTheWayToTheSea) {
  const World world = world_of(glass_lake());
  FrameOptions with_flags;
  with_flags.labels.add(Label::kFlags);
  const scene::Water water = world.water();
  ocean::SeaFrame sea;
  Workers workers(1);
  const scene::WaterSurface surface = water.at(3.0, sea, workers);
  for (const double y_m : {-150.0, -100.0, -50.0, -20.0, 20.0}) {
    const auto surface_m = static_cast<double>(surface.height({0.0, y_m}));
    const scene::Camera camera = {
        .eye_m = {0.0, y_m, surface_m - 0.4}, .pitch_rad = 0.5 * kPiRef, .fov_y_rad = 1.0};
    const Shot shot = drawn(world, scene::camera_view(camera, 0.0, 40, 40), with_flags);
    EXPECT_NE(shot.target.labels.flags[shot.at(20, 20)] & kSeenInWater, 0) << y_m;
    EXPECT_GT(shot.linear(20, 20).y, 0.3f) << y_m;
  }
}

}  // namespace
}  // namespace swell::render
