// Fog in pictures.
#include "sky/fog.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/linear_renderer.h"
#include "render/measures.h"
#include "render/sky/sky_maps.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

scene::Scene foggy_sea(double visibility_m, double top_m) {
  scene::Scene scene;
  scene.air.visibility_m = visibility_m;
  scene.air.fog_top_m = top_m;
  scene.sky.sun_azimuth_rad = radians(90.0);
  scene.sky.sun_direction = {0.8660254f, 0.0f, 0.5f};
  scene.sky.cloud_cover = 0.0;
  return scene;
}

scene::Scene without_fog(scene::Scene scene) {
  scene.air = {};
  return scene;
}

View level_view(glm::dvec3 eye, double pitch_deg) {
  return scene::camera_view({.eye_m = eye, .pitch_rad = radians(pitch_deg)}, 0.0, 96, 64);
}

// A linear picture of a world of its own.
struct LinearPicture : LinearRenderer {
  LinearPicture(const scene::Scene& scene, const View& seen, double t_s) : LinearRenderer(scene) {
    draw_view(seen, t_s);
  }
};

// In thick fog the sea goes over into the sky without a line.
TEST(FogInPictures, HidesTheHorizon) {
  scene::Scene scene = foggy_sea(200.0, 100.0);
  scene.sea.wind_speed_mps = 2.0;
  const LinearPicture foggy(scene, level_view({0, 0, 5}, 0.0), 3.0);
  float steepest = 0.0f;
  for (int x = 0; x < 96; x += 7)
    for (int y = 26; y < 33; ++y) {
      const float a = luminance(foggy.linear(x, y)), b = luminance(foggy.linear(x, y + 1));
      steepest = std::max(steepest, std::abs(a - b) / std::max(a, b));
    }
  EXPECT_LT(steepest, 0.01f);
}

// Light over the fog is taken from it, not added: no picture in the fog is brighter than a white
// surface under the same sky, away from the sun.
TEST(FogInPictures, IsNoBrighterThanWhite) {
  const LinearPicture foggy(foggy_sea(300.0, 80.0), level_view({0, 0, 3}, 0.0), 0.0);
  // The sky's mean and the sun on a level surface, by the sea's own exposure.
  glm::vec3 brightest(0.0f);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 96; ++x) brightest = glm::max(brightest, foggy.linear(x, y));
  // A clear sky at 30 degrees of sun: white is about 1.2 in exposed units.
  EXPECT_LT(luminance(brightest), 1.2f);
  EXPECT_GT(luminance(brightest), 0.1f);
}

TEST(FogInPictures, WithoutItTheSceneIsTheClearOne) {
  const scene::Scene scene = foggy_sea(500.0, 60.0);
  const View view = level_view({0, 0, 5}, -4.0);
  LinearRenderer foggy(scene);
  foggy.options.without = {Part::kFog};
  foggy.draw_view(view, 2.0);
  const LinearPicture bare(without_fog(scene), view, 2.0);
  EXPECT_EQ(foggy.target.rgba, bare.target.rgba);
}

// In a slab the thicker of fog and haze counts: visibility is that of all the air.
TEST(FogInPictures, TakesThePlaceOfHaze) {
  const scene::Scene scene = foggy_sea(400.0, 60.0);
  scene::Scene hazy = scene;
  hazy.sky.haze_distance_m = 3000.0;
  const View view = level_view({0, 0, 5}, -4.0);
  const LinearPicture foggy(scene, view, 2.0), both(hazy, view, 2.0);
  for (int y = 40; y < 64; ++y) EXPECT_EQ(foggy.linear(48, y), both.linear(48, y)) << y;
}

// Fog that thins out to nothing leaves the clear picture.
TEST(FogInPictures, LimitsAreTheClearPicture) {
  const View view = level_view({0, 0, 30}, -4.0);
  const scene::Scene clear = without_fog(foggy_sea(500.0, 60.0));
  const LinearPicture bare(clear, view, 2.0);
  scene::Scene thin = clear;
  thin.air.attenuation_per_m = glm::vec3(1e-12f);
  for (const scene::Scene& scene : {thin, foggy_sea(500.0, 0.0)}) {
    const LinearPicture drawn(scene, view, 2.0);
    float most = 0.0f;
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 96; ++x)
        most = std::max(most, glm::distance(drawn.linear(x, y), bare.linear(x, y)));
    EXPECT_LT(most, 2e-3f);
  }
}

// From over the fog the horizon is as it was; what lies under it is white.
TEST(FogInPictures, LiesUnderAnEyeAboveIt) {
  const scene::Scene scene = foggy_sea(100.0, 40.0);
  const View view = level_view({0, 0, 300}, -10.0);
  const LinearPicture foggy(scene, view, 2.0), bare(without_fog(scene), view, 2.0);
  EXPECT_EQ(foggy.linear(48, 2), bare.linear(48, 2));
  EXPECT_GT(luminance(foggy.linear(48, 60)), 2.0f * luminance(bare.linear(48, 60)));
}

// Clouds are seen through the fog, not before it.
TEST(FogInPictures, HidesVolumetricClouds) {
  scene::Scene scene = foggy_sea(60.0, 100.0);
  scene.clouds.kind = scene::CloudKind::kLayer;
  const View view = level_view({0, 0, 3}, 10.0);
  LinearPicture cloudy(scene, view, 0.0);
  const glm::vec3 with = cloudy.linear(48, 10);
  cloudy.options.without = {Part::kClouds};
  cloudy.draw_view(view, 0.0);
  EXPECT_LT(glm::distance(with, cloudy.linear(48, 10)), 0.01f * glm::length(with));
}

