// The sky, the air and the clouds from high up.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "math/elementary.h"
#include "render/linear_renderer.h"
#include "render/measures.h"
#include "render/world/world_state.h"
#include "sky/sky_light.h"

namespace swell::render {
namespace {

constexpr int kWidth_px = 48, kHeight_px = 128;
constexpr double kRadius_m = 6371e3 / 0.87;  // HOR: k = 0.13
constexpr std::array kHeights_m = {1500.0, 10000.0, 40000.0};

double dip(double height_m) { return std::sqrt(2.0 * height_m / kRadius_m); }  // its tangent

struct Renderer : LinearRenderer {
  using LinearRenderer::LinearRenderer;

  // Northwards.
  void draw(double height_m, double pitch_rad, double fov_rad, PartSet without = {}) {
    options.without = without;
    draw_view(
        make_view({0.0, 0.0, height_m}, 0.0, pitch_rad, fov_rad, 0.25f, kWidth_px, kHeight_px),
        5.0);
  }
  // The mean over a row.
  glm::vec3 row(int y) const {
    glm::vec3 sum(0.0f);
    for (int x = 0; x < kWidth_px; ++x) sum += linear(x, y);
    return sum / static_cast<float>(kWidth_px);
  }
  double sine(int y) const {
    return glm::normalize(view.ray(0.5f * kWidth_px, static_cast<float>(y) + 0.5f)).z;
  }
  // The mean of the codes of rows [begin, end).
  glm::vec3 mean_code(int begin, int end) const {
    glm::vec3 sum(0.0f);
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < kWidth_px; ++x) sum += glm::vec3(codes(x, y));
    return sum / static_cast<float>((end - begin) * kWidth_px);
  }
};

// At heights between those that were worked out, too.
TEST(Altitude, ShowsTheModelsSkyAtItsHeight) {
  for (const double sun_deg : {40.0, 3.0}) {
    Renderer renderer(calm_scene(sun_deg, 0.0));
    const sky::SkyLight sea_level =
        sky::make_sky_light(renderer.world.scene().sky, renderer.workers);
    for (const double height_m : {450.0, 2200.0, 7500.0, 13000.0, 33000.0, 48000.0}) {
      const sky::SkyLight light = sky_light_at_height(sea_level, height_m, renderer.workers);
      renderer.draw(height_m, radians(40.0), radians(80.0));
      for (int y = 0; y < kHeight_px; y += 3) {
        if (renderer.sine(y) < 0.05) continue;  // where it changes from pixel to pixel
        const glm::vec3 expected = clear_radiance(light, renderer.direction(10, y));
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(renderer.linear(10, y)[c], expected[c], 0.06f * expected[c] + 1e-4f)
              << sun_deg << " " << height_m << " " << y;
      }
    }
  }
}

// From the zenith down the sky grows brighter to the dipped horizon, without a step at 0 degrees or
// a band below, and the sea begins with the colour in which the sky ends.
TEST(Altitude, TheBrightBandLiesAtTheDippedHorizon) {
  for (const double height_m : kHeights_m) {
    Renderer renderer(calm_scene(40.0, 0.0));
    renderer.draw(height_m, -dip(height_m), radians(12.0));
    int first_sea = 0;
    while (first_sea < kHeight_px && renderer.sine(first_sea) > -dip(height_m)) ++first_sea;
    ASSERT_GT(first_sea, 50) << height_m;
    float before = luminance(renderer.row(0)), most_growth = 0.0f;
    int brightest = 0;
    for (int y = 1; y < first_sea; ++y) {
      const float here = luminance(renderer.row(y));
      EXPECT_GT(here, 0.99f * before) << height_m << " m, row " << y;
      if (here >= luminance(renderer.row(brightest))) brightest = y;
      most_growth = std::max(most_growth, here / before);
      before = here;
    }
    EXPECT_LT(renderer.sine(brightest), 0.04 - dip(height_m)) << height_m;  // within 2.3 degrees
    EXPECT_LT(most_growth, 1.09f) << height_m;
    const glm::vec3 sky = renderer.row(first_sea - 2), sea = renderer.row(first_sea + 1);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sea[c] / sky[c], 1.0f, 0.1f) << height_m << " " << c;
  }
}

// Below eye height, over the sea's edge.
TEST(Altitude, TheSunsDiscIsWholeDownToTheDip) {
  for (const auto& [height_m, sun_deg] : {std::pair(10000.0, -1.5), std::pair(40000.0, -5.0)}) {
    Renderer renderer(calm_scene(sun_deg, 0.0, 0.0));
    renderer.draw(height_m, radians(sun_deg), radians(2.0));
    const std::vector<float> green = green_light(renderer.target);
    const float half = 0.5f * std::ranges::max(green);
    const auto bright =
        static_cast<double>(std::ranges::count_if(green, [&](float g) { return g > half; }));
    const double radius_px = 0.004654 * kHeight_px / (2.0 * renderer.view.tan_half_y);
    EXPECT_NEAR(bright / (kPi * radius_px * radius_px), 1.0, 0.1) << height_m;
  }
}

// What air adds straight down from high up is blue, and much less than at the horizon.
TEST(Altitude, AirBelowIsABlueVeil) {
  scene::Scene scene = calm_scene(40.0, 0.0);
  scene.sky.haze_distance_m = 1e7;
  Renderer renderer(scene);
  for (const double height_m : {10000.0, 40000.0}) {
    const auto middle = [&](PartSet without, double pitch_deg) {
      renderer.draw(height_m, radians(pitch_deg), radians(4.0), without);
      return renderer.row(kHeight_px / 2);
    };
    const glm::vec3 veil = middle({}, -89.0) - middle({Part::kHaze}, -89.0);
    const glm::vec3 horizon = middle({}, 0.5 - dip(height_m) * 180.0 / kPi);
    EXPECT_GT(veil.z, 1.3f * veil.y) << height_m;
    EXPECT_GT(veil.z, 2.0f * std::abs(veil.x)) << height_m;
    EXPECT_LT(luminance(veil), 0.3f * luminance(horizon)) << height_m;
  }
}

