// The vector functions against the C library in double precision, on every target.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "bits_hash.h"
#include "each_target.h"
#include "elementary_kernels.h"

namespace swell {
namespace {

constexpr float kFloatInf = std::numeric_limits<float>::infinity();
constexpr float kFloatNan = std::numeric_limits<float>::quiet_NaN();

class ElementarySimd : public EachTarget {};
INSTANTIATE_TEST_SUITE_P(Targets, ElementarySimd, each_target(), target_name);

std::vector<float> linear_sweep(float first, float last, int count) {
  std::vector<float> x(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    x[static_cast<std::size_t>(i)] =
        first + (last - first) * (static_cast<float>(i) / static_cast<float>(count - 1));
  }
  return x;
}

// Every stride-th float from first_bits to last_bits, in the order of their representations.
std::vector<float> bits_sweep(std::uint32_t first_bits, std::uint32_t last_bits,
                              std::uint32_t stride) {
  std::vector<float> x;
  for (std::uint64_t bits = first_bits; bits <= last_bits; bits += stride) {
    x.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
  }
  return x;
}

std::vector<float> run(void (*batch)(std::span<const float>, std::span<float>),
                       const std::vector<float>& x) {
  std::vector<float> out(x.size(), kFloatNan);
  batch(x, out);
  return out;
}

double double_sin_turns(double x) {
  return std::sin(2.0 * std::numbers::pi * (x - std::nearbyint(x)));
}
double double_cos_turns(double x) {
  return std::cos(2.0 * std::numbers::pi * (x - std::nearbyint(x)));
}

double largest_sin_cos_error(const std::vector<float>& x) {
  std::vector<float> s(x.size(), kFloatNan), c(x.size(), kFloatNan);
  sin_cos_turns_batch(x, s, c);
  double worst = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double error =
        std::max(std::abs(s[i] - double_sin_turns(x[i])), std::abs(c[i] - double_cos_turns(x[i])));
    worst = error <= worst ? worst : error;  // keeps NaN
  }
  return worst;
}

TEST_P(ElementarySimd, DispatchRunsTheVectorWidthOfTheTarget) {
  EXPECT_EQ(float_lanes(), GetParam() == SimdTarget::kNeon   ? 4
                           : GetParam() == SimdTarget::kAvx2 ? 8
                                                             : 16);
}

TEST_P(ElementarySimd, SineAndCosineAreExactAtQuarterTurns) {
  const std::vector<float> x = {0.0f, 0.25f, 0.5f, 0.75f, 1.0f, -0.25f, -0.5f, 1000000.25f};
  std::vector<float> s(x.size()), c(x.size());
  sin_cos_turns_batch(x, s, c);
  EXPECT_EQ(s, (std::vector<float>{0, 1, 0, -1, 0, -1, 0, 1}));
  EXPECT_EQ(c, (std::vector<float>{1, 0, -1, 0, 1, 0, -1, 0}));
}

TEST_P(ElementarySimd, SineAndCosineKeepTheirErrorBoundOverTwoTurns) {
  EXPECT_LE(largest_sin_cos_error(linear_sweep(-1.0f, 1.0f, 200003)), 1e-7);
}

TEST_P(ElementarySimd, SineAndCosineKeepTheirErrorBoundAtEveryMagnitude) {
  EXPECT_LE(largest_sin_cos_error(bits_sweep(0, 0x7f7fffffu, 9973)), 1e-7);
  EXPECT_LE(largest_sin_cos_error(bits_sweep(0x80000000u, 0xff7fffffu, 9973)), 1e-7);
}

TEST_P(ElementarySimd, SineAndCosineOfNonFiniteArgumentsAreNan) {
  const std::vector<float> x = {kFloatInf, -kFloatInf, kFloatNan};
  std::vector<float> s(x.size()), c(x.size());
  sin_cos_turns_batch(x, s, c);
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_TRUE(std::isnan(s[i]) && std::isnan(c[i])) << x[i];
  }
}

TEST_P(ElementarySimd, PowersOfTwoAreExactAtWholeNumbers) {
  std::vector<float> x;
  for (int i = -126; i <= 126; ++i) x.push_back(static_cast<float>(i));
  const std::vector<float> y = run(exp2_batch, x);
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_EQ(y[i], std::ldexp(1.0f, static_cast<int>(x[i]))) << x[i];
  }
}

