// The far sea as the mean of what a finer picture shows, and how even it stays while the camera
// turns: means over bands of rows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/drawn_shots.h"

namespace swell::render {
namespace {

constexpr int kBand_px = 8;
constexpr glm::ivec2 kSize_px(160, 64);
constexpr double kFov_y_rad = 0.06;  // 960 x 540 pixels of 50 degrees have pixels as large

struct Picture {
  int width_px;
  std::vector<float> linear;
  double green(int x, int y) const {
    return static_cast<double>(linear[3 * static_cast<std::size_t>(y * width_px + x) + 1]);
  }
};

// `times` as many pixels each way. A frame of a sea at one time.
Picture draw(const World& world, glm::dvec3 eye, double heading_rad, double down_rad, int times) {
  FrameOptions options;
  options.keep_linear = true;
  Workers workers(2);
  Workspace workspace;
  Target target;
  const View view = make_view(eye, heading_rad, -down_rad, kFov_y_rad, 0.25f, times * kSize_px.x,
                              times * kSize_px.y);
  render_frame(world, view, 5.0, options, workspace, target, workers);
  return {view.width_px, target.linear};
}

// The picture of as many pixels as kSize_px, each the mean of `times` x `times`.
Picture mean_of(const Picture& fine, int times) {
  Picture mean{kSize_px.x,
               std::vector<float>(3 * static_cast<std::size_t>(kSize_px.x * kSize_px.y))};
  for (int y = 0; y < times * kSize_px.y; ++y)
    for (int x = 0; x < times * kSize_px.x; ++x) {
      const auto to = static_cast<std::size_t>(y / times * kSize_px.x + x / times);
      mean.linear[3 * to + 1] += static_cast<float>(fine.green(x, y) / (times * times));
    }
  return mean;
}

// Light as the display shows it, of 255: linear up to 0.4, then a shoulder (resolve-inl.h), and
// sRGB. Source of the latter: IEC 61966-2-1:1999, 5.2.
double shown(double light) {
  const double x = light <= 0.4 ? light : 1.0 - 0.36 / (light + 0.2);
  return 255.0 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055);
}

double band_mean(const Picture& picture, int band) {
  double sum = 0.0;
  for (int y = band * kBand_px; y < (band + 1) * kBand_px; ++y)
    for (int x = 0; x < kSize_px.x; ++x) sum += picture.green(x, y);
  return sum / (kBand_px * kSize_px.x);
}

scene::Scene sea_of(double wind_mps) {
  scene::Scene scene = load_shipped("open_ocean");
  scene.sea.wind_speed_mps = wind_mps;
  scene.sky.cloud_cover = 0.0;
  return scene;
}

// HOR-04, under the sun a little less.
TEST(Bands, OfFarWaterAreTheMeansOfAFinerPicture) {
  for (const double wind_mps : {5.0, 12.0}) {
    const World world(sea_of(wind_mps));
    for (const double from_sun_rad : {0.0, 1.5, 3.1}) {
      for (const double down_rad : {0.05, 0.15}) {
        const double heading_rad = world.scene().sky.sun_azimuth_rad + from_sun_rad;
        const glm::dvec3 eye(0.0, 0.0, 1500.0);
        const Picture coarse = draw(world, eye, heading_rad, down_rad, 1);
        const Picture fine = mean_of(draw(world, eye, heading_rad, down_rad, 8), 8);
        for (int band = 0; band < kSize_px.y / kBand_px; ++band)
          EXPECT_NEAR(band_mean(coarse, band) / band_mean(fine, band), 1.0,
                      from_sun_rad == 0.0 ? 0.025 : 0.02)
              << wind_mps << " m/s, " << from_sun_rad << " " << down_rad << " band " << band;
        double squares = 0.0;
        for (int y = 0; y < kSize_px.y; ++y)
          for (int x = 0; x < kSize_px.x; ++x)
            squares += std::pow(shown(coarse.green(x, y)) - shown(fine.green(x, y)), 2.0);
        EXPECT_LT(std::sqrt(squares / (kSize_px.x * kSize_px.y)), 3.0);
      }
    }
  }
}

// HOR-04 from lower down, where finer pictures resolve waves that the coarse ones do not: as a
// whole, since the waves that one picture happens to show are few.
TEST(Bands, OfNearWaterAreAsBrightHoweverFineThePicture) {
  for (const double wind_mps : {5.0, 12.0}) {
    const World world(sea_of(wind_mps));
    for (const double eye_m : {10.0, 60.0})
      for (const double from_sun_rad : {0.0, 1.5})
        for (const double down_rad : {0.05, 0.15}) {
          const double heading_rad = world.scene().sky.sun_azimuth_rad + from_sun_rad;
          const glm::dvec3 eye(0.0, 0.0, eye_m);
          const Picture coarse = draw(world, eye, heading_rad, down_rad, 1);
          const Picture fine = mean_of(draw(world, eye, heading_rad, down_rad, 8), 8);
          double ratio = 0.0;
          for (int band = 0; band < kSize_px.y / kBand_px; ++band)
            ratio += band_mean(coarse, band) / band_mean(fine, band) * kBand_px / kSize_px.y;
          EXPECT_NEAR(ratio, 1.0, from_sun_rad == 0.0 ? 0.09 : 0.05)
              << wind_mps << " m/s, " << eye_m << " m, " << from_sun_rad << " " << down_rad;
        }
  }
}

// HOR-05: while the camera turns by a tenth of a pixel a frame.
TEST(Bands, StayAsBrightWhileTheCameraCreeps) {
  const World world(sea_of(12.0));
  for (const glm::dvec2& eye_and_sun :
       {glm::dvec2(2.0, 0.0), {2.0, 3.1}, {10.0, 1.5}, {60.0, 3.1}, {1500.0, 0.0}}) {
    const double eye_m = eye_and_sun.x, from_sun_rad = eye_and_sun.y;
    std::vector<double> before;
    for (int n = 0; n <= 5; ++n) {
      const double turned_rad = 0.1 * n * kFov_y_rad / kSize_px.y;
      const double heading_rad = world.scene().sky.sun_azimuth_rad + from_sun_rad + turned_rad;
      const Picture picture = draw(world, {0.0, 0.0, eye_m}, heading_rad, 0.05, 1);
      for (int band = 0; band < kSize_px.y / kBand_px; ++band) {
        const double now = shown(band_mean(picture, band));
        if (n > 0) {
          EXPECT_NEAR(now, before[band], 0.5)
              << eye_m << " m, band " << band << " frame " << n << " " << from_sun_rad;
          before[band] = now;
        } else {
          before.push_back(now);
        }
      }
    }
  }
}

}  // namespace
}  // namespace swell::render
