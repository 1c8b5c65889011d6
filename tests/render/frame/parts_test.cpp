// What a picture is without one of its parts, of those whose own tests do not say it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/labelled_frame.h"
#include "render/world/world_state.h"
#include "sky/sky_light.h"
#include "terrain/height_grid.h"

namespace swell::render {
namespace {

constexpr int kWidth = 96, kHeight = 64;

// A sea as smooth and as flat as glass under a clear sky.
scene::Scene glass() {
  scene::Scene scene;
  scene.sea.wind_speed_mps = 0.0;
  scene.sea.resolution = 16;
  scene.sky.cloud_cover = 0.0;
  scene.water.bump_strength = 0.0;
  scene.detail.objects = 1.0;  // the same triangles as without an object
  scene.detail.water_triangles = scene.detail.terrain_triangles = 2000;
  return scene;
}

// An island in it, of few maps' texels.
scene::Scene island() {
  scene::Scene scene = glass();
  scene.terrain = scene::TerrainDescription{};
  scene.terrain->island_radius_m = 60.0;
  return scene;
}

scene::FloatingObject box_at(glm::dvec2 position_m, glm::dvec3 size_m, glm::vec3 colour) {
  return {.kind = scene::ObjectKind::kBox,
          .position_m = position_m,
          .size_m = size_m,
          .draught = 0.0,
          .colour = colour};
}

View looking_down(glm::dvec3 eye) {
  return make_view(eye, 0.0, -0.5 * std::numbers::pi, 0.8, 0.25f, kWidth, kHeight);
}
View looking_north(double height_m, double fov_y_rad = 0.8) {
  return make_view({0.0, 0.0, height_m}, 0.0, -0.1, fov_y_rad, 0.25f, kWidth, kHeight);
}

LabelledFrame frame_of(const World& world, const View& view, PartSet without, double t_s = 0.0) {
  return {world, view, t_s, {.keep_linear = true, .edge_samples = 0, .without = without}};
}

// Pixels of which `is` is true.
template <class Is>
int count(const LabelledFrame& frame, const Is& is) {
  int pixels = 0;
  frame.for_pixels(1, [&](glm::ivec2 p) { pixels += is(p); });
  return pixels;
}

int count_flag(const LabelledFrame& frame, std::uint32_t flag) {
  return count(frame,
               [&](glm::ivec2 p) { return (frame.labels().flags[frame.at(p)] & flag) != 0; });
}

glm::vec3 light_at(const LabelledFrame& frame, glm::ivec2 p) { return frame.linear(p.x, p.y); }

TEST(WithoutWater, TheFloorIsSeenWhereItIs) {
  const World world = world_of(island());
  const View view = looking_down({0.0, -90.0, 20.0});
  const LabelledFrame wet = frame_of(world, view, {}), dry = frame_of(world, view, {Part::kWater});
  EXPECT_GT(count(wet, [&](glm::ivec2 p) { return wet.labels().id[wet.at(p)] == kWaterId; }),
            kWidth * kHeight / 2);
  const terrain::HeightGrid& land = *world.state().terrain;
  int sunken = 0;
  dry.for_pixels(1, [&](glm::ivec2 p) {
    ASSERT_EQ(dry.labels().id[dry.at(p)], kLandId);
    const glm::dvec3 seen = dry.position(p);
    const glm::dvec2 place(seen);
    float height_m = 0.0f;
    terrain::sample_heights(land, {&place, 1}, {&height_m, 1});
    EXPECT_NEAR(seen.z + dry.sunk_m(seen), static_cast<double>(height_m), 0.3);
    sunken += height_m < -0.5f;
  });
  EXPECT_GT(sunken, kWidth * kHeight / 2);
}

TEST(WithoutWater, AnEyeBelowItsLevelIsInAir) {
  const World world = world_of(island());
  const View view = looking_down({0.0, -90.0, -1.0});
  EXPECT_EQ(count_flag(frame_of(world, view, {}), kSeenInWater), kWidth * kHeight);
  EXPECT_EQ(count_flag(frame_of(world, view, {Part::kWater}), kSeenInWater), 0);
}

TEST(WithoutWater, ThingsLieWhereTheyDidOnTheWaves) {
  scene::Scene scene;
  scene.detail.water_triangles = 2000;
  scene.objects = {box_at({0.0, 30.0}, {6.0, 6.0, 8.0}, glm::vec3(1.0f))};
  const World world = world_of(scene);
  const LabelledFrame wet = frame_of(world, looking_north(9.0), {}, 3.0);
  const LabelledFrame dry = frame_of(world, looking_north(9.0), {Part::kWater}, 3.0);
  const int seen = count(wet, [&](glm::ivec2 p) {
    const std::size_t i = wet.at(p);
    if (wet.labels().id[i] != kFirstObjectId) return false;
    EXPECT_EQ(dry.labels().depth_m[i], wet.labels().depth_m[i]);
    return true;
  });
  EXPECT_GT(seen, 100);
}

TEST(WithoutReflection, WaterMirrorsTheSkyAlone) {
  scene::Scene scene = glass();
  const World empty = world_of(scene);
  scene.objects = {box_at({0.0, 30.0}, glm::dvec3(6.0), glm::vec3(1.0f))};
  const World world(scene, empty, 2);
  const PartSet bare = {Part::kHulls, Part::kShadows, Part::kRefraction};
  PartSet blind = bare;
  blind.add(Part::kReflection);
  const LabelledFrame open = frame_of(empty, looking_north(6.0), bare);
  const LabelledFrame mirrors = frame_of(world, looking_north(6.0), bare);
  const LabelledFrame mirrors_not = frame_of(world, looking_north(6.0), blind);
  EXPECT_GT(count_flag(mirrors, kShowsMirrored), 100);
  EXPECT_EQ(count_flag(mirrors_not, kShowsMirrored), 0);
  const int water = count(mirrors_not, [&](glm::ivec2 p) {
    const std::size_t i = mirrors_not.at(p);
    if (mirrors_not.labels().id[i] != kWaterId) return false;
    EXPECT_EQ(light_at(mirrors_not, p), light_at(open, p)) << p.x << " " << p.y;
    return true;
  });
  EXPECT_GT(water, 1000);
}

TEST(WithoutRefraction, ShallowWaterLooksDeep) {
  const World shallow = world_of(island());
  const World deep = world_of(glass());
  const View view = looking_down({0.0, -90.0, 20.0});
  const LabelledFrame floor = frame_of(shallow, view, {});
  const LabelledFrame no_floor = frame_of(shallow, view, {Part::kRefraction, Part::kReflection});
  const LabelledFrame open = frame_of(deep, view, {});
  const int brighter = count(floor, [&](glm::ivec2 p) {
    const std::size_t i = floor.at(p);
    if (floor.labels().id[i] != kWaterId) return false;
    const glm::vec3 light = light_at(no_floor, p), expected = light_at(open, p);
    EXPECT_LT(glm::distance(light, expected), 1e-5f * glm::length(expected)) << p.x << " " << p.y;
    return light_at(floor, p).y > 1.5f * expected.y;
  });
  EXPECT_GT(brighter, kWidth * kHeight / 3);
}

// In the sun's mirror image, which is many times as bright as the sky's.
TEST(WithoutGlitter, WaterMirrorsNoSun) {
  scene::Scene scene = glass();
  scene.sky.sun_azimuth_rad = 0.0;
  scene.sky.sun_elevation_rad = radians(30.0);
  scene.sky.sun_direction = sky::sun_direction(0.0, scene.sky.sun_elevation_rad);
  const World world = world_of(scene);
  const View view =
      make_view({0.0, 0.0, 10.0}, 0.0, -scene.sky.sun_elevation_rad, 0.2, 0.25f, kWidth, kHeight);
  const auto brightest = [&](PartSet without) {
    return std::ranges::max(frame_of(world, view, without).target.linear);
  };
  EXPECT_GT(brightest({}), 30.0f * brightest({Part::kGlitter}));
}

// Ripples are all the waves of a sea without patches.
TEST(WithoutRipples, SeasWithoutLongerWavesAreFlat) {
  scene::Scene scene = glass();
  scene.sea.wind_speed_mps = 6.0;
  scene.sea.amplitude_scale = 0.0;
  scene.water.bump_strength = 1.0;
  const World world = world_of(scene);
  const auto tilted = [&](PartSet without) {
    const LabelledFrame frame = frame_of(world, looking_down({0.0, 0.0, 3.0}), without, 2.0);
    return count(frame, [&](glm::ivec2 p) {
      const glm::vec3 normal = frame.labels().normal[frame.at(p)];
      return std::hypot(normal.x, normal.y) > 0.01f * normal.z;
    });
  };
  EXPECT_GT(tilted({}), kWidth * kHeight / 2);
  EXPECT_EQ(tilted({Part::kRipples}), 0);
}

// Haze leaves exp(-distance / haze's) of the contrast between a white and a black wall.
TEST(WithoutHaze, ContrastIsWhole) {
  constexpr double kWall_m = 900.0, kHaze_m = 1000.0;
  scene::Scene scene = glass();
  scene.sky.haze_distance_m = kHaze_m;
  scene.sky.haze_height_m = 1e7;
  scene.sky.sun_azimuth_rad = radians(180.0);
  scene.sky.sun_direction = {0.0f, -0.8660254f, 0.5f};
  const View view = make_view({0.0, 0.0, 10.0}, 0.0, 0.0, 0.05, 0.25f, kWidth, kHeight);
  const auto middle_of = [&](float paint, PartSet without) {
    scene.objects = {box_at({0.0, kWall_m + 5.0}, {200.0, 10.0, 100.0}, glm::vec3(paint))};
    const World world = world_of(scene);
    const LabelledFrame frame = frame_of(world, view, without);
    const glm::ivec2 middle(kWidth / 2, kHeight / 2);
    EXPECT_EQ(frame.labels().id[frame.at(middle)], kFirstObjectId);
    return static_cast<double>(light_at(frame, middle).y);
  };
  const double hazed = middle_of(1.0f, {}) - middle_of(0.0f, {});
  const double whole = middle_of(1.0f, {Part::kHaze}) - middle_of(0.0f, {Part::kHaze});
  EXPECT_GT(whole, 0.1);
  EXPECT_NEAR(hazed / whole, std::exp(-kWall_m / kHaze_m), 0.005);
}

TEST(WithoutEarth, TheSeaIsThatOfAFlatScene) {
  scene::Scene scene = glass();
  const World round = world_of(scene);
  scene.round_earth = false;
  const World flat(scene, round, 2);
  const View view = looking_north(400.0, 0.3);
  const LabelledFrame expected = frame_of(flat, view, {});
  EXPECT_EQ(frame_of(round, view, {Part::kEarth}).target.rgba, expected.target.rgba);
  EXPECT_NE(frame_of(round, view, {}).target.rgba, expected.target.rgba);
}

TEST(WithoutApron, NoGroundLiesBeyondTheTerrainsSquare) {
  const World world = world_of(island());
  const terrain::Grid& square = world.state().terrain->grid;
  const glm::dvec2 far = square.min_world + square.size_m();
  const View view = looking_down({square.min_world, 300.0});
  const auto beyond = [&](PartSet without) {
    const LabelledFrame frame = frame_of(world, view, without);
    return count(frame, [&](glm::ivec2 p) {
      if (frame.labels().id[frame.at(p)] != kLandId) return false;
      const glm::dvec2 seen(frame.position(p));
      const glm::dvec2 out = glm::max(square.min_world - seen, seen - far);
      return std::max(out.x, out.y) > 1.0;
    });
  };
  EXPECT_GT(beyond({Part::kWater}), 1000);
  EXPECT_EQ(beyond({Part::kWater, Part::kApron}), 0);
}

TEST(WithoutUnderwater, AnEyeBelowSeesThroughAir) {
  const World world = world_of(island());
  const View view = looking_down({0.0, -90.0, -1.0});
  const LabelledFrame wet = frame_of(world, view, {});
  const LabelledFrame dry = frame_of(world, view, {Part::kUnderwater});
  EXPECT_EQ(count_flag(wet, kSeenInWater), kWidth * kHeight);
  EXPECT_EQ(count_flag(dry, kSeenInWater), 0);
  // Red light is lost in water first.
  const int redder = count(dry, [&](glm::ivec2 p) {
    const glm::vec3 in_air = light_at(dry, p), in_water = light_at(wet, p);
    return in_air.x / in_air.z > 1.5f * in_water.x / in_water.z;
  });
  EXPECT_EQ(redder, kWidth * kHeight);
}

}  // namespace
}  // namespace swell::render
