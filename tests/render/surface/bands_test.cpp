// The far sea as the mean of what a finer picture shows, and how even it stays while the camera
// turns: means over bands of rows.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "render/shot.h"

namespace swell::render {
namespace {

constexpr int kBand_px = 8;
constexpr glm::ivec2 kBandsSize_px(160, 64);
constexpr int kBands = kBandsSize_px.y / kBand_px;
constexpr double kFov_y_rad = 0.06;  // 960 x 540 pixels of 50 degrees have pixels as large

// The green light of a frame of a sea at one time: of each pixel the mean over `times` x `times`
// pixels that are drawn. The camera looks so far down, and so far right of the sun.
std::vector<float> draw(const World& world, double eye_m, double from_sun_rad, double down_rad,
                        int times = 1, double turned_rad = 0.0) {
  const double heading_rad = world.scene().sky.sun_azimuth_rad + from_sun_rad + turned_rad;
  const View view = make_view({0.0, 0.0, eye_m}, heading_rad, -down_rad, kFov_y_rad, 0.25f,
                              times * kBandsSize_px.x, times * kBandsSize_px.y);
  const Shot shot(world, view, 5.0, {.keep_linear = true});
  std::vector<float> mean(static_cast<std::size_t>(kBandsSize_px.x * kBandsSize_px.y));
  for (int y = 0; y < view.height_px; ++y)
    for (int x = 0; x < view.width_px; ++x)
      mean[static_cast<std::size_t>(y / times * kBandsSize_px.x + x / times)] +=
          static_cast<float>(static_cast<double>(shot.linear(x, y).y) / (times * times));
  return mean;
}

// Light as the display shows it, of 255: linear up to 0.4, then a shoulder (resolve-inl.h), and
// sRGB. Source of the latter: IEC 61966-2-1:1999, 5.2.
double shown(double light) {
  const double x = light <= 0.4 ? light : 1.0 - 0.36 / (light + 0.2);
  return 255.0 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055);
}

double band_mean(const std::vector<float>& picture, int band) {
  const auto first = picture.begin() + band * kBand_px * kBandsSize_px.x;
  return std::accumulate(first, first + kBand_px * kBandsSize_px.x, 0.0) /
         (kBand_px * kBandsSize_px.x);
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
    const World world = world_of(sea_of(wind_mps));
    for (const double from_sun_rad : {0.0, 1.5, 3.1}) {
      for (const double down_rad : {0.05, 0.15}) {
        const std::vector<float> coarse = draw(world, 1500.0, from_sun_rad, down_rad);
        const std::vector<float> fine = draw(world, 1500.0, from_sun_rad, down_rad, 8);
        for (int band = 0; band < kBands; ++band)
          EXPECT_NEAR(band_mean(coarse, band) / band_mean(fine, band), 1.0,
                      from_sun_rad == 0.0 ? 0.025 : 0.02)
              << wind_mps << " m/s, " << from_sun_rad << " " << down_rad << " band " << band;
        double squares = 0.0;
        for (std::size_t i = 0; i < fine.size(); ++i)
          squares += std::pow(shown(coarse[i]) - shown(fine[i]), 2.0);
        EXPECT_LT(std::sqrt(squares / (kBandsSize_px.x * kBandsSize_px.y)), 3.0);
      }
    }
  }
}

// HOR-04 from lower down, where finer pictures resolve waves that the coarse ones do not: as a
// whole, since the waves that one picture happens to show are few.
TEST(Bands, OfNearWaterAreAsBrightHoweverFineThePicture) {
  for (const double wind_mps : {5.0, 12.0}) {
    const World world = world_of(sea_of(wind_mps));
    for (const double eye_m : {10.0, 60.0})
      for (const double from_sun_rad : {0.0, 1.5})
        for (const double down_rad : {0.05, 0.15}) {
          const std::vector<float> coarse = draw(world, eye_m, from_sun_rad, down_rad);
          const std::vector<float> fine = draw(world, eye_m, from_sun_rad, down_rad, 8);
          double ratio = 0.0;
          for (int band = 0; band < kBands; ++band)
            ratio += band_mean(coarse, band) / band_mean(fine, band) * kBand_px / kBandsSize_px.y;
          EXPECT_NEAR(ratio, 1.0, from_sun_rad == 0.0 ? 0.09 : 0.05)
              << wind_mps << " m/s, " << eye_m << " m, " << from_sun_rad << " " << down_rad;
        }
  }
}

// HOR-05: while the camera turns by a tenth of a pixel a frame.
TEST(Bands, StayAsBrightWhileTheCameraCreeps) {
  const World world = world_of(sea_of(12.0));
  for (const auto& [eye_m, from_sun_rad] :
       {std::pair(2.0, 0.0), {2.0, 3.1}, {10.0, 1.5}, {60.0, 3.1}, {1500.0, 0.0}}) {
    std::array<double, kBands> before{};
    for (int n = 0; n <= 5; ++n) {
      const double turned_rad = 0.1 * n * kFov_y_rad / kBandsSize_px.y;
      const std::vector<float> picture = draw(world, eye_m, from_sun_rad, 0.05, 1, turned_rad);
      for (int band = 0; band < kBands; ++band) {
        const double now = shown(band_mean(picture, band));
        if (n > 0) {
          EXPECT_NEAR(now, before[band], 0.5)
              << eye_m << " m, band " << band << " frame " << n << " " << from_sun_rad;
        }
        before[band] = now;
      }
    }
  }
}

}  // namespace
}  // namespace swell::render
