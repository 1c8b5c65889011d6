// Pictures exposed by a camera's f-number, time and speed: against the light that photographers
// measure, and that nothing else changes.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "render/linear_renderer.h"
#include "scene/camera.h"
#include "sky/sky_light.h"

namespace swell::render {
namespace {

constexpr double kCardReflectance = 0.18, kMiddleGrey = 0.18;

// A grey card lies over a flat sea at noon, the camera on the sun's side of it, so that it does not
// shine.
scene::Scene card_scene() {
  scene::Scene scene = scene::parse_scene(R"(
[camera]
eye_m = [0, -6, 9]
pitch_deg = -45
fov_y_deg = 20
[sky]
sun_azimuth_deg = 180
sun_elevation_deg = 55
cloud_cover = 0
[sea]
spectrum = false
[detail]
water_triangles = 1000
[[object]]
kind = "box"
size_m = [8, 8, 0.2]
motion = "fixed"
height_m = 3
colour = [0.18, 0.18, 0.18]
roughness = 0.5
)",
                                          "card.toml");
  return scene;
}

// Sunny 16.
scene::Scene exposed(scene::Scene scene, double f_number = 16.0, double exposure_s = 0.01,
                     double iso = 100.0) {
  scene.camera.f_number = f_number;
  scene.camera.exposure_s = exposure_s;
  scene.camera.noise.iso = iso;
  return scene;
}

// The illuminance of a level surface [10 000 lx]: the sun's, and the sky's added up over it.
double level_illuminance(const sky::SkyLight& light) {
  constexpr int kRings = 60, kSectors = 120;
  double sum = 0.0;
  for (int i = 0; i < kRings; ++i)
    for (int j = 0; j < kSectors; ++j) {
      const double z = std::sqrt((i + 0.5) / kRings);  // rings of equal weight by the cosine
      const double across = std::sqrt(1.0 - z * z), angle = 2.0 * kPi * (j + 0.5) / kSectors;
      sum += static_cast<double>(
          clear_radiance(light, glm::vec3(across * std::cos(angle), across * std::sin(angle), z))
              .y);
    }
  return static_cast<double>(light.irradiance.y * light.to_light.z) +
         kPi * sum / (kRings * kSectors);
}

glm::vec3 middle_of(const Shot& shot) {
  return shot.linear(shot.view.width_px / 2, shot.view.height_px / 2);
}

// A meter of the ISO 2720 standard with K = 12.5 wants L = K N^2 / (t S) cd/m^2 for middle grey.
TEST(CameraExposure, ShowsAMetersReadingAsMiddleGrey) {
  for (const double n : {1.4, 16.0})
    for (const double t_s : {0.001, 8.0})
      for (const double iso : {100.0, 6400.0}) {
        const double metered_cd_m2 = 12.5 * n * n / (t_s * iso);
        EXPECT_NEAR(scene::camera_exposure(n, t_s, iso) * metered_cd_m2 / 1e4, kMiddleGrey,
                    0.02 * kMiddleGrey);
      }
}

// By hand: 50 000 lx on the card are 2865 cd/m^2, at f/16 and 1/100 s 0.0879 lx s of the 0.1 that
// are shown as 0.18.
TEST(CameraExposure, ShowsAGreyCardAsItsIlluminanceSays) {
  EXPECT_NEAR(scene::camera_exposure(16.0, 0.01, 100.0) * kCardReflectance * 5.0 / kPi,
              0.18 * 0.0879 / 0.1, 1e-4);
  const scene::Scene scene = exposed(card_scene());
  Workers workers(1);
  const double illuminance = level_illuminance(sky::make_sky_light(scene.sky, workers));
  const World world(scene);
  const Shot shot(world, view_of(world, 0.0, 64, 64), 0.0, {.keep_linear = true});
  EXPECT_EQ(shot.target.exposure, 1.0f);
  const double expected =
      scene::camera_exposure(16.0, 0.01, 100.0) * kCardReflectance / kPi * illuminance;
  EXPECT_NEAR(static_cast<double>(middle_of(shot).y), expected, 0.03 * expected);
  // Sunny 16: within a stop of middle grey, in the picture as well.
  EXPECT_NEAR(std::log2(expected / kMiddleGrey), 0.0, 1.0);
  const glm::ivec3 codes = shot.codes(32, 32);
  EXPECT_NEAR(codes.y,
              255.0 * (1.055 * std::pow(static_cast<double>(middle_of(shot).y), 1 / 2.4) - 0.055),
              1.5);
}

TEST(CameraExposure, IsWithinAStopOfTheSkysOwnAtSunny16) {
  const scene::Scene scene = card_scene();
  const World plain(scene), photo(exposed(scene), plain, 2);
  const View view = view_of(plain, 0.0, 64, 64);
  const FrameOptions linear = {.keep_linear = true};
  const Shot as_the_sky_says(plain, view, 0.0, linear), by_camera(photo, view, 0.0, linear);
  const float ratio = middle_of(by_camera).y / middle_of(as_the_sky_says).y;
  EXPECT_NEAR(std::log2(ratio), 0.0f, 1.0f);
}

// Powers of two, so that no bit is lost.
TEST(CameraExposure, GoesWithTimeAndSpeedAndOneOverTheSquareOfTheFNumber) {
  scene::Scene scene = load_shipped("buoys");
  scene.sky.exposure.reset();
  const World one(exposed(scene));
  const View view = view_of(one, 4.0, 96, 54);
  const FrameOptions linear = {.keep_linear = true};
  const Shot reference(one, view, 4.0, linear);
  const auto expect_times = [&](const scene::Scene& other, float factor) {
    const World world(other, one, 2);
    const Shot shot(world, view, 4.0, linear);
    for (std::size_t i = 0; i < shot.target.linear.size(); ++i)
      ASSERT_EQ(shot.target.linear[i], factor * reference.target.linear[i]) << i;
  };
  expect_times(exposed(scene, 8.0), 4.0f);
  expect_times(exposed(scene, 16.0, 0.02), 2.0f);
  expect_times(exposed(scene, 16.0, 0.01, 200.0), 2.0f);
}

TEST(CameraExposure, OfOptionsIsThatOfTheCamera) {
  scene::Scene scene = load_shipped("buoys");
  scene.sky.exposure.reset();
  const World plain(scene), photo(exposed(scene, 11.0), plain, 2);
  const View view = view_of(plain, 4.0, 96, 54);
  FrameOptions options;
  const Shot by_scene(photo, view, 4.0, options);
  EXPECT_NE(picture_hash(by_scene.target), picture_hash(Shot(plain, view, 4.0, options).target));
  EXPECT_TRUE(by_scene.target.linear.empty());
  options.exposure = scene::camera_exposure(11.0, 0.01, 100.0);
  EXPECT_EQ(picture_hash(by_scene.target), picture_hash(Shot(plain, view, 4.0, options).target));
}

// From 40 km the eye adapts to the dawn there, a camera does not.
TEST(CameraExposure, IsTheSameAtAllHeights) {
  scene::Scene scene;
  scene.sky.sun_elevation_rad = radians(-8.0);
  scene.sky.sun_direction = sky::sun_direction(0.0, scene.sky.sun_elevation_rad);
  scene.sky.cloud_cover = 0.0;
  scene.detail.water_triangles = 100;
  const scene::Scene photo_scene = exposed(scene, 2.0, 0.5, 800.0);
  const World world(photo_scene);
  Workers workers(1);
  const sky::SkyLight light =
      sky_light_at_height(sky::make_sky_light(scene.sky, workers), 40000.0, workers);
  const View view =
      make_view({0.0, 0.0, 40000.0}, 0.0, radians(20.0), radians(10.0), 0.25f, 33, 33);
  FrameOptions options = {.keep_linear = true};
  options.without.add(Part::kStars);
  const Shot shot(world, view, 0.0, options);
  const float expected = static_cast<float>(scene::camera_exposure(2.0, 0.5, 800.0)) *
                         clear_radiance(light, shot.direction(16, 16)).y;
  EXPECT_NEAR(shot.linear(16, 16).y, expected, 0.03f * expected);
}

// As much light fills the well at each exposure, and the noise of a wide camera's faces is added
// once they are put together.
TEST(CameraExposure, GoesWithNoiseAndWideCameras) {
  scene::Scene scene = load_shipped("buoys");
  scene.sky.exposure.reset();
  const World one(exposed(scene, 8.0, 0.01, 200.0));
  View view = view_of(one, 4.0, 96, 48);
  view.projection.kind = ProjectionKind::kEquirectangular;
  const FrameOptions linear = {.keep_linear = true};
  const Shot clean(one, view, 4.0, linear);
  EXPECT_EQ(clean.target.exposure, 1.0f);
  scene.camera.noise.full_well_e = 1e7;
  const World loud(exposed(scene, 8.0, 0.01, 200.0), one, 2);
  const Shot noisy(loud, view, 4.0, linear);
  ASSERT_EQ(noisy.target.linear.size(), clean.target.linear.size());
  for (std::size_t i = 0; i < clean.target.linear.size(); ++i) {
    const float light = std::min(clean.target.linear[i], 8.0f);
    EXPECT_NEAR(noisy.target.linear[i], light, 0.02f * std::sqrt(light) + 1e-3f);
  }
  // Options' noise has the speed that exposes, of wide pictures too.
  FrameOptions fast = linear;
  fast.noise = scene::SensorNoise{.full_well_e = 0.0, .iso = 400.0, .read_noise_e = 3.0, .seed = 1};
  const Shot twice(one, view, 4.0, fast);
  for (std::size_t i = 0; i < clean.target.linear.size(); ++i)
    EXPECT_NEAR(twice.target.linear[i], 2.0f * clean.target.linear[i],
                1e-6f * clean.target.linear[i]);
}

TEST(CameraExposureDeathTest, RefusesNone) {
  const World& world = shipped_world("open_ocean");
  FrameOptions options;
  options.exposure = 0.0;
  EXPECT_DEATH(Shot(world, view_of(world, 0.0, 32, 32), 0.0, options), "exposure=0");
}

}  // namespace
}  // namespace swell::render