TEST_P(ElementarySimd, PowersOfTwoKeepTheirErrorBound) {
  const std::vector<float> x = linear_sweep(-126.0f, 126.0f, 300007);
  const std::vector<float> y = run(exp2_batch, x);
  for (std::size_t i = 0; i < x.size(); ++i) {
    ASSERT_NEAR(y[i] / std::exp2(static_cast<double>(x[i])), 1.0, 1e-7) << x[i];
  }
}

TEST_P(ElementarySimd, PowersOfTwoClampTheirArgumentAndKeepNan) {
  const std::vector<float> y = run(exp2_batch, {-126.5f, -1e30f, -kFloatInf, 126.5f, 1e30f,
                                                kFloatInf, kFloatNan, -0.0f, 1e-45f});
  const float low = 0x1p-126f, high = 0x1p126f;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(y[static_cast<std::size_t>(i)], low);
  for (int i = 3; i < 6; ++i) EXPECT_EQ(y[static_cast<std::size_t>(i)], high);
  EXPECT_TRUE(std::isnan(y[6]));
  EXPECT_EQ(y[7], 1.0f);
  EXPECT_EQ(y[8], 1.0f);
}

TEST_P(ElementarySimd, TheExponentialKeepsItsErrorBound) {
  const std::vector<float> x = linear_sweep(-87.3f, 87.3f, 300007);
  const std::vector<float> y = run(exp_batch, x);
  for (std::size_t i = 0; i < x.size(); ++i) {
    ASSERT_NEAR(y[i] / std::exp(static_cast<double>(x[i])), 1.0, 1e-7 * (1.0 + std::abs(x[i])))
        << x[i];
  }
}

TEST_P(ElementarySimd, TheExponentialClampsAndKeepsNan) {
  const std::vector<float> y =
      run(exp_batch, {-kFloatInf, -1e38f, kFloatInf, 1e38f, kFloatNan, 0.0f});
  EXPECT_EQ(y[0], 0x1p-126f);
  EXPECT_EQ(y[1], 0x1p-126f);
  EXPECT_EQ(y[2], 0x1p126f);
  EXPECT_EQ(y[3], 0x1p126f);
  EXPECT_TRUE(std::isnan(y[4]));
  EXPECT_EQ(y[5], 1.0f);
}

void expect_log2_bound(const std::vector<float>& x) {
  const std::vector<float> y = run(log2_batch, x);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double exact = std::log2(static_cast<double>(x[i]));
    const double size = std::abs(exact);
    ASSERT_NEAR(y[i], exact, 2e-7 * (std::min(1.0, size) + 0.5 * size)) << x[i];
  }
}

TEST_P(ElementarySimd, TheLogarithmKeepsItsErrorBoundAtEveryMagnitude) {
  expect_log2_bound(bits_sweep(0x00800000u, 0x7f7fffffu, 9973));
}

TEST_P(ElementarySimd, TheLogarithmKeepsItsErrorBoundAroundOne) {
  expect_log2_bound(bits_sweep(0x3f000000u, 0x40000000u, 97));
  expect_log2_bound(bits_sweep(0x3f7ff000u, 0x3f801000u, 1));
}

TEST_P(ElementarySimd, TheCoarseLogarithmKeepsItsErrorBound) {
  for (const auto& x :
       {bits_sweep(0x00800000u, 0x7f7fffffu, 9973), bits_sweep(0x3f000000u, 0x40000000u, 97)}) {
    const std::vector<float> y = run(log2_coarse_batch, x);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double exact = std::log2(static_cast<double>(x[i]));
      ASSERT_NEAR(y[i], exact, 1.1e-4 + 1e-7 * std::abs(exact)) << x[i];
    }
  }
}

TEST_P(ElementarySimd, TheLogarithmIsExactAtPowersOfTwo) {
  std::vector<float> x, expected;
  for (int i = -126; i <= 127; ++i) {
    x.push_back(std::ldexp(1.0f, i));
    expected.push_back(static_cast<float>(i));
  }
  EXPECT_EQ(run(log2_batch, x), expected);
  EXPECT_EQ(run(log2_coarse_batch, x), expected);
}

