// From linear light to the picture's bytes: sRGB, the tone curve, the dither.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "render/shaders/shader_kernels.h"
#include "texture/on_every_target.h"

namespace swell::render {
namespace {

class PictureBytes : public texture::OnEveryTarget {};
INSTANTIATE_TEST_SUITE_P(Targets, PictureBytes, texture::every_target(), texture::target_name);

constexpr double kSrgbError = 0.09;  // what EncodeSrgb states, of 255

// Source: IEC 61966-2-1:1999, 5.2.
double srgb(double x) {
  return 255.0 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055);
}

// Linear up to 0.4, then a hyperbola with the same slope there that reaches 1 at infinity.
double tone(double x) { return x <= 0.4 ? x : 1.0 - 0.36 / (x + 0.2); }

std::vector<float> steps(double first, double last, int count) {
  std::vector<float> x;
  for (int i = 0; i < count; ++i)
    x.push_back(static_cast<float>(first + (last - first) * i / (count - 1)));
  return x;
}

std::vector<float> encoded(const std::vector<float>& linear) {
  std::vector<float> code(linear.size());
  encode_srgb(linear, code);
  return code;
}

std::vector<int> bytes(const std::vector<float>& linear, float exposure, float dither) {
  std::vector<int> byte(linear.size());
  to_byte(linear, exposure, std::vector<float>(linear.size(), dither), byte);
  return byte;
}

TEST_P(PictureBytes, AreTheSrgbCurveToTheErrorStated) {
  std::vector<float> x = steps(0.0, 1.0, 300001);
  for (int i = 0; i < 2000; ++i) x.push_back(std::exp2(-static_cast<float>(i) / 60.0f));
  const std::vector<float> code = encoded(x);
  double worst = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    ASSERT_NEAR(code[i], srgb(x[i]), kSrgbError) << x[i];
    worst = std::max(worst, std::abs(code[i] - srgb(x[i])));
  }
  EXPECT_GT(worst, 0.07);  // the error stated is not too large
}

// From 0.0031308 down the curve is a line, and exact.
TEST_P(PictureBytes, AreExactInTheDark) {
  const std::vector<float> x = steps(0.0, 0.0031, 500), code = encoded(x);
  for (std::size_t i = 0; i < x.size(); ++i) ASSERT_NEAR(code[i], 255.0 * 12.92 * x[i], 2e-6);
}

TEST_P(PictureBytes, RiseWithTheLight) {
  std::vector<float> x = steps(0.0, 1.2, 100001);
  for (int i = 0; i <= 4000; ++i) x.push_back(1.2f * std::exp2(static_cast<float>(i) / 100.0f));
  for (const float dither : {0.0f, 0.37f, 0.99f})
    EXPECT_TRUE(std::ranges::is_sorted(bytes(x, 1.0f, dither))) << dither;
  // The curve itself steps down where its line meets its polynomial, by less than its error.
  const std::vector<float> code = encoded(steps(0.0, 1.0, 100001));
  double fall = 0.0;
  for (std::size_t i = 1; i < code.size(); ++i)
    fall = std::max(fall, static_cast<double>(code[i - 1] - code[i]));
  EXPECT_LT(fall, kSrgbError);
}

// A dither of d gives the whole part of the code plus d.
TEST_P(PictureBytes, AreTheToneCurveOfTheExposedLight) {
  const std::vector<float> x = steps(0.0, 12.0, 60001);
  for (const float exposure : {0.5f, 1.0f, 3.0f}) {
    for (const float dither : {0.0f, 0.5f, 0.9f}) {
      const std::vector<int> byte = bytes(x, exposure, dither);
      for (std::size_t i = 0; i < x.size(); ++i) {
        const double code = srgb(tone(static_cast<double>(exposure) * x[i])) + dither;
        ASSERT_GE(byte[i], std::min(255.0, std::floor(code - kSrgbError))) << x[i];
        ASSERT_LE(byte[i], std::min(255.0, std::floor(code + kSrgbError))) << x[i];
      }
    }
  }
}

TEST_P(PictureBytes, AreThoseOfTheLightItselfUpToTheShoulder) {
  const std::vector<float> x = steps(0.0, 0.4, 5001);
  const std::vector<int> byte = bytes(x, 1.0f, 0.0f);
  const std::vector<float> code = encoded(x);
  for (std::size_t i = 0; i < x.size(); ++i)
    ASSERT_EQ(byte[i], static_cast<int>(std::max(code[i], 0.0f))) << x[i];
}

TEST_P(PictureBytes, ShowNoLightAndLessAsBlack) {
  EXPECT_EQ(bytes({0.0f, -0.0f, -1e-9f, -5.0f}, 1.0f, 0.99f), (std::vector<int>{0, 0, 0, 0}));
}

