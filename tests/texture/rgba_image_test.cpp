// The four-channel images of texture/packed_map.h.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "texture/on_every_target.h"
#include "texture/packed_map.h"
#include "texture/rgba_texels.h"
#include "texture/sample_packets.h"

namespace swell::texture {
namespace {

using Rgba = OnEveryTarget;
INSTANTIATE_TEST_SUITE_P(Simd, Rgba, every_target(), target_name);

double clamped_fx8(double x, int texels) {
  return std::nearbyint(std::clamp(x - 0.5, 0.0, texels - 1.0) * 256.0) / 256.0;
}

void expect_near_reference(const RgbaImage& image, float x_px, float y_px, Sample4 got) {
  const double x = clamped_fx8(x_px, image.width), y = clamped_fx8(y_px, image.height);
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const double fx = x - i, fy = y - j;
  const float values[4] = {got.r, got.g, got.b, got.a};
  for (int c = 0; c < 4; ++c) {
    const int taps[4] = {channel(image, i, j, c), channel(image, i + 1, j, c),
                         channel(image, i, j + 1, c), channel(image, i + 1, j + 1, c)};
    const double want = ((taps[0] * (1 - fx) + taps[1] * fx) * (1 - fy) +
                         (taps[2] * (1 - fx) + taps[3] * fx) * fy) /
                        255.0;
    const double lowest = *std::min_element(taps, taps + 4) / 255.0;
    const double highest = *std::max_element(taps, taps + 4) / 255.0;
    ASSERT_NEAR(values[c], want, kWeightError * (highest - lowest) + 1e-6) << x_px << " " << y_px;
    ASSERT_GE(values[c], lowest - 1e-7);
    ASSERT_LE(values[c], highest + 1e-7);
  }
}

TEST_P(Rgba, BlendsLikeDoubleArithmeticAndClamps) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {15, 1}, {16, 16}, {97, 31}}) {
    const RgbaImage image = random_image(width, height, 30 + width);
    const auto x = random_floats(3001, -5.0, width + 5.0, 31);
    const auto y = random_floats(3001, -5.0, height + 5.0, 32);
    const auto samples = sample_rgba(image, x, y);
    for (std::size_t i = 0; i < x.size(); ++i) {
      expect_near_reference(image, x[i], y[i], samples[i]);
    }
  }
}

// The four weights [1/255] for the fractions fx / 256, fy / 256 at index 256 fy + fx: the channels
// of an image whose texels each have a channel of their own.
std::vector<std::array<double, 4>> all_weights() {
  RgbaImage image;
  resize_image(2, 2, image);
  for (int n = 0; n < 4; ++n) image.texels[n / 2 * image.stride + n % 2] = 0xffu << (8 * n);
  fill_padding(image);
  std::vector<float> x, y;
  for (int n = 0; n < 65536; ++n) {
    x.push_back(0.5f + static_cast<float>(n % 256) / 256.0f);
    y.push_back(0.5f + static_cast<float>(n / 256) / 256.0f);
  }
  std::vector<std::array<double, 4>> weights;
  for (const Sample4& s : sample_rgba(image, x, y)) {
    weights.push_back({s.r * 255.0, s.g * 255.0, s.b * 255.0, s.a * 255.0});
  }
  return weights;
}