TEST_P(ElementarySimd, TheLogarithmOfZeroDenormalsAndInfinityIsFinite) {
  const std::vector<float> y =
      run(log2_batch, {0.0f, 1e-45f, 1.1754942e-38f, kFloatInf, kFloatNan, -1.0f});
  EXPECT_EQ(y[0], -127.0f);
  EXPECT_GE(y[1], -127.0f);
  EXPECT_LE(y[2], -126.0f);
  EXPECT_EQ(y[3], 128.0f);
  EXPECT_TRUE(std::isfinite(y[4]));
  EXPECT_TRUE(std::isfinite(y[5]));
}

std::vector<std::int32_t> run_to_int(void (*batch)(std::span<const float>, std::span<std::int32_t>),
                                     const std::vector<float>& x) {
  std::vector<std::int32_t> out(x.size(), 1234567);
  batch(x, out);
  return out;
}

TEST_P(ElementarySimd, TruncatingDropsTheFractionAndRoundingTakesTheNearestOrEvenNumber) {
  const std::vector<float> x = {0.0f,  -0.0f, 1e-45f, 0.5f,  -0.5f,  0.50000006f, 1.5f,
                                -1.5f, 2.5f,  -2.5f,  2.75f, -2.75f, 8388607.5f,  -8388606.5f};
  EXPECT_EQ(run_to_int(truncate_to_int_batch, x),
            (std::vector<std::int32_t>{0, 0, 0, 0, 0, 0, 1, -1, 2, -2, 2, -2, 8388607, -8388606}));
  EXPECT_EQ(run_to_int(round_to_int_batch, x),
            (std::vector<std::int32_t>{0, 0, 0, 0, 0, 1, 2, -2, 2, -2, 3, -3, 8388608, -8388606}));
}

TEST_P(ElementarySimd, ConvertingToIntegersIsExactAtEveryMagnitude) {
  std::vector<float> x = bits_sweep(0, 0x4effffffu, 9973);  // below 2^31
  const std::vector<float> negative = bits_sweep(0x80000000u, 0xcf000000u, 9973);
  x.insert(x.end(), negative.begin(), negative.end());
  for (const float last : {0x1.fffffep30f, -0x1.fffffep30f, -0x1p31f}) x.push_back(last);
  const auto truncated = run_to_int(truncate_to_int_batch, x);
  const auto rounded = run_to_int(round_to_int_batch, x);
  for (std::size_t i = 0; i < x.size(); ++i) {
    ASSERT_EQ(truncated[i], std::trunc(static_cast<double>(x[i]))) << x[i];
    ASSERT_EQ(rounded[i], std::nearbyint(static_cast<double>(x[i]))) << x[i];
  }
}

TEST_P(ElementarySimd, WhatNoIntegerHoldsIsTheLowestOne) {
  const std::vector<float> x = {0x1p31f, 3e38f,      kFloatInf, -0x1.000002p31f,
                                -3e38f,  -kFloatInf, kFloatNan, -kFloatNan};
  const std::vector<std::int32_t> lowest(x.size(), std::numeric_limits<std::int32_t>::min());
  EXPECT_EQ(run_to_int(truncate_to_int_batch, x), lowest);
  EXPECT_EQ(run_to_int(round_to_int_batch, x), lowest);
}

// One hash over sweeps that include every special value: equal on each target and over time.
TEST_P(ElementarySimd, EveryTargetGivesTheGoldenBits) {
  std::vector<float> x = bits_sweep(0, 0xffff0000u, 49999);
  for (const float special : {kFloatInf, -kFloatInf, kFloatNan, 0.0f, -0.0f}) x.push_back(special);
  std::vector<float> s(x.size()), c(x.size());
  sin_cos_turns_batch(x, s, c);
  BitsHash hash;
  for (const std::vector<float>& results :
       {s, c, run(exp2_batch, x), run(exp_batch, x), run(log2_batch, x)}) {
    for (const float y : results) hash.add(y);
  }
  EXPECT_EQ(hash.value(), 0xb8dae4021ac57889u) << std::hex << hash.value();
}

}  // namespace
}  // namespace swell