// The tone curve reaches white at infinity only. The code's error of 0.083 at 1 makes that 255
// comes early, without dither from light 500 on (0.9993 after the curve); the exact curve would
// never show it.
TEST_P(PictureBytes, ReachWhiteInVeryBrightLightOnly) {
  EXPECT_NEAR(encoded({1.0f})[0], 255.0826, 1e-3);
  EXPECT_EQ(bytes({400.0f, 494.0f, 508.0f, 1e6f, 1e30f}, 1.0f, 0.0f),
            (std::vector<int>{254, 254, 255, 255, 255}));
  EXPECT_EQ(bytes({1e30f}, 1.0f, 0.999f)[0], 255);  // no overflow
}

// ---- Dither

// The noise of a window of pixels, row by row.
std::vector<float> noise_of(int x0_px, int y0_px, int size_px) {
  std::vector<float> x, y;
  for (int i = 0; i < size_px * size_px; ++i) {
    x.push_back(static_cast<float>(x0_px + i % size_px));
    y.push_back(static_cast<float>(y0_px + i / size_px));
  }
  std::vector<float> noise(x.size());
  pixel_noise(x, y, noise);
  return noise;
}

double mean(const std::vector<float>& values) {
  double sum = 0.0;
  for (const float value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

TEST_P(PictureBytes, NoiseIsSpreadEvenly) {
  constexpr int kSize_px = 512, kParts = 16;
  const std::vector<float> noise = noise_of(37, 1201, kSize_px);
  std::array<int, kParts> count{};
  for (const float value : noise) {
    ASSERT_GE(value, 0.0f);
    ASSERT_LT(value, 1.0f);
    ++count[static_cast<std::size_t>(value * kParts)];
  }
  for (const int n : count) EXPECT_NEAR(n * kParts / static_cast<double>(noise.size()), 1.0, 0.01);
  EXPECT_NEAR(mean(noise), 0.5, 1e-3);
}

// The standard deviation of the mean of blocks of `side` x `side` pixels.
double block_deviation(const std::vector<float>& noise, int size_px, int side) {
  double squares = 0.0;
  int blocks = 0;
  for (int y = 0; y + side <= size_px; ++y) {
    for (int x = 0; x + side <= size_px; ++x, ++blocks) {
      double sum = 0.0;
      for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) sum += noise[(y + j) * size_px + x + i];
      const double off = sum / (side * side) - 0.5;
      squares += off * off;
    }
  }
  return std::sqrt(squares / blocks);
}

// Independent values give 0.289 / side.
TEST_P(PictureBytes, NoiseOfNeighboursMakesUpForEachOther) {
  const std::vector<float> noise = noise_of(0, 0, 512);
  EXPECT_NEAR(block_deviation(noise, 512, 1), std::sqrt(1.0 / 12.0), 1e-3);
  EXPECT_NEAR(block_deviation(noise, 512, 3), 0.038, 0.002);
  EXPECT_NEAR(block_deviation(noise, 512, 4), 0.035, 0.002);
}

// A plain area's mean is its light, not the whole step below or above.
TEST_P(PictureBytes, KeepTheMeanOfAPlainAreaByTheDither) {
  const std::vector<float> noise = noise_of(640, 360, 256);
  for (const float light : {0.002f, 0.01f, 0.05f, 0.2f, 0.5f, 0.69f, 0.8f, 1.5f}) {
    std::vector<int> byte(noise.size());
    to_byte(std::vector<float>(noise.size(), light), 1.0f, noise, byte);
    double sum = 0.0;
    for (const int b : byte) sum += b;
    const double area = sum / static_cast<double>(byte.size());
    const double code = encoded({static_cast<float>(tone(light))})[0];
    EXPECT_NEAR(area, code, 5e-3) << light;
    EXPECT_NEAR(area, srgb(tone(light)), kSrgbError + 5e-3) << light;
  }
}

// ---- Planar maps

// sqrt(x / (x + 1)) of 255, to the nearest, at most 254: no light but 0 is lost, and none is cut
// off at white.
TEST_P(PictureBytes, OfPlanarMapsHoldLightFromNightToGlints) {
  std::vector<float> light = {0.0f, -1.0f, 1e30f};
  for (int i = 0; i < 4000; ++i) light.push_back(std::exp2(static_cast<float>(i) / 200.0f - 13.0f));
  std::vector<int> byte(light.size());
  std::vector<float> decoded(light.size());
  light_code(light, byte, decoded);
  EXPECT_EQ(byte[0], 0);
  EXPECT_EQ(byte[1], 0);
  EXPECT_EQ(byte[2], 254);
  for (std::size_t i = 3; i < light.size(); ++i) {
    const double x = light[i], code = std::sqrt(x / (x + 1.0));
    ASSERT_NEAR(byte[i], std::min(255.0 * code, 254.0), 0.501) << x;
    const double c2 = byte[i] / 255.0 * byte[i] / 255.0, exact = c2 / (1.0 - c2);
    ASSERT_NEAR(decoded[i], exact, 3e-5 * exact) << x;
    const double step = 2.0 * code / std::pow(1.0 - code * code, 2.0) / 255.0;
    if (x < 5.0) {
      ASSERT_NEAR(exact, x, 0.53 * step + 2e-5);
    }
  }
}

}  // namespace
}  // namespace swell::render