TEST_P(Rgba, WeightsAreWholeAndWithinOneOfExactForAllFractions) {
  const auto weights = all_weights();
  for (int n = 0; n < 65536; ++n) {
    const double x = n % 256 / 256.0, y = n / 256 / 256.0;
    const double exact[4] = {(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y};
    double sum = 0.0, over = 0.0, under = 0.0;
    for (int c = 0; c < 4; ++c) {
      const double weight = std::nearbyint(weights[n][c]), error = weight - 255.0 * exact[c];
      ASSERT_NEAR(weights[n][c], weight, 1e-4);
      ASSERT_GE(weight, 0.0);
      sum += weight;
      (error > 0.0 ? over : under) += error;
    }
    ASSERT_EQ(sum, 255.0);
    ASSERT_LE(over, 1.0) << n % 256 << " " << n / 256;
    ASSERT_NEAR(under, -over, 1e-9);
  }
}

TEST_P(Rgba, WeightsRiseAlongRowsAndRowsRiseDownwards) {
  const auto weights = all_weights();
  int steps_back = 0;
  for (int n = 0; n < 65536; ++n) {
    if (n % 256 > 0) {
      ASSERT_GE(weights[n][1], weights[n - 1][1]);
      ASSERT_GE(weights[n][3], weights[n - 1][3]);
      ASSERT_LE(weights[n][0], weights[n - 1][0]);
      ASSERT_LE(weights[n][2], weights[n - 1][2]);
    }
    if (n < 256) continue;
    const auto& above = weights[n - 256];
    ASSERT_GE(weights[n][2] + weights[n][3], above[2] + above[3] - 1e-4);
    for (int c = 0; c < 4; ++c) {
      const double rise = c < 2 ? above[c] - weights[n][c] : weights[n][c] - above[c];
      ASSERT_GE(rise, -1.0001);
      if (rise < -0.5) ++steps_back;
    }
  }
  EXPECT_LE(steps_back, 169);  // of 4 * 65,280
}

TEST_P(Rgba, TexelCentresGiveTheirTexels) {
  const RgbaImage image = random_image(21, 13, 33);
  std::vector<float> x, y;
  for (int n = 0; n < 21 * 13; ++n) {
    x.push_back(static_cast<float>(n % 21) + 0.5f);
    y.push_back(static_cast<float>(n / 21) + 0.5f);
  }
  const auto samples = sample_rgba(image, x, y);
  for (int n = 0; n < 21 * 13; ++n) {
    const auto want = [&](int c) {
      return static_cast<float>(channel(image, n % 21, n / 21, c)) / 255;
    };
    ASSERT_FLOAT_EQ(samples[n].r, want(0));
    ASSERT_FLOAT_EQ(samples[n].g, want(1));
    ASSERT_FLOAT_EQ(samples[n].b, want(2));
    ASSERT_FLOAT_EQ(samples[n].a, want(3));
  }
}

TEST_P(Rgba, ConstantImageIsConstantEverywhere) {
  for (const std::uint32_t colour : {0u, 0xffffffffu, 0x80ff017fu}) {
    RgbaImage image;
    resize_image(40, 30, image);
    std::fill(image.texels.begin(), image.texels.end(), colour);
    const auto x = random_floats(1000, -1e6, 1e6, 34), y = random_floats(1000, 0.0, 30.0, 35);
    const auto samples = sample_rgba(image, x, y);
    for (const Sample4& sample : samples) ASSERT_EQ(sample, samples[0]);
    EXPECT_FLOAT_EQ(samples[0].r, static_cast<float>(colour & 0xff) / 255);
    EXPECT_FLOAT_EQ(samples[0].a, static_cast<float>(colour >> 24) / 255);
    EXPECT_LE(samples[0].a, 1.0f);
  }
}

TEST_P(Rgba, StrangeCoordinatesStayInsideTheImage) {
  const float inf = std::numeric_limits<float>::infinity(), nan = std::nanf("");
  const RgbaImage image = random_image(16, 16, 36);
  const auto at = [&](float x, float y) {
    return sample_rgba(image, std::vector{x}, std::vector{y})[0];
  };
  EXPECT_EQ(at(nan, nan), at(0.5f, 0.5f));
  EXPECT_EQ(at(-nan, 3.0f), at(0.5f, 3.0f));
  EXPECT_EQ(at(-inf, -3e38f), at(0.5f, 0.5f));
  EXPECT_EQ(at(inf, 3e38f), at(15.5f, 15.5f));
}

TEST_P(Rgba, LargestImageKeepsSubTexels) {
  RgbaImage image;
  resize_image(16384, 2, image);
  for (int x = 0; x < 16384; ++x) image.texels[x] = x % 2 == 0 ? 0u : 0xffu;
  fill_padding(image);
  const auto samples = sample_rgba(image, std::vector{16382.5f, 16382.75f, 16383.25f, 16383.5f},
                                   std::vector<float>(4, 0.5f));
  EXPECT_EQ(samples[0].r, 0.0f);
  EXPECT_NEAR(samples[1].r, 0.25f, kWeightError);
  EXPECT_NEAR(samples[2].r, 0.75f, kWeightError);
  EXPECT_FLOAT_EQ(samples[3].r, 1.0f);
}

TEST(RgbaTargets, GiveTheSameBits) {
  if (!simd_target_available(SimdTarget::kAvx512)) GTEST_SKIP() << "this CPU lacks AVX-512";
  for (const int size : {1, 2, 4, 8, 16, 64, 256}) {
    const RgbaImage image = random_image(size, size, 43);
    const auto x = random_floats(4099, -9.0, 9.0, 41), y = random_floats(4099, -9.0, 9.0, 42);
    select_simd_target(simd_targets().front());
    const auto narrow = sample_rgba(image, x, y);
    select_simd_target(SimdTarget::kAvx512);
    EXPECT_EQ(sample_rgba(image, x, y), narrow);
  }
}

// ---- Softer levels

RgbaImage random_soft_image(int width, int height, BlurAxis axis = BlurAxis::kY) {
  RgbaImage image;
  resize_image(width, height, image, kMostRgbaLevels, axis);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.texels[static_cast<std::size_t>(y) * image.stride + x] =
          static_cast<std::uint32_t>(random_bits(8, y * width + x));
  soften_block(0, 0, width, height, image);
  fill_padding(image);
  return image;
}

// A level as an image of its own.
RgbaImage level_of(const RgbaImage& image, std::size_t level) {
  RgbaImage alone;
  resize_image(static_cast<int>(image.last_x[level]) + 1, static_cast<int>(image.last_y[level]) + 1,
               alone);
  for (int y = 0; y < alone.height; ++y)
    for (int x = 0; x < alone.width; ++x)
      alone.texels[static_cast<std::size_t>(y) * alone.stride + x] =
          image.texels[static_cast<std::size_t>(image.level_begin[level] +
                                                y * image.level_stride[level] + x)];
  fill_padding(alone);
  return alone;
}

TEST(RgbaLevels, TexelsAreTheMeansOfTheirBlocks) {
  for (const auto& [width, height] : {std::pair{1, 1}, {16, 32}, {97, 31}}) {
    const RgbaImage image = random_soft_image(width, height);
    for (std::size_t level = 1; level < kMostRgbaLevels; ++level) {
      const RgbaImage soft = level_of(image, level), finer = level_of(image, level - 1);
      const int step_x = level == 1 ? 1 : 2;
      ASSERT_EQ(soft.width, (finer.width + step_x - 1) / step_x);
      ASSERT_EQ(soft.height, (finer.height + 1) / 2);
      for (int y = 0; y < soft.height; ++y)
        for (int x = 0; x < soft.width; ++x)
          for (int c = 0; c < 4; ++c) {
            const int x2 = x * step_x + step_x - 1;
            const int sum = channel(finer, x * step_x, 2 * y, c) + channel(finer, x2, 2 * y, c) +
                            channel(finer, x * step_x, 2 * y + 1, c) +
                            channel(finer, x2, 2 * y + 1, c);
            ASSERT_EQ(channel(soft, x, y, c), (sum + 2) / 4) << level << ' ' << x << ' ' << y;
          }
    }
  }
}

// An image on its side has the levels on their side.
TEST(RgbaLevels, BlurAlongTheAxisTheyAreMadeFor) {
  for (const auto& [width, height] : {std::pair{1, 1}, {16, 32}, {97, 31}}) {
    const RgbaImage upright = random_soft_image(width, height);
    RgbaImage side;
    resize_image(height, width, side, kMostRgbaLevels, BlurAxis::kX);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        side.texels[static_cast<std::size_t>(x) * side.stride + y] =
            upright.texels[static_cast<std::size_t>(y) * upright.stride + x];
    soften_block(0, 0, height, width, side);
    for (std::size_t level = 0; level < kMostRgbaLevels; ++level) {
      const RgbaImage a = level_of(upright, level), b = level_of(side, level);
      ASSERT_EQ(a.width, b.height);
      ASSERT_EQ(a.height, b.width);
      for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
          for (int c = 0; c < 4; ++c) ASSERT_EQ(channel(a, x, y, c), channel(b, y, x, c));
    }
  }
}

TEST(RgbaLevels, AreTheSameBlockByBlock) {
  const RgbaImage whole = random_soft_image(97, 45);
  RgbaImage parts = whole;
  for (int level = 1; level < kMostRgbaLevels; ++level)
    std::fill(parts.texels.begin() + parts.level_begin[static_cast<std::size_t>(level)],
              parts.texels.end(), 0u);
  for (int y = 0; y < 45; y += 16)
    for (int x = 0; x < 97; x += 16)
      soften_block(x, y, std::min(x + 16, 97), std::min(y + 16, 45), parts);
  fill_padding(parts);
  EXPECT_EQ(parts.texels, whole.texels);
}

// Neighbours in a packet lie on different levels.
TEST_P(Rgba, ALevelIsSampledAsAnImageOfItsOwn) {
  const RgbaImage image = random_soft_image(97, 45);
  const auto x = random_floats(3000, -5.0, 102.0, 41), y = random_floats(3000, -5.0, 50.0, 42);
  std::vector<int> levels;
  for (std::size_t i = 0; i < x.size(); ++i) levels.push_back(static_cast<int>(i) % 5);
  const auto got = sample_rgba_level(image, x, y, levels);
  for (std::size_t level = 0; level < kMostRgbaLevels; ++level) {
    std::vector<float> x_level(x), y_level(y);
    for (float& v : x_level) v *= level == 0 ? 1.0f : std::ldexp(2.0f, -static_cast<int>(level));
    for (float& v : y_level) v *= std::ldexp(1.0f, -static_cast<int>(level));
    const auto expected = sample_rgba(level_of(image, level), x_level, y_level);
    for (std::size_t i = level; i < x.size(); i += 5) ASSERT_EQ(got[i], expected[i]) << i;
  }
}

}  // namespace
}  // namespace swell::texture
