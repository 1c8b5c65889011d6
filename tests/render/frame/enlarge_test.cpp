// Enlarging against bilinear interpolation in double.
#include "render/picture/enlarge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "math/random.h"

namespace swell::render {
namespace {

std::vector<std::uint32_t> random_picture(PictureExtent extent) {
  std::vector<std::uint32_t> picture;
  for (int i = 0; i < extent.width_px * extent.height_px; ++i)
    picture.push_back(static_cast<std::uint32_t>(random_uniform(3, i) * 0x1p32));
  return picture;
}

std::vector<std::uint32_t> enlarged(const std::vector<std::uint32_t>& small, PictureExtent from,
                                    PictureExtent to, int threads = 2) {
  std::vector<std::uint32_t> large(static_cast<std::size_t>(to.width_px) * to.height_px);
  EnlargeTables tables;
  Workers workers(threads);
  enlarge(small, from, large, to, tables, workers);
  return large;
}

// Byte `channel` at the centre of pixel (x, y) of the large picture.
double bilinear(const std::vector<std::uint32_t>& small, PictureExtent from, PictureExtent to,
                int x, int y, int channel) {
  const double u =
      std::clamp((x + 0.5) * from.width_px / to.width_px - 0.5, 0.0, from.width_px - 1.0);
  const double v =
      std::clamp((y + 0.5) * from.height_px / to.height_px - 0.5, 0.0, from.height_px - 1.0);
  const auto byte = [&](double i, double j) {
    const auto column = static_cast<std::size_t>(std::min(i, from.width_px - 1.0));
    const auto row = static_cast<std::size_t>(std::min(j, from.height_px - 1.0));
    return small[row * from.width_px + column] >> (8 * channel) & 255u;
  };
  const double i = std::floor(u), j = std::floor(v), s = u - i, t = v - j;
  return (1 - t) * ((1 - s) * byte(i, j) + s * byte(i + 1, j)) +
         t * ((1 - s) * byte(i, j + 1) + s * byte(i + 1, j + 1));
}

TEST(Enlarge, InterpolatesBetweenPixelCentres) {
  const PictureExtent from{37, 23}, to{50, 31};
  const auto small = random_picture(from), large = enlarged(small, from, to);
  for (int y = 0; y < to.height_px; ++y)
    for (int x = 0; x < to.width_px; ++x)
      for (int c = 0; c < 4; ++c)  // weights of 8 bits: 255 / 256 each way, and two roundings
        ASSERT_NEAR(large[static_cast<std::size_t>(y * to.width_px + x)] >> (8 * c) & 255u,
                    bilinear(small, from, to, x, y, c), 3.0)
            << x << " " << y << " " << c;
}

TEST(Enlarge, KeepsAConstantAndThePictureOfTheSameSize) {
  const PictureExtent from{31, 9}, to{64, 18};
  for (const std::uint32_t colour : {0u, 0xffffffffu, 0xff80017fu}) {
    const std::vector<std::uint32_t> small(31 * 9, colour);
    for (const std::uint32_t p : enlarged(small, from, to)) ASSERT_EQ(p, colour);
  }
  const auto picture = random_picture(from);
  EXPECT_EQ(enlarged(picture, from, from), picture);
}

TEST(Enlarge, ThreadsChangeNothingAndOnePixelFillsAll) {
  const PictureExtent from{100, 70}, to{131, 97};
  const auto small = random_picture(from);
  EXPECT_EQ(enlarged(small, from, to, 1), enlarged(small, from, to, 3));
  for (const std::uint32_t p : enlarged({0xff123456u}, {1, 1}, {5, 3})) ASSERT_EQ(p, 0xff123456u);
}

}  // namespace
}  // namespace swell::render