// Diving from over the fog into it, a pixel changes little by little.
TEST(FogInPictures, NoJumpWhereTheEyeEntersIt) {
  LinearRenderer foggy(foggy_sea(400.0, 40.0));
  glm::vec3 last(-1.0f);
  for (const double z : {40.02, 40.01, 40.0, 39.99, 39.98}) {
    foggy.draw_view(level_view({0, 0, z}, -6.0), 2.0);
    const glm::vec3 now = foggy.linear(48, 20);
    if (last.x >= 0.0f) {
      EXPECT_LT(glm::distance(now, last), 0.01f * glm::length(now)) << z;
    }
    last = now;
  }
}

// A frame alone is the frame of a sequence, also where banks drift.
TEST(FogInPictures, FrameAloneIsThatOfASequence) {
  scene::Scene scene = foggy_sea(400.0, 40.0);
  scene.air.banks = 1.0;
  const View view = level_view({0, 0, 60}, -20.0);
  LinearRenderer sequence(scene);
  for (const double t_s : {0.0, 1.0, 25.0}) sequence.draw_view(view, t_s);
  const LinearPicture alone(scene, view, 25.0);
  EXPECT_EQ(alone.target.rgba, sequence.target.rgba);
}

// One cloud, and the sun over it.
void put_cloud_overhead(scene::Scene& scene) {
  scene.sky.sun_elevation_rad = radians(90.0);
  scene.sky.sun_direction =
      sky::sun_direction(scene.sky.sun_azimuth_rad, scene.sky.sun_elevation_rad);
  scene.clouds.kind = scene::CloudKind::kPlaced;
  scene.clouds.wind_factor = 0.0;
  scene.clouds.cumulus = {{.width_m = 3000.0, .height_m = 1200.0}};
}

// Fog so thick that all of a picture is the light of some fifty metres, under the middle of a
// cloud.
TEST(FogInPictures, IsDarkUnderACloudByWhatItTakesOfTheSun) {
  scene::Scene scene = foggy_sea(60.0, 100.0);
  put_cloud_overhead(scene);
  const View view = level_view({0, 0, 3}, 4.0);
  LinearPicture cloudy(scene, view, 0.0);
  const CloudShadow& shadow = cloudy.state().sky.shadow;
  ASSERT_TRUE(shadow.any);
  constexpr std::size_t kMiddle = CloudShadow::kSide / 2 * (CloudShadow::kSide + 1);
  const float left = static_cast<float>(shadow.words[0][kMiddle] & 255u) / 255.0f * shadow.most;
  EXPECT_LT(left, 0.3f);
  const glm::vec3 shaded = cloudy.linear(48, 20);
  cloudy.options.without = {Part::kCloudShadows};
  cloudy.draw_view(view, 0.0);
  const FogLights& light = *cloudy.world.state().fog_light;
  const glm::vec3 of_sky = light.even - light.even_sun, sunny = cloudy.linear(48, 20);
  EXPECT_GT(sunny.y, 2.0f * of_sky.y);
  EXPECT_NEAR((shaded.y - of_sky.y) / (sunny.y - of_sky.y), left, 0.02f);
}

// A white slab in the fog, under the same cloud and far from it: fog sends down less of the sun.
TEST(FogInPictures, LightsWhatIsUnderACloudLess) {
  scene::Scene scene = foggy_sea(400.0, 300.0);
  put_cloud_overhead(scene);
  scene.sea.spectrum = false;
  scene::FloatingObject slab;
  slab.kind = scene::ObjectKind::kBox;
  slab.motion = scene::Motion::kFixed;
  slab.size_m = {4.0, 4.0, 1.0};
  slab.colour = glm::vec3(0.8f);
  scene.objects = {slab, slab};
  scene.objects[1].position_m = {0.0, 9000.0};
  LinearRenderer cloudy(scene);
  const auto slab_at = [&](double y_m) {
    cloudy.draw_view(level_view({0, y_m, 4}, -89.9), 0.0);
    return luminance(cloudy.linear(48, 32));
  };
  const float shaded = slab_at(0.0), lit = slab_at(9000.0);
  cloudy.options.without = {Part::kCloudShadows};
  const float even = slab_at(0.0);
  EXPECT_NEAR(lit, even, 0.02f * even);
  const WorldState& world = cloudy.world.state();
  // A few hundredths are left of the light that is not the sky's.
  const float of_sky = luminance(world.fog_light->ambient - world.fog_light->ambient_sun);
  EXPECT_LT(shaded, 0.25f * even + 0.8f * of_sky);
}

// Near and far ways share packets in one tile and not in another.
TEST(FogInPictures, UnderCloudsIsTheSameInTilesOfAnySize) {
  scene::Scene scene = foggy_sea(5000.0, 80.0);
  scene.sky.cloud_cover = 0.5;
  scene.air.banks = 0.5;
  const View view = level_view({0, 0, 4}, -3.0);
  LinearPicture foggy(scene, view, 2.0);
  const std::vector<std::uint32_t> expected = foggy.target.rgba;
  for (const int tile_size_px : {16, 32}) {
    foggy.options.tile_size_px = tile_size_px;
    foggy.draw_view(view, 2.0);
    EXPECT_EQ(foggy.target.rgba, expected) << tile_size_px;
  }
}

}  // namespace
}  // namespace swell::render
