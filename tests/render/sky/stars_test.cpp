// Stars and the moon in pictures of the night.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/linear_renderer.h"
#include "sky/celestial.h"

namespace swell::render {
namespace {

scene::Scene night(double moon_elevation_deg, double moon_phase) {
  scene::Scene scene;
  scene.sky.cloud_cover = 0.0;
  scene.sky.sun_elevation_rad = radians(-30.0);
  scene.sky.sun_direction = {0.0f, 0.8660254f, -0.5f};
  scene.sky.moon_azimuth_rad = radians(120.0);
  scene.sky.moon_elevation_rad = radians(moon_elevation_deg);
  scene.sky.moon_phase = moon_phase;
  scene.sea.wind_speed_mps = 0.0;
  return scene;
}

View upward(double heading_deg, double pitch_deg, double fov_deg, int side_px) {
  const scene::Camera camera = {.eye_m = {0, 0, 2},
                                .heading_rad = radians(heading_deg),
                                .pitch_rad = radians(pitch_deg),
                                .fov_y_rad = radians(fov_deg)};
  return scene::camera_view(camera, 0.0, side_px, side_px);
}

double light_of(const LinearRenderer& drawn) {
  double sum = 0.0;
  for (const float x : drawn.target.linear) sum += x;
  return sum;
}

TEST(StarsInPictures, CanBeLeftOut) {
  LinearRenderer drawn(night(-40.0, 1.0));
  const View view = upward(0.0, 60.0, 40.0, 128);
  drawn.draw_view(view, 0.0);
  const auto brightest = [&] { return std::ranges::max(drawn.target.linear); };
  const float with = brightest();
  drawn.options.without = {Part::kStars};
  drawn.draw_view(view, 0.0);
  EXPECT_GT(with, 5.0f * brightest());
}

TEST(StarsInPictures, NoneByDay) {
  scene::Scene day;
  day.sky.cloud_cover = 0.0;
  LinearRenderer drawn(day);
  const View view = upward(0.0, 60.0, 40.0, 64);
  drawn.draw_view(view, 0.0);
  const auto with = drawn.target.rgba;
  drawn.options.without = {Part::kStars};
  drawn.draw_view(view, 0.0);
  EXPECT_EQ(with, drawn.target.rgba);
}

// Finer pixels share the same light: four times as many of them, each as bright in the mean.
TEST(StarsInPictures, AsBrightHoweverFineThePicture) {
  LinearRenderer drawn(night(-40.0, 1.0)), bare(night(-40.0, 1.0));
  bare.options.without = {Part::kStars};
  const auto of_stars = [&](int side_px) {
    const View view = upward(0.0, 60.0, 40.0, side_px);
    drawn.draw_view(view, 0.0);
    bare.draw_view(view, 0.0);
    return (light_of(drawn) - light_of(bare)) / (side_px * side_px);
  };
  const double coarse = of_stars(256), fine = of_stars(512);
  EXPECT_GT(coarse, 0.0);
  EXPECT_NEAR(fine / coarse, 1.0, 0.03);
}

// A quarter of an hour turns the stars by 3.76 degrees about the pole.
TEST(StarsInPictures, TurnWithTime) {
  LinearRenderer drawn(night(-40.0, 1.0));
  const View view = upward(180.0, 45.0, 30.0, 96);
  drawn.draw_view(view, 0.0);
  const auto now = drawn.target.rgba;
  drawn.draw_view(view, 900.0);
  EXPECT_NE(now, drawn.target.rgba);
  // A sidereal day later they are back.
  drawn.draw_view(view, 86164.0905);
  float most = 0.0f;
  for (std::size_t i = 0; i < now.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const int a = static_cast<int>(now[i] >> (8 * c) & 255);
      const int b = static_cast<int>(drawn.target.rgba[i] >> (8 * c) & 255);
      most = std::max(most, static_cast<float>(std::abs(a - b)));
    }
  EXPECT_LE(most, 8.0f);
}

// Half a disc of a half moon, on the side of the sun.
TEST(MoonInPictures, ShowsItsPhase) {
  const auto lit = [](double phase, int& left, int& right) {
    LinearRenderer drawn(night(25.0, phase));
    drawn.options.without = {Part::kStars};
    drawn.draw_view(upward(120.0, 25.0, 1.0, 100), 0.0);
    const float most = std::ranges::max(drawn.target.linear);
    left = right = 0;
    for (int y = 0; y < 100; ++y)
      for (int x = 0; x < 100; ++x)
        if (drawn.linear(x, y).y > 0.3f * most) ++(x < 50 ? left : right);
  };
  int full_left, full_right, half_left, half_right;
  lit(1.0, full_left, full_right);
  lit(0.5, half_left, half_right);
  EXPECT_NEAR(full_left + full_right, 2234, 120);  // pi (0.2667 degrees)^2 of 100 pixels a degree
  EXPECT_NEAR(half_left + half_right, 0.5 * (full_left + full_right), 100.0);
  // The sun is down in the north, to the left of the moon in the south-east.
  EXPECT_GT(half_left, 2 * half_right);
}

// Where the moon is down there is starlight alone.
TEST(MoonInPictures, IsDarkWhenItIsDown) {
  scene::Scene lit = night(40.0, 1.0), dark = night(-5.0, 1.0);
  lit.sky.exposure = dark.sky.exposure = 1e5;
  LinearRenderer up(lit), down(dark);
  for (LinearRenderer* const drawn : {&up, &down}) {
    drawn->options.without = {Part::kStars};
    drawn->draw_view(upward(200.0, 40.0, 40.0, 32), 0.0);
  }
  EXPECT_LT(light_of(down), 0.1 * light_of(up));
  EXPECT_GT(light_of(down), 0.0);
}

}  // namespace
}  // namespace swell::render
