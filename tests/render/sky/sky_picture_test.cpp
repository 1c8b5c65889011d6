// The sky in pictures: what is drawn is the model's light; disc, clouds and darkness.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "render/linear_renderer.h"
#include "sky/sky_light.h"

namespace swell::render {
namespace {

constexpr int kSkySide_px = 96;
constexpr double kSkyEye_m = 10.0;

scene::Scene sky_scene(double elevation_deg, double cloud_cover) {
  scene::Scene scene;
  scene.sky.sun_elevation_rad = radians(elevation_deg);
  scene.sky.sun_direction = sky::sun_direction(0.0, scene.sky.sun_elevation_rad);
  scene.sky.cloud_cover = cloud_cover;
  scene.sea.resolution = 16;
  scene.detail.water_triangles = 100;
  return scene;
}

// Square pictures from the height of the sea, northwards.
struct SkyRenderer : LinearRenderer {
  explicit SkyRenderer(const scene::Scene& scene) : LinearRenderer(scene) {
    options.without.add(Part::kStars);
  }
  SkyRenderer(const scene::Scene& scene, double pitch_deg, double fov_deg) : SkyRenderer(scene) {
    draw(pitch_deg, fov_deg);
  }

  void draw(double pitch_deg, double fov_deg, double t_s = 0.0) {
    draw_view(make_view({0.0, 0.0, kSkyEye_m}, 0.0, radians(pitch_deg), radians(fov_deg), 0.25f,
                        kSkySide_px, kSkySide_px),
              t_s);
  }
  float brightest() const { return std::ranges::max(target.linear); }
};

template <class Visit>
void for_each_pixel(const Visit& visit) {
  for (int y = 0; y < kSkySide_px; ++y)
    for (int x = 0; x < kSkySide_px; ++x) visit(x, y);
}

// Through maps and samplers, to 2 %; the radiance is the picture's times one factor.
TEST(SkyPicture, ShowsTheModelsLight) {
  for (const double elevation_deg : {70.0, 20.0, 3.0, -5.0, -14.0}) {
    const scene::Scene scene = sky_scene(elevation_deg, 0.0);
    const SkyRenderer sky(scene, 50.0, 80.0);
    Workers workers(1);
    const sky::SkyLight light =
        sky_light_at_height(sky::make_sky_light(scene.sky, workers), kSkyEye_m, workers);
    const float exposure = sky.linear(5, 60).y / clear_radiance(light, sky.direction(5, 60)).y;
    for_each_pixel([&](int x, int y) {
      const glm::vec3 d = sky.direction(x, y);
      if (glm::distance(d, light.to_light) < 0.06f) return;  // the disc, and next to it
      const glm::vec3 expected = exposure * clear_radiance(light, d);
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(sky.linear(x, y)[c], expected[c], 0.02f * expected[c] + 1e-4f)
            << elevation_deg << " " << x << " " << y;
    });
  }
}

TEST(SkyPicture, DiscIsHalfADegreeAcross) {
  const SkyRenderer sky(sky_scene(30.0, 0.0), 30.0, 1.0);
  const float half = 0.5f * sky.brightest();
  int bright = 0;
  for_each_pixel([&](int x, int y) { bright += sky.linear(x, y).y > half; });
  const double radius_px = 0.004654 * kSkySide_px / (2.0 * sky.view.tan_half_y);
  EXPECT_NEAR(bright / (kPi * radius_px * radius_px), 1.0, 0.03);
}

// Its radiance times the solid angle that it fills is the light that it gives.
TEST(SkyPicture, DiscIsAsBrightAsItsLight) {
  const SkyRenderer sky(sky_scene(30.0, 0.0), 30.0, 1.0);
  const Light& light = sky.state().shading.light;
  const float solid_angle = static_cast<float>(kPi) * 0.004654f * 0.004654f;
  EXPECT_NEAR(sky.linear(kSkySide_px / 2, kSkySide_px / 2).y * solid_angle / light.sun_irradiance.y,
              1.0f, 0.02f);
}

TEST(SkyPicture, OvercastHidesTheDiscAndTheBlue) {
  const SkyRenderer sky(sky_scene(40.0, 1.0), 40.0, 60.0);
  const glm::vec3 middle = sky.linear(10, 10);
  EXPECT_LT(sky.brightest(), 4.0f * middle.y);
  for_each_pixel([&](int x, int y) {
    const glm::vec3 here = sky.linear(x, y);
    ASSERT_LT(here.z, 1.4f * here.x) << x << " " << y;
  });
  EXPECT_LT(sky.state().shading.light.sun_irradiance.y, 1e-3f);
}

TEST(SkyPicture, CloudsCoverWhatTheSceneSays) {
  double before = -1.0;
  for (const double cover : {0.0, 0.2, 0.5, 0.8, 1.0}) {
    SkyRenderer sky(sky_scene(50.0, cover));
    double covered = 0.0;
    for (const double t_s : {0.0, 900.0, 1800.0, 2700.0}) {
      sky.options.without = {};
      sky.draw(70.0, 110.0, t_s);
      const std::vector<float> clouds = sky.target.linear;
      sky.options.without.add(Part::kClouds);
      sky.draw(70.0, 110.0, t_s);
      const auto changed = [&](std::size_t i) {
        return std::abs(clouds[i] - sky.target.linear[i]) > 0.1f * sky.target.linear[i];
      };
      for (std::size_t i = 0; i < clouds.size(); i += 3)
        covered += changed(i) || changed(i + 1) || changed(i + 2);
    }
    covered /= 4.0 * kSkySide_px * kSkySide_px;
    EXPECT_GT(covered, before) << cover;
    EXPECT_NEAR(covered, cover, 0.22);
    before = covered;
  }
}

// Magnified, a cloud is smooth: the map's texels do not show.
TEST(SkyPicture, CloudsAreSmoothAtEveryZoom) {
  SkyRenderer sky(sky_scene(50.0, 0.6));
  for (const double fov_deg : {1.0, 4.0}) {
    sky.draw(35.0, fov_deg);
    for (int y = 0; y < kSkySide_px; ++y)
      for (int x = 1; x + 1 < kSkySide_px; ++x) {
        const float bend =
            sky.linear(x - 1, y).y - 2.0f * sky.linear(x, y).y + sky.linear(x + 1, y).y;
        ASSERT_LT(std::abs(bend), 0.012f) << fov_deg << " " << x << " " << y;
      }
  }
}

// A dark sky's light changes evenly: by as much from pixel to pixel as from the one before, to less
// than the eye would see.
TEST(SkyPicture, DarkSkiesHaveNoBands) {
  for (const double elevation_deg : {-8.0, -13.0, -25.0}) {
    const SkyRenderer sky(sky_scene(elevation_deg, 0.0), 30.0, 20.0);
    for (int y = 2; y < kSkySide_px; ++y) {
      const float before = sky.linear(7, y - 1).y / sky.linear(7, y - 2).y;
      ASSERT_NEAR(sky.linear(7, y).y / sky.linear(7, y - 1).y, before, 0.004f)
          << elevation_deg << " " << y;
    }
  }
}

TEST(SkyPicture, CloudsDriftWithTheWindAndInTheMirror) {
  scene::Scene scene = sky_scene(50.0, 0.5);
  scene.sea.wind_speed_mps = 10.0;
  SkyRenderer sky(scene);
  const auto soft_at = [&](double t_s) {
    sky.draw(30.0, 60.0, t_s);
    return sky.state().shading.light.sky_soft->words;
  };
  const auto first = soft_at(0.0);
  const std::vector<float> picture = sky.target.linear;
  EXPECT_FALSE(first == soft_at(300.0));
  EXPECT_FALSE(picture == sky.target.linear);
  EXPECT_TRUE(first == soft_at(0.0));
  EXPECT_TRUE(picture == sky.target.linear);
}

TEST(SkyPicture, LoopsWithTheSea) {
  scene::Scene scene = sky_scene(50.0, 0.5);
  scene.sea.loop_s = 8.0;
  SkyRenderer sky(scene);
  sky.draw(30.0, 60.0, 3.0);
  const std::vector<std::uint32_t> first = sky.target.rgba;
  sky.draw(30.0, 60.0, 11.0);
  EXPECT_TRUE(first == sky.target.rgba);
}

TEST(SkyPicture, AFixedExposureIsKept) {
  scene::Scene scene = sky_scene(50.0, 0.0);
  scene.sky.exposure = 0.5;
  const SkyRenderer sky(scene, 80.0, 20.0);
  const float once = sky.linear(40, 40).y;
  scene.sky.exposure = 1.0;
  const SkyRenderer brighter(scene, 80.0, 20.0);
  EXPECT_NEAR(brighter.linear(40, 40).y / once, 2.0f, 1e-3f);
}

TEST(SkyPicture, NightsAreDarkerThanDuskAndDuskThanDay) {
  double before = 1e9;
  for (const double elevation_deg : {40.0, -4.0, -20.0}) {
    const SkyRenderer sky(sky_scene(elevation_deg, 0.0), 60.0, 60.0);
    double sum = 0.0;
    for_each_pixel([&](int x, int y) { sum += std::min(sky.linear(x, y).y, 1.0f); });
    const double mean = sum / (kSkySide_px * kSkySide_px);
    EXPECT_LT(mean, before) << elevation_deg;
    EXPECT_GT(mean, 0.01) << elevation_deg;
    before = mean;
  }
}

}  // namespace
}  // namespace swell::render
