// The three-channel maps of texture/packed_map.h: their words, and samples against arithmetic in
// double.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "texture/on_every_target.h"
#include "texture/packed_map.h"
#include "texture/rgba_texels.h"
#include "texture/sample_packets.h"

namespace swell::texture {
namespace {

class RgbSamples : public OnEveryTarget {};
INSTANTIATE_TEST_SUITE_P(Simd, RgbSamples, every_target(), target_name);

// What weights that add up to 1 may be off by, of the range of what they weigh, where coordinates
// are whole 1/256 texels: along x, f / 255 stands for f / 256, up to 1/256 too much; along y,
// f / 256 is exact.
constexpr double kErrorAt256ths = 1.0 / 256.0;
// Other coordinates are rounded to those, up to half a 256th off along each axis.
constexpr double kErrorInPlace = kErrorAt256ths + 2 * 0.5 / 256.0;
// The unit is rounded to float, and 255 * 256 * 128 of it are 0.502; 128 / 255 and the result, in
// [0.5, 1), each by up to 2^-25.
constexpr double kRgbRoundings = 0.502 * 0x1p-24 + 2 * 0x1p-25;

constexpr std::array kRgbSizes = {1, 2, 4, 16, 64, 256};

struct Random {
  explicit Random(int size)
      : image(random_image(size, size, 50 + static_cast<std::uint64_t>(size))),
        map(pack_rgb(image)) {}
  RgbaImage image;
  RgbMap map;
};

// Some lie beyond the map, by up to four texels.
std::vector<float> random_coordinates(int size, std::uint64_t seed) {
  return random_floats(3001, -1024.0, 256.0 * size + 1024.0, seed);
}

// `got` is the bilinear blend at (x, y) [texels] but for an error of the weights, and stays between
// its taps.
void expect_blend(const RgbaImage& image, double x, double y, double weight_error, Sample3 got) {
  x = std::clamp(x, 0.0, image.width - 1.0), y = std::clamp(y, 0.0, image.height - 1.0);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const double fx = x - i, fy = y - j;
  const std::array<float, 3> values = {got.r, got.g, got.b};
  for (int c = 0; c < 3; ++c) {
    const int taps[4] = {channel(image, i, j, c), channel(image, i + 1, j, c),
                         channel(image, i, j + 1, c), channel(image, i + 1, j + 1, c)};
    const double want = ((taps[0] * (1 - fx) + taps[1] * fx) * (1 - fy) +
                         (taps[2] * (1 - fx) + taps[3] * fx) * fy) /
                        255.0;
    const double lowest = *std::min_element(taps, taps + 4) / 255.0;
    const double highest = *std::max_element(taps, taps + 4) / 255.0;
    ASSERT_NEAR(values[c], want, weight_error * (highest - lowest) + kRgbRoundings);
    ASSERT_GE(values[c], lowest - kRgbRoundings);
    ASSERT_LE(values[c], highest + kRgbRoundings);
  }
}

TEST(RgbWords, HoldTheirNeighbourhoodsAndRepeatTheEdges) {
  for (const int size : kRgbSizes) {
    const Random random(size);
    ASSERT_EQ(random.map.size, size);
    ASSERT_EQ(random.map.words.size(), static_cast<std::size_t>(size) * size);
    for (int n = 0; n < size * size; ++n) {
      SCOPED_TRACE(testing::Message() << size << " word " << n);
      const RgbWord& word = random.map.words[n];
      for (int byte = 0; byte < 12; ++byte) {
        const int x = n % size + byte % 2, y = n / size + byte / 2 % 2;
        ASSERT_EQ(word.bytes[byte], channel(random.image, x, y, byte / 4) - 128) << byte;
      }
      for (int byte = 12; byte < 16; ++byte) ASSERT_EQ(word.bytes[byte], 0);
    }
  }
}

// Red 1 to 4 row by row, green 255, blue 0.
TEST(RgbWords, OfFourTexelsAreTheseBytes) {
  RgbaImage image;
  resize_image(2, 2, image);
  for (int n = 0; n < 4; ++n)
    image.texels[n / 2 * image.stride + n % 2] = 0x7f00ff01u + static_cast<std::uint32_t>(n);
  const RgbMap map = pack_rgb(image);
  const RgbWord first = {-127, -126, -125, -124, 127, 127, 127, 127,
                         -128, -128, -128, -128, 0,   0,   0,   0};
  const RgbWord last = {-124, -124, -124, -124, 127, 127, 127, 127,
                        -128, -128, -128, -128, 0,   0,   0,   0};
  EXPECT_EQ(map.words.front(), first);
  EXPECT_EQ(map.words.back(), last);
}

TEST_P(RgbSamples, BlendLikeDoubleArithmeticAndClamp) {
  for (const int size : kRgbSizes) {
    const Random random(size);
    const auto x = random_coordinates(size, 1), y = random_coordinates(size, 2);
    const auto samples = sample_rgb(random.map, x, y);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      SCOPED_TRACE(testing::Message() << size << " at " << x[i] << " " << y[i]);
      expect_blend(random.image, std::nearbyint(x[i]) / 256.0, std::nearbyint(y[i]) / 256.0,
                   kErrorAt256ths, samples[i]);
      expect_blend(random.image, x[i] / 256.0, y[i] / 256.0, kErrorInPlace, samples[i]);
    }
  }
}

TEST_P(RgbSamples, AtTexelPositionsAreTheirTexels) {
  for (const int size : kRgbSizes) {
    const Random random(size);
    std::vector<float> x, y;
    for (int n = 0; n < size * size; ++n) {
      x.push_back(256.0f * static_cast<float>(n % size));
      y.push_back(256.0f * static_cast<float>(n / size));
    }
    const auto samples = sample_rgb(random.map, x, y);
    for (int n = 0; n < size * size; ++n) {
      const auto want = [&](int c) { return channel(random.image, n % size, n / size, c) / 255.0; };
      ASSERT_NEAR(samples[n].r, want(0), kRgbRoundings);
      ASSERT_NEAR(samples[n].g, want(1), kRgbRoundings);
      ASSERT_NEAR(samples[n].b, want(2), kRgbRoundings);
    }
  }
}

// All 65,536 fractions between four texels: red rises along x, green along y, blue is theirs alone.
TEST_P(RgbSamples, RiseMonotonicallyBetweenTexels) {
  RgbaImage image;
  resize_image(2, 2, image);
  for (int n = 0; n < 4; ++n)
    image.texels[n / 2 * image.stride + n % 2] = (n % 2 ? 0xffu : 0u) | (n / 2 ? 0xff00u : 0u);
  const RgbMap map = pack_rgb(image);
  std::vector<float> x, y;
  for (int n = 0; n < 65536; ++n)
    x.push_back(static_cast<float>(n % 256)), y.push_back(static_cast<float>(n / 256));
  const auto samples = sample_rgb(map, x, y);
  for (int n = 0; n < 65536; ++n) {
    ASSERT_NEAR(samples[n].r, n % 256 / 255.0, kRgbRoundings);
    ASSERT_NEAR(samples[n].g, n / 256 / 256.0, kRgbRoundings);
    ASSERT_NEAR(samples[n].b, 0.0, kRgbRoundings);
    ASSERT_TRUE(n % 256 == 0 || samples[n].r > samples[n - 1].r);
    ASSERT_TRUE(n < 256 || samples[n].g > samples[n - 256].g);
  }
}

TEST_P(RgbSamples, StayInTheirRange) {
  for (const std::uint32_t texel : {0u, 0xffffffffu, 0x808080u}) {
    RgbaImage image;
    resize_image(4, 4, image);
    std::ranges::fill(image.texels, texel);
    const float want = static_cast<float>(texel & 0xff) / 255.0f;
    for (const Sample3& s :
         sample_rgb(pack_rgb(image), random_coordinates(4, 3), random_coordinates(4, 4))) {
      ASSERT_NEAR(s.r, want, kRgbRoundings);
      ASSERT_EQ(s.g, s.r);
      ASSERT_EQ(s.b, s.r);
      ASSERT_GE(s.r, 0.0f);
      ASSERT_LE(s.r, 1.0f);
    }
  }
}

// Infinite and huge coordinates are the nearest edge; NaN counts as 0.
TEST_P(RgbSamples, OfNoPlaceInTheMapAreOfItsEdges) {
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (const int size : kRgbSizes) {
    const Random random(size);
    const float last = 256.0f * static_cast<float>(size - 1);
    const std::array<std::array<float, 2>, 9> clamped = {{{kNan, 0.0f},
                                                          {-kNan, 0.0f},
                                                          {-kInfinite, 0.0f},
                                                          {-3e38f, 0.0f},
                                                          {-0.0f, 0.0f},
                                                          {last + 0.25f, last},
                                                          {4e9f, last},
                                                          {3e38f, last},
                                                          {kInfinite, last}}};
    const std::vector<float> other = random_coordinates(size, 5);
    for (std::size_t i = 0; i < other.size(); ++i) {
      const auto& [given, meant] = clamped[i % clamped.size()];
      const std::array<float, 3> x = {given, other[i], other[i]}, y = {other[i], given, other[i]};
      const std::array<float, 3> x_meant = {meant, other[i], other[i]};
      const std::array<float, 3> y_meant = {other[i], meant, other[i]};
      ASSERT_EQ(sample_rgb(random.map, x, y), sample_rgb(random.map, x_meant, y_meant)) << given;
    }
  }
}

TEST_P(RgbSamples, DependOnTheirOwnLanesAlone) {
  const Random random(64);
  const auto x = random_coordinates(64, 6), y = random_coordinates(64, 7);
  const auto together = sample_rgb(random.map, x, y);
  for (std::size_t i = 0; i < x.size(); ++i)
    ASSERT_EQ(sample_rgb(random.map, {&x[i], 1}, {&y[i], 1})[0], together[i]);
}

TEST(RgbSamplesTargets, GiveTheSameBits) {
  if (!simd_target_available(SimdTarget::kAvx512)) GTEST_SKIP() << "this CPU lacks AVX-512";
  for (const int size : kRgbSizes) {
    const Random random(size);
    const auto x = random_coordinates(size, 8), y = random_coordinates(size, 9);
    select_simd_target(simd_targets().front());
    const auto narrow = sample_rgb(random.map, x, y);
    select_simd_target(SimdTarget::kAvx512);
    EXPECT_EQ(sample_rgb(random.map, x, y), narrow);
  }
}

TEST(RgbMapDeathTest, SizesThatAreNoSquareOfAPowerOfTwoAreTheCallersMistake) {
  for (const auto& [width, height] : {std::pair{3, 3}, {2, 4}, {8, 4}, {255, 255}, {257, 257}}) {
    RgbaImage image;
    resize_image(width, height, image);
    EXPECT_DEATH(pack_rgb(image), "size=" + std::to_string(width) + "x" + std::to_string(height));
  }
  EXPECT_DEATH(pack_rgb(RgbaImage{}), "size=0x0");
  RgbaImage large;
  large.width = large.height = 8192;
  EXPECT_DEATH(pack_rgb(large), "size=8192x8192");
}

}  // namespace
}  // namespace swell::texture
