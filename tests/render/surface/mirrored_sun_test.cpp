// The sun's path on the water ends where the water mirrors something that stands before the sun.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/edges/edge_scenes.h"
#include "render/measures.h"
#include "render/shot.h"

namespace swell::render {
namespace {

constexpr int kSunSide_px = 160;
constexpr double kEye_m = 3.0, kSunFov_rad = 0.6;

// Ripples under a sun low in the north, and a box there that is higher than the sun's path.
scene::Scene sea_with_sun_ahead(bool box) {
  scene::Scene scene = plain_scene();
  scene.sea.wind_speed_mps = 5.0;
  scene.water.bump_strength = 1.0;
  scene.sky.sun_azimuth_rad = 0.0;
  scene.sky.sun_elevation_rad = kPi / 12.0;
  scene.sky.sun_direction = {0.0f, 0.9659258f, 0.2588190f};
  if (box) {
    scene.objects = {white_box({0.0, 30.0}, {8.0, 2.0, 5.5})};
    scene.objects[0].colour = glm::vec3(0.02f);
  }
  return scene;
}

// The green light of a picture.
std::vector<float> draw_column_of_sun(const scene::Scene& scene) {
  const View view = north_view(kEye_m, 0.0, kSunFov_rad, kSunSide_px, kSunSide_px);
  return green_light(Shot(world_of(scene), view, 1.0,
                          {.lookup_scale = 1.0, .keep_linear = true, .edge_samples = 0})
                         .target);
}

// The largest of it on the water `far_m` ahead, within 2 m of the middle.
float brightest(const std::vector<float>& green, double far_m) {
  const double px_per_rad = 0.5 * kSunSide_px / std::tan(0.5 * kSunFov_rad);
  const auto y = static_cast<int>(0.5 * kSunSide_px + px_per_rad * kEye_m / far_m);
  const auto half = static_cast<int>(px_per_rad * 2.0 / far_m);
  const auto middle = green.begin() + y * kSunSide_px + kSunSide_px / 2;
  return *std::max_element(middle - half, middle + half + 1);
}

TEST(MirroredSun, IsHiddenByWhatStandsBeforeIt) {
  const std::vector<float> open = draw_column_of_sun(sea_with_sun_ahead(false));
  const std::vector<float> hidden = draw_column_of_sun(sea_with_sun_ahead(true));
  // A ray from the water at far_m meets the box, which is 29 m away and 4.4 m high above the water,
  // kEye_m (29 - far_m) / far_m up.
  for (const double far_m : {16.0, 18.0, 21.0, 24.0}) {
    EXPECT_GT(brightest(open, far_m), 0.5f) << far_m;
    EXPECT_LT(brightest(hidden, far_m), 0.1f) << far_m;  // the sky is 0.08 bright
  }
  // Nearer water looks over the box, whose shadow ends at 12.6 m, and mirrors the whole sun.
  for (const double far_m : {10.0, 11.0}) {
    EXPECT_GT(brightest(hidden, far_m), 0.5f) << far_m;
    EXPECT_EQ(brightest(hidden, far_m), brightest(open, far_m)) << far_m;
  }
}

}  // namespace
}  // namespace swell::render
