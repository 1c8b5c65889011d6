// Shafts of light under water, and the light that waves throw up on objects above it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "render/measures.h"
#include "render/shot.h"
#include "render/sky/sky_maps.h"
#include "render/world/world_state.h"
#include "scene/scene.h"
#include "terrain/height_grid.h"
#include "trials.h"

namespace swell::render {
namespace {

constexpr int kShaftsWidth = 96, kShaftsHeight = 54;

void put_sun_in_the_south(scene::Sky& sky, double elevation_rad) {
  sky.sun_azimuth_rad = std::numbers::pi;
  sky.sun_elevation_rad = elevation_rad;
  sky.sun_direction = glm::vec3(0.0f, -std::cos(elevation_rad), std::sin(elevation_rad));
}

// Deep water, a breeze, and a high sun in the south.
scene::Scene deep_sea() {
  scene::Scene scene;
  scene.sea.wind_speed_mps = 4.0;
  scene.sea.patch_lengths_m = {97.0, 23.0, 5.3};
  put_sun_in_the_south(scene.sky, 1.0);
  scene.sky.cloud_cover = 0.0;
  scene.water.absorption_per_m = glm::vec3(0.3f, 0.07f, 0.05f);
  scene.water.body_colour = glm::vec3(0.005f, 0.04f, 0.06f);
  scene.detail.water_triangles = scene.detail.terrain_triangles = 1500;
  scene.terrain.emplace();
  scene.terrain->floor_depth_m = 90.0;
  scene.terrain->island_height_m = 0.0;
  return scene;
}

// Made once, as it takes longer than the pictures of it; what differs in a little is made like it.
const World& deep_world() {
  static const World world = world_of(deep_sea());
  return world;
}

struct Look {
  double depth_m = 5.0, heading_rad = std::numbers::pi, pitch_rad = 0.0;
};

View view_of(const Look& look) {
  const scene::Camera camera = {.eye_m = {0.0, -3000.0, -look.depth_m},
                                .heading_rad = look.heading_rad,
                                .pitch_rad = look.pitch_rad,
                                .fov_y_rad = 1.0};
  return scene::camera_view(camera, 0.0, kShaftsWidth, kShaftsHeight);
}

FrameOptions linear(PartSet without = {}) { return {.keep_linear = true, .without = without}; }

std::vector<float> green_of_shafts(const World& world, const View& view, double t_s,
                                   PartSet without = {}) {
  return green_light(Shot(world, view, t_s, linear(without)).target);
}

// How the green light of a picture's pixels differs with a part, over the mean without it.
struct Change {
  double mean = 0.0, deviation = 0.0;
};

Change change_by(Part part, const World& world, const View& view, double t_s) {
  const std::vector<float> with = green_of_shafts(world, view, t_s);
  const std::vector<float> without = green_of_shafts(world, view, t_s, {part});
  double all = 0.0, sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < with.size(); ++i) {
    const auto base = static_cast<double>(without[i]);
    const double more = static_cast<double>(with[i]) - base;
    all += base, sum += more, squares += more * more;
  }
  constexpr double kPixels = kShaftsWidth * kShaftsHeight;
  const double mean = sum / kPixels;
  return {sum / all, std::sqrt(squares / kPixels - mean * mean) * kPixels / all};
}

Change shafts(const World& world, const Look& look, double t_s = 3.0) {
  return change_by(Part::kShafts, world, view_of(look), t_s);
}

TEST(Shafts, OnlyShareLightOut) {
  const World& world = deep_world();
  double mean = 0.0;
  const int pictures = trials(40);
  for (int i = 0; i < pictures; ++i) {
    const Change change = shafts(world, {.heading_rad = 0.8 * i, .pitch_rad = -0.2}, 7.0 * i);
    EXPECT_GT(change.deviation, 0.01) << i;
    mean += change.mean / pictures;
  }
  // A picture's own mean is off by 0.02 as a rule.
  EXPECT_NEAR(mean, 0.0, 0.06 / std::sqrt(pictures));
}

TEST(Shafts, ShowMostTowardsTheSun) {
  const World& world = deep_world();
  const double towards = shafts(world, {.pitch_rad = 0.3}).deviation;
  EXPECT_GT(towards, 0.02);
  EXPECT_LT(shafts(world, {.heading_rad = 0.0, .pitch_rad = 0.3}).deviation, 0.7 * towards);
}

TEST(Shafts, AreWeakerInTheDeepAndInTurbidWater) {
  const World& world = deep_world();
  scene::Scene scene = deep_sea();
  scene.water.absorption_per_m *= 12.0f;
  const World turbid(scene, world, 2);
  const double clear = shafts(world, {}).deviation;
  EXPECT_LT(shafts(world, {.depth_m = 60.0}).deviation, 0.5 * clear);
  EXPECT_LT(shafts(turbid, {}).deviation, 0.7 * clear);
}

TEST(Shafts, AreNoneUnderCloudsOrWithoutCaustics) {
  const World& world = deep_world();
  scene::Scene scene = deep_sea();
  scene.water.caustics = 0.0;
  const World even(scene, world, 2);
  scene.sky.cloud_cover = 1.0;
  scene.water.caustics = 1.0;
  const World overcast(scene, world, 2);
  EXPECT_EQ(shafts(even, {}).deviation, 0.0);
  EXPECT_LT(shafts(overcast, {}).deviation, 0.3 * shafts(world, {}).deviation);
}

scene::FloatingObject slab(glm::dvec2 place_m, glm::dvec3 size_m, double height_m) {
  return {.kind = scene::ObjectKind::kBox,
          .position_m = place_m,
          .size_m = size_m,
          .draught = 0.0,
          .colour = glm::vec3(0.8f),
          .motion = scene::Motion::kFixed,
          .height_m = height_m};
}

// Under a roof over the water there is no sun to scatter.
TEST(Shafts, AreDarkInShadow) {
  scene::Scene scene = deep_sea();
  scene.objects.push_back(slab({0.0, -3003.0}, {60.0, 60.0, 1.0}, 1.0));
  const World world(scene, deep_world(), 2);
  EXPECT_LT(shafts(world, {.depth_m = 3.0, .pitch_rad = -0.3}).mean, -0.1);
}

// A cloud wider than water is clear, over an eye 30 m deep: the sun's part of what is scattered to
// the eye is as much less as the sun is, and brings as much weaker shafts.
TEST(Shafts, AreDimInTheShadowOfClouds) {
  scene::Scene scene = deep_sea();
  put_sun_in_the_south(scene.sky, 0.5 * std::numbers::pi);
  scene.clouds.kind = scene::CloudKind::kPlaced;
  scene.clouds.wind_factor = 0.0;
  scene.clouds.cumulus = {{.position_m = {0.0, -3000.0}, .width_m = 3000.0, .height_m = 1200.0}};
  const World world(scene, deep_world(), 2);
  Shot film;
  const View view = view_of({.depth_m = 30.0, .pitch_rad = 0.2});
  const auto light_with = [&](PartSet without) {
    const std::vector<float> green = green_light(film.draw(world, view, 3.0, linear(without)));
    return std::accumulate(green.begin(), green.end(), 0.0);
  };
  const double shaded = light_with({}), even = light_with({Part::kCloudShadows});
  const Shading& shading = film.state().shading;
  const double sun_part = static_cast<double>(shading.shafts.sun_part);
  light_with({});
  const CloudShadow& shadow = *shading.sun_shadow.clouds;
  constexpr std::size_t kMiddle = CloudShadow::kSide / 2 * (CloudShadow::kSide + 1);
  const double left = static_cast<double>(shadow.words[0][kMiddle] & 255u) / 255.0;
  EXPECT_LT(left, 0.3);
  // Level rays across a sun straight above: Henyey and Greenstein's function with g = 1/2 is 0.537.
  const double phase = 0.75 / std::pow(1.25, 1.5);
  const double sun = phase * sun_part / (phase * sun_part + 1.0 - sun_part);
  EXPECT_NEAR(shaded / even, 1.0 - (1.0 - left) * sun, 0.05);
}

TEST(Shafts, AreTheSameBitsInTilesOfAnySize) {
  scene::Scene scene = deep_sea();
  scene.objects.push_back(slab({2.0, -3009.0}, {3.0, 3.0, 2.0}, -0.5));
  const World world(scene, deep_world(), 2);
  const View view = view_of({.pitch_rad = 0.3});
  std::vector<std::uint64_t> hashes;
  for (const int tile : {64, 32, 16}) {
    const FrameOptions options = {.tile_size_px = tile, .edge_samples = 4};
    hashes.push_back(picture_hash(Shot(world, view, 3.0, options, tile == 64 ? 1 : 3).target));
  }
  EXPECT_EQ(hashes[1], hashes[0]);
  EXPECT_EQ(hashes[2], hashes[0]);
}

// ---- Light from below

// A white slab over a sea of glass, from below: its underside.
scene::Scene slab_over_glass() {
  scene::Scene scene;
  scene.sea.wind_speed_mps = 0.0;
  scene.sky.zenith = scene.sky.horizon = glm::vec3(0.1f);
  scene.sky.sun_radiance = glm::vec3(2.0f);
  scene.sky.cloud_cover = 0.0;
  put_sun_in_the_south(scene.sky, 0.5);
  scene.detail.water_triangles = 500;
  scene.objects.push_back(slab({0.0, 0.0}, {6.0, 6.0, 0.5}, 1.5));
  return scene;
}

View from_below_the_slab() {
  return make_view({0.0, -0.2, 0.3}, 0.0, 0.45 * std::numbers::pi, 0.8, 0.25f, kShaftsWidth,
                   kShaftsHeight);
}

// What a mirror of water sends up: albedo / pi, the sun's irradiance, Fresnel, the cosine.
TEST(Uplight, IsTheSunThatFlatWaterMirrors) {
  const World world = world_of(slab_over_glass());
  const std::vector<float> with = green_of_shafts(world, from_below_the_slab(), 1.0);
  const std::vector<float> without =
      green_of_shafts(world, from_below_the_slab(), 1.0, {Part::kUplight});
  const double in_air = 0.5 * std::numbers::pi - 0.5;
  const double in_water = std::asin(std::sin(in_air) / 1.333);
  const double s = std::sin(in_air - in_water) / std::sin(in_air + in_water);
  const double p = std::tan(in_air - in_water) / std::tan(in_air + in_water);
  const double reflectance = 0.5 * (s * s + p * p);
  const auto irradiance = static_cast<double>(world.state().sky->irradiance.y);
  const double expected = 0.8 / std::numbers::pi * irradiance * reflectance * std::sin(0.5);
  for (const std::size_t i :
       {0, kShaftsWidth - 1, kShaftsWidth * kShaftsHeight / 2, kShaftsWidth * kShaftsHeight - 1})
    EXPECT_NEAR((with[i] - without[i]) / expected, 1.0, 0.01) << i;
}

TEST(Uplight, FallsOnNothingInShadow) {
  scene::Scene scene = slab_over_glass();
  scene.objects.push_back(slab({0.0, -12.0}, {30.0, 2.0, 30.0}, 0.0));
  const View view = from_below_the_slab();
  const double sunny = change_by(Part::kUplight, world_of(slab_over_glass()), view, 1.0).mean;
  EXPECT_LT(change_by(Part::kUplight, world_of(scene), view, 1.0).mean, 0.02 * sunny);
}

// With waves it moves, and has the same mean.
TEST(Uplight, IsMovedByWaves) {
  scene::Scene scene = slab_over_glass();
  const double flat = change_by(Part::kUplight, world_of(scene), from_below_the_slab(), 1.0).mean;
  scene.sea.wind_speed_mps = 3.0;
  scene.sea.patch_lengths_m = {97.0, 23.0, 5.3};
  const World world = world_of(scene);
  const View view = from_below_the_slab();
  double mean = 0.0;
  for (int i = 0; i < 6; ++i) {
    const Change change = change_by(Part::kUplight, world, view, 5.0 * i);
    EXPECT_GT(change.deviation, 0.1 * flat);
    mean += change.mean / 6;
  }
  EXPECT_NEAR(mean / flat, 1.0, 0.1);
  EXPECT_NE(Shot(world, view, 1.0, linear()).target.rgba,
            Shot(world, view, 1.3, linear()).target.rgba);
}

}  // namespace
}  // namespace swell::render
