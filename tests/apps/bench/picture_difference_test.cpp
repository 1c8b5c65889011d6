// How far two pictures differ, by hand.
#include "apps/bench/picture_difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace swell::apps {
namespace {

using Pixels = std::vector<std::uint32_t>;

TEST(PictureDifference, OfAPictureWithItselfIsNone) {
  const Pixels picture = {0xff112233u, 0xff000000u};
  const PictureDifference d = picture_difference(picture, picture);
  EXPECT_EQ(d.mean, 0.0);
  EXPECT_EQ(d.p99, 0);
  EXPECT_EQ(d.max, 0);
  EXPECT_EQ(d.psnr_db, 99.0);
}

// Two pixels, six values: one differs by 3, one by 1.
TEST(PictureDifference, CountsEachColourOfEachPixel) {
  const Pixels a = {0xff000010u, 0xff200000u}, b = {0xff000013u, 0xff1f0000u};
  const PictureDifference d = picture_difference(a, b);
  EXPECT_DOUBLE_EQ(d.mean, 4.0 / 6.0);
  EXPECT_EQ(d.p99, 3);
  EXPECT_EQ(d.max, 3);
  EXPECT_NEAR(d.psnr_db, 10.0 * std::log10(255.0 * 255.0 / (10.0 / 6.0)), 1e-9);
}

// Two of 300 values differ: less than a hundredth.
TEST(PictureDifference, ThePercentileLeavesOutTheRarest) {
  Pixels a(100, 0xff000000u), b = a;
  b[7] = 0xff0000c8u;
  b[9] = 0xff0000c8u;
  const PictureDifference d = picture_difference(a, b);
  EXPECT_EQ(d.p99, 0);
  EXPECT_EQ(d.max, 200);
}

TEST(PictureDifference, ThePictureOfItIsEnlargedAndCut) {
  const Pixels a = {0xff000010u, 0xff200000u, 0xff0000ffu}, b = {0xff000013u, 0xff1f0000u, 0u};
  EXPECT_EQ(difference_picture(a, b, 8), (Pixels{0xff000018u, 0xff080000u, 0xff0000ffu}));
}

}  // namespace
}  // namespace swell::apps
