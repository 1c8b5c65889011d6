#include "texture/normal_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/random.h"

namespace swell::texture {
namespace {

ImageF image_of(int width, int height, const std::vector<float>& heights) {
  return {width, height, 1, heights};
}

TEST(Slopes, AreTheDifferencesOfTheTangents) {
  // 3 x 2 heights: 0 1 4 / 9 16 25.
  const ImageF heights = image_of(3, 2, {0, 1, 4, 9, 16, 25});
  std::vector<float> x(6), y(6);
  compute_slopes(heights, Edges::kClamped, 1.0f, x, y);
  EXPECT_EQ(x, (std::vector<float>{1, 4, 3, 7, 16, 9}));
  EXPECT_EQ(y, (std::vector<float>{9, 15, 21, 9, 15, 21}));
  compute_slopes(heights, Edges::kPeriodic, 2.0f, x, y);
  EXPECT_EQ(x, (std::vector<float>{-6, 8, -2, -18, 32, -14}));
  EXPECT_EQ(y, (std::vector<float>(6, 0.0f)));
}

TEST(Slopes, OnePixelIsFlat) {
  const ImageF heights = image_of(1, 1, {5.0f});
  std::vector<float> x(1, 9.0f), y(1, 9.0f);
  for (const Edges edges : {Edges::kPeriodic, Edges::kClamped}) {
    compute_slopes(heights, edges, 1.0f, x, y);
    EXPECT_EQ(x[0], 0.0f);
    EXPECT_EQ(y[0], 0.0f);
  }
}

TEST(NormalMap, FlatHeightsPointUp) {
  const Image8 map = make_normal_map(image_of(2, 2, {3, 3, 3, 3}), Edges::kPeriodic, 1.0f);
  EXPECT_EQ(map.channels, 3);
  for (int n = 0; n < 4; ++n) {
    EXPECT_EQ(map.pixels[3 * n], 128);  // 127.5 to even
    EXPECT_EQ(map.pixels[3 * n + 1], 128);
    EXPECT_EQ(map.pixels[3 * n + 2], 255);
  }
}

TEST(NormalMap, IsTheCrossProductOfTheTangentsInEightBits) {
  std::vector<float> heights(16 * 8);
  for (std::size_t n = 0; n < heights.size(); ++n) {
    heights[n] = static_cast<float>(random_uniform(1, n) * 3);
  }
  const Image8 map = make_normal_map(image_of(16, 8, heights), Edges::kPeriodic, 0.5f);
  const auto height = [&](int x, int y) {
    return double{heights[(y + 8) % 8 * 16 + (x + 16) % 16]};
  };
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      const double t1[3] = {1, 0, 0.5 * (height(x + 1, y) - height(x - 1, y))};
      const double t2[3] = {0, 1, 0.5 * (height(x, y + 1) - height(x, y - 1))};
      double n[3] = {t1[1] * t2[2] - t1[2] * t2[1], t1[2] * t2[0] - t1[0] * t2[2],
                     t1[0] * t2[1] - t1[1] * t2[0]};
      const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
      for (int c = 0; c < 3; ++c) {
        ASSERT_NEAR(map.pixels[3 * (y * 16 + x) + c], 127.5 * (n[c] / length + 1), 0.501);
      }
    }
  }
}

TEST(BumpSlopes, HaveUnitSteepnessAndNoMean) {
  for (const int size : {32, 128, 256}) {
    const SlopeMap map = make_bump_slopes(size, 5);
    ASSERT_EQ(map.x.size(), static_cast<std::size_t>(size) * size);
    double squares = 0.0, mean_x = 0.0, mean_y = 0.0;
    for (std::size_t n = 0; n < map.x.size(); ++n) {
      squares += map.x[n] * map.x[n] + map.y[n] * map.y[n];
      mean_x += map.x[n];
      mean_y += map.y[n];
    }
    const double count = static_cast<double>(map.x.size());
    EXPECT_NEAR(squares / count, 1.0, 1e-5);
    EXPECT_NEAR(mean_x / count, 0.0, 1e-5);
    EXPECT_NEAR(mean_y / count, 0.0, 1e-5);
  }
}

TEST(BumpSlopes, PreferNoDirection) {
  const SlopeMap map = make_bump_slopes(256, 6);
  // Mean square slope along each of eight directions.
  for (int direction = 0; direction < 8; ++direction) {
    const double angle = direction * 3.14159265358979 / 8;
    double squares = 0.0;
    for (std::size_t n = 0; n < map.x.size(); ++n) {
      const double slope = map.x[n] * std::cos(angle) + map.y[n] * std::sin(angle);
      squares += slope * slope;
    }
    EXPECT_NEAR(squares / static_cast<double>(map.x.size()), 0.5, 0.1) << direction;
  }
}

TEST(BumpSlopes, TileWithoutASeam) {
  const int size = 128;
  const SlopeMap map = make_bump_slopes(size, 7);
  double inside = 0.0, across = 0.0;
  for (int y = 0; y < size; ++y) {
    const float* const row = map.x.data() + y * size;
    across = std::max(across, double{std::abs(row[0] - row[size - 1])});
    for (int x = 1; x < size; ++x) inside = std::max(inside, double{std::abs(row[x] - row[x - 1])});
  }
  for (int x = 0; x < size; ++x) {
    across = std::max(across, double{std::abs(map.y[x] - map.y[(size - 1) * size + x])});
  }
  EXPECT_LE(across, 1.05 * inside);
  EXPECT_LT(inside, 2.0);  // smooth: slopes of size 1 do not jump from texel to texel
}

TEST(BumpSlopes, SeedsDifferAndRepeat) {
  EXPECT_EQ(make_bump_slopes(64, 1).x, make_bump_slopes(64, 1).x);
  EXPECT_NE(make_bump_slopes(64, 1).x, make_bump_slopes(64, 2).x);
}

}  // namespace
}  // namespace swell::texture