// The layer lies under an eye above it: before the sea, and nowhere above the layer's own horizon.
TEST(Altitude, CloudsLieBelowAnEyeAboveThem) {
  Renderer renderer(calm_scene(40.0, 0.5));
  for (const double height_m : {6000.0, 10000.0, 40000.0}) {
    const double clouds_dip = dip(height_m - sky::kCloudHeight_m);
    const auto green_without = [&](PartSet without) {
      renderer.draw(height_m, -clouds_dip - 0.1, radians(40.0), without);
      return green_light(renderer.target);
    };
    const std::vector<float> clouds = green_without({}), clear = green_without({Part::kClouds});
    int changed = 0;
    for (int y = 0; y < kHeight_px; ++y)
      for (int x = 0; x < kWidth_px; ++x) {
        const std::size_t i = renderer.at(x, y);
        const bool is_changed = std::abs(clouds[i] - clear[i]) > 0.02f * clouds[i];
        if (renderer.direction(x, y).z > -clouds_dip + 0.002) {
          EXPECT_FALSE(is_changed) << height_m << " " << x << " " << y;
        }
        changed += is_changed;
      }
    EXPECT_GT(changed, kWidth_px * kHeight_px / 8) << height_m;
  }
}

// Nothing flashes when the eye passes through the layer, nor anywhere else on its way up: eighths
// of the picture change by about as much as with the metre before.
TEST(Altitude, RisesWithoutAJump) {
  constexpr int kRows = kHeight_px / 8;
  for (const double cloud_cover : {0.4, 1.0}) {
    Renderer renderer(calm_scene(30.0, cloud_cover));
    const auto bands_at = [&](double height_m) {
      renderer.draw(height_m, -0.1, radians(60.0));
      std::array<glm::vec3, 8> bands;
      for (int i = 0; i < 8; ++i) bands[i] = renderer.mean_code(i * kRows, (i + 1) * kRows);
      return bands;
    };
    for (const double height_m : {20.0, 300.0, 1600.0, 4000.0, 10000.0, 60000.0}) {
      const auto low = bands_at(height_m - 1.5), below = bands_at(height_m - 0.5),
                 above = bands_at(height_m + 0.5);
      for (std::size_t i = 0; i < 8; ++i)
        EXPECT_LT(glm::length(above[i] - below[i]), 1.5f + 2.0f * glm::length(below[i] - low[i]))
            << cloud_cover << " " << height_m << " " << i;
    }
  }
}

TEST(Altitude, CanBeLeftOut) {
  Renderer renderer(calm_scene(40.0, 0.0));
  const auto zenith = [&](double height_m, PartSet without) {
    renderer.draw(height_m, radians(80.0), radians(10.0), without);
    return luminance(renderer.row(5));
  };
  const float sea_level = zenith(5.0, {Part::kAltitude});
  EXPECT_NEAR(zenith(40000.0, {Part::kAltitude}) / sea_level, 1.0f, 1e-3f);
  EXPECT_LT(zenith(40000.0, {}), 0.02f * sea_level);
}

// The border of a map and the deep floor around its apron do not show from 1500 m up: no step in 13
// m across the one, and over the other water as if there were no floor.
TEST(Altitude, NoSquareOfGroundShowsInDeepWater) {
  constexpr int kMiddle_px = kHeight_px / 2;
  scene::Scene scene = load_shipped("lagoon");
  scene.sky.cloud_cover = 0.0;
  scene.picture.edge_samples = 0;
  Renderer renderer(scene);
  const terrain::HeightGrid& land = *renderer.world.state().terrain;
  const double half_m = 0.5 * land.grid.size_m();
  const glm::dvec2 middle = land.grid.min_world + half_m;
  for (const glm::dvec2& side : {glm::dvec2(-1, 0), {1, 0}, {0, 1}, {0, -1}}) {
    const auto draw_at = [&](glm::dvec2 at, PartSet without) {
      renderer.options.without = without;
      renderer.draw_view(make_view({middle + half_m * at, 1500.0}, std::atan2(side.x, side.y),
                                   radians(-89.99), radians(8.0), 0.25f, kWidth_px, kHeight_px),
                         5.0);
    };
    const auto expect_alike = [&](glm::vec3 a, glm::vec3 b, float codes) {
      const glm::vec3 step = glm::abs(a - b);
      EXPECT_LT(std::max({step.x, step.y, step.z}), codes)
          << side.x << " " << side.y << ": " << step.x << " " << step.y << " " << step.z;
    };
    draw_at(side, {});
    expect_alike(renderer.mean_code(kMiddle_px, kMiddle_px + 8),
                 renderer.mean_code(kMiddle_px - 8, kMiddle_px), 2.0f);
    const glm::dvec2 off_corner = 1.45 * (side + glm::dvec2(side.y, -side.x));
    draw_at(off_corner, {});
    const glm::vec3 with_floor = renderer.mean_code(0, kHeight_px);
    draw_at(off_corner, {Part::kApron});
    expect_alike(with_floor, renderer.mean_code(0, kHeight_px), 0.7f);
  }
}

}  // namespace
}  // namespace swell::render
