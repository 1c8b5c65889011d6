// The vector functions on every float of the intervals that their reductions lead to: what the
// sweeps of elementary_simd_test.cpp sample, completely.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "elementary_kernels.h"

namespace swell {
namespace {

constexpr std::uint32_t kBlock = 1 << 16;

// Calls check(x) with all floats from first (included) to last (excluded), a block at a time.
template <class Check>
void for_every_float(float first, float last, const Check& check) {
  const std::uint32_t end = std::bit_cast<std::uint32_t>(last);
  std::vector<float> x;
  for (std::uint32_t start = std::bit_cast<std::uint32_t>(first); start < end; start += kBlock) {
    x.clear();
    for (std::uint32_t b = start; b < std::min(start + kBlock, end); ++b) {
      x.push_back(std::bit_cast<float>(b));
    }
    check(x);
  }
}

TEST(ElementaryExhaustive, SineAndCosineOfEveryFloatUpToOneTurn) {
  double worst = 0.0;
  std::vector<float> s(kBlock), c(kBlock);
  for_every_float(0x1p-5f, 1.0f, [&](const std::vector<float>& x) {
    sin_cos_turns_batch(x, s, c);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double angle = 2.0 * std::numbers::pi * x[i];
      worst = std::max({worst, std::abs(s[i] - std::sin(angle)), std::abs(c[i] - std::cos(angle))});
    }
  });
  EXPECT_LE(worst, 1e-7);
  RecordProperty("worst", std::to_string(worst * 1e9) + "e-9");
}

TEST(ElementaryExhaustive, PowersOfTwoOfEveryFloatUpToOne) {
  double worst = 0.0;
  std::vector<float> y(kBlock);
  for_every_float(0x1p-5f, 1.0f, [&](const std::vector<float>& x) {
    exp2_batch(x, y);
    for (std::size_t i = 0; i < x.size(); ++i) {
      worst = std::max(worst, std::abs(y[i] / std::exp2(static_cast<double>(x[i])) - 1.0));
    }
  });
  EXPECT_LE(worst, 1e-7);
  RecordProperty("worst", std::to_string(worst * 1e9) + "e-9");
}

TEST(ElementaryExhaustive, LogarithmsOfEveryFloatAroundOne) {
  double worst = 0.0;  // as a share of the documented bound
  std::vector<float> y(kBlock);
  for_every_float(0.5f, 2.0f, [&](const std::vector<float>& x) {
    log2_batch(x, y);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double exact = std::log2(static_cast<double>(x[i]));
      const double size = std::abs(exact);
      if (exact == 0.0) {
        EXPECT_EQ(y[i], 0.0f);
      } else {
        worst = std::max(worst, std::abs(y[i] - exact) / (2e-7 * (std::min(1.0, size) + size / 2)));
      }
    }
  });
  EXPECT_LE(worst, 1.0);
  RecordProperty("share_of_bound", std::to_string(worst));
}

}  // namespace
}  // namespace swell
