// HFR-04. What rays over heights take grows with the pixels, and hardly with the map. Of rays that
// begin at the eye: beams before them save the more, the fewer posts and the more pixels there are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <vector>

#include "apps/bench/ray_picture.h"

namespace swell::apps {
namespace {

// A picture of a map, and the least time that it has taken one core.
struct Timed {
  const terrain::HeightPyramid& map;
  RayPicture picture;
  double least_ms = 1e9;
};

double cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

// By turns, so that a slow moment of the machine slows all of them.
void time_all(std::vector<Timed>& all) {
  Workers workers(1);
  for (int n = 0; n < 9; ++n)
    for (Timed& timed : all) {
      const double before = cpu_ms();
      cast_picture(timed.map, timed.picture, workers);
      timed.least_ms = std::min(timed.least_ms, cpu_ms() - before);
    }
}

// The exponent k of time ~ pixels^k that lies nearest to all of the pictures, in logarithms.
double exponent(const std::vector<Timed>& all) {
  double x_sum = 0, y_sum = 0, xx_sum = 0, xy_sum = 0;
  for (const Timed& timed : all) {
    const double x = std::log(double(timed.picture.width_px) * timed.picture.height_px);
    const double y = std::log(timed.least_ms);
    x_sum += x, y_sum += y, xx_sum += x * x, xy_sum += x * y;
  }
  const auto n = double(all.size());
  return (n * xy_sum - x_sum * y_sum) / (n * xx_sum - x_sum * x_sum);
}

// Over nine times the pixels an exponent of 0.1 too much is a quarter more time. Of all four
// pictures at once, as one of them alone may be timed badly on a busy machine; least times are kept
// while it is.
TEST(RayTime, IsLinearInThePixels) {
  Workers workers(2);
  const terrain::HeightPyramid map = make_hills(1024, workers);
  for (const double pitch_deg : {45.0, 10.0, 2.0}) {
    std::vector<Timed> all;
    for (const int height_px : {180, 270, 360, 540})
      all.push_back({map, {height_px * 16 / 9, height_px, pitch_deg, false}});
    for (int n = 0; n == 0 || (n < 4 && std::abs(exponent(all) - 1.0) > 0.1); ++n) time_all(all);
    EXPECT_NEAR(exponent(all), 1.0, 0.1) << pitch_deg << " degrees";
  }
}

TEST(RayTime, IsAtMostHalfAsMuchAgainOverAMapOfFourTimesTheSide) {
  Workers workers(2);
  const terrain::HeightPyramid small = make_hills(1024, workers), large = make_hills(4096, workers);
  for (const double pitch_deg : {45.0, 10.0, 2.0}) {
    const RayPicture picture{640, 360, pitch_deg, false};
    std::vector<Timed> both = {{small, picture}, {large, picture}};
    time_all(both);
    EXPECT_LE(both[1].least_ms, 1.5 * both[0].least_ms) << pitch_deg << " degrees";
  }
}

}  // namespace
}  // namespace swell::apps
