// The double functions against the C library's in long double (64 significant bits).
#include "math/elementary.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "bits_hash.h"

namespace swell {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kMax = std::numeric_limits<double>::max();
constexpr double kDenormal = std::numeric_limits<double>::denorm_min();
constexpr long double kPiL = std::numbers::pi_v<long double>;

std::vector<double> linear_sweep(double first, double last, int count) {
  std::vector<double> x;
  for (int i = 0; i < count; ++i) x.push_back(first + (last - first) * i / (count - 1));
  return x;
}

// Numbers of every magnitude from 2^first to 2^last, `per_octave` in each octave.
std::vector<double> octave_sweep(int first, int last, int per_octave) {
  std::vector<double> x;
  for (int e = first; e < last; ++e) {
    for (int i = 0; i < per_octave; ++i) x.push_back(std::ldexp(1.0 + i / (0.37 + per_octave), e));
  }
  return x;
}

// Checks |f(x) - exact(x)| <= bound(x, exact) for all x.
template <class Function, class Exact, class Bound>
void expect_within(const std::vector<double>& xs, Function f, Exact exact, Bound bound) {
  for (const double x : xs) {
    const long double expected = exact(static_cast<long double>(x));
    const long double error = std::abs(static_cast<long double>(f(x)) - expected);
    ASSERT_LE(error, static_cast<long double>(bound(x, static_cast<double>(expected))))
        << "x = " << x << ", exact = " << expected;
  }
}

constexpr auto kAbsolute = [](double limit) { return [=](double, double) { return limit; }; };
constexpr auto kRelative = [](double limit) {
  return [=](double, double exact) { return limit * std::abs(exact); };
};
constexpr auto kGrowing = [](double limit) {
  return [=](double x, double) { return limit * (1.0 + std::abs(x)); };
};

long double exact_sin_turns(long double x) {
  return std::sin(2.0L * kPiL * (x - std::nearbyint(x)));
}
long double exact_cos_turns(long double x) {
  return std::cos(2.0L * kPiL * (x - std::nearbyint(x)));
}

TEST(SinCosTurns, IsExactAtQuarterTurns) {
  const double turns[] = {0.0, 0.25, 0.5, 0.75, 1.0, -0.25, -0.5, 1e9 + 0.25};
  const double sines[] = {0, 1, 0, -1, 0, -1, 0, 1};
  const double cosines[] = {1, 0, -1, 0, 1, 0, -1, 0};
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(sin_cos_turns(turns[i]).sin, sines[i]) << turns[i];
    EXPECT_EQ(sin_cos_turns(turns[i]).cos, cosines[i]) << turns[i];
  }
}

TEST(SinCosTurns, KeepsItsErrorBoundOverTwoTurns) {
  const std::vector<double> xs = linear_sweep(-1.0, 1.0, 40009);
  const auto bound = kAbsolute(4e-16);
  expect_within(
      xs, [](double x) { return sin_cos_turns(x).sin; }, exact_sin_turns, bound);
  expect_within(
      xs, [](double x) { return sin_cos_turns(x).cos; }, exact_cos_turns, bound);
}

TEST(SinCosTurns, KeepsItsErrorBoundAtEveryMagnitude) {
  const std::vector<double> xs = octave_sweep(-1074, 60, 13);
  const auto bound = kAbsolute(4e-16);
  expect_within(
      xs, [](double x) { return sin_cos_turns(x).sin; }, exact_sin_turns, bound);
  expect_within(
      xs, [](double x) { return sin_cos_turns(-x).cos; }, exact_cos_turns, bound);
}

TEST(SinCosTurns, SpecialArgumentsHaveDocumentedResults) {
  EXPECT_EQ(sin_cos_turns(-0.0).sin, 0.0);
  EXPECT_EQ(sin_cos_turns(-0.0).cos, 1.0);
  EXPECT_EQ(sin_cos_turns(kMax).sin, 0.0);
  EXPECT_EQ(sin_cos_turns(kMax).cos, 1.0);
  for (const double x : {kInf, -kInf, kNan}) {
    EXPECT_TRUE(std::isnan(sin_cos_turns(x).sin));
    EXPECT_TRUE(std::isnan(sin_cos_turns(x).cos));
  }
}

TEST(SinAndCos, KeepTheirErrorBound) {
  const auto sine = [](long double x) { return std::sin(x); };
  const auto cosine = [](long double x) { return std::cos(x); };
  for (const auto& xs : {linear_sweep(-20.0, 20.0, 20011), octave_sweep(-1074, 40, 7)}) {
    expect_within(
        xs, [](double x) { return sin(x); }, sine, kGrowing(4e-16));
    expect_within(
        xs, [](double x) { return cos(x); }, cosine, kGrowing(4e-16));
  }
}

TEST(Tan, KeepsARelativeErrorOnHalfAFieldOfView) {
  expect_within(
      linear_sweep(0.01, 1.5, 10007), [](double x) { return tan(x); },
      [](long double x) { return std::tan(x); },
      [](double, double exact) { return 1e-15 * exact * (1.0 + exact + 1.0 / exact); });
}

TEST(Exp, KeepsItsErrorBound) {
  const auto exact = [](long double x) { return std::exp(x); };
  const auto f = [](double x) { return exp(x); };
  expect_within(linear_sweep(-708.3, 709.78, 40009), f, exact, kRelative(1e-15));
  expect_within(linear_sweep(-1.0, 1.0, 20011), f, exact, kRelative(1e-15));
}

TEST(Exp, UnderflowsThroughTheDenormalsAndOverflowsToInfinity) {
  expect_within(
      linear_sweep(-744.4, -708.4, 1009), [](double x) { return exp(x); },
      [](long double x) { return std::exp(x); },
      [](double, double exact) { return 1e-15 * exact + 1e-323; });
  EXPECT_EQ(exp(-745.2), 0.0);
  EXPECT_EQ(exp(-kInf), 0.0);
  EXPECT_EQ(exp(-kMax), 0.0);
  EXPECT_EQ(exp(709.79), kInf);
  EXPECT_EQ(exp(kMax), kInf);
  EXPECT_EQ(exp(kInf), kInf);
  EXPECT_EQ(exp(0.0), 1.0);
  EXPECT_EQ(exp(-0.0), 1.0);
  EXPECT_EQ(exp(kDenormal), 1.0);
  EXPECT_TRUE(std::isnan(exp(kNan)));
}

TEST(Log, KeepsItsErrorBound) {
  const auto exact = [](long double x) { return std::log(x); };
  const auto f = [](double x) { return log(x); };
  expect_within(octave_sweep(-1074, 1024, 13), f, exact, kRelative(1e-15));
  expect_within(linear_sweep(0.4, 2.5, 40009), f, exact, kRelative(1e-15));
  expect_within(linear_sweep(0.999999, 1.000001, 2003), f, exact, kRelative(1e-15));
}

TEST(Log, SpecialArgumentsHaveDocumentedResults) {
  EXPECT_EQ(log(1.0), 0.0);
  EXPECT_EQ(log(0.0), -kInf);
  EXPECT_EQ(log(-0.0), -kInf);
  EXPECT_EQ(log(kInf), kInf);
  EXPECT_TRUE(std::isnan(log(-kDenormal)));
  EXPECT_TRUE(std::isnan(log(-kInf)));
  EXPECT_TRUE(std::isnan(log(kNan)));
}

TEST(Pow, KeepsItsErrorBound) {
  for (const double y : {-5.0, -1.0, -0.25, 0.5, 1.0, 2.0, 3.3, 40.0}) {
    expect_within(
        octave_sweep(-20, 20, 101), [=](double x) { return pow(x, y); },
        [=](long double x) { return std::pow(x, static_cast<long double>(y)); },
        [=](double x, double exact) { return 1e-15 * exact * (1.0 + std::abs(y * std::log(x))); });
  }
}

TEST(Pow, SpecialArgumentsHaveDocumentedResults) {
  EXPECT_EQ(pow(0.0, 2.0), 0.0);
  EXPECT_EQ(pow(0.0, -2.0), kInf);
  EXPECT_EQ(pow(0.0, 0.0), 1.0);
  EXPECT_EQ(pow(7.0, 0.0), 1.0);
  EXPECT_EQ(pow(kInf, 0.0), 1.0);
  EXPECT_TRUE(std::isnan(pow(-1.0, 2.0)));
}

TEST(Tanh, KeepsItsErrorBound) {
  const auto exact = [](long double x) { return std::tanh(x); };
  const auto f = [](double x) { return tanh(x); };
  expect_within(linear_sweep(-21.0, 21.0, 40009), f, exact, kRelative(1e-14));
  expect_within(linear_sweep(-0.05, 0.05, 20011), f, exact, kRelative(1e-14));
  EXPECT_EQ(tanh(kInf), 1.0);
  EXPECT_EQ(tanh(-kInf), -1.0);
  EXPECT_EQ(tanh(kDenormal), kDenormal);
  EXPECT_TRUE(std::isnan(tanh(kNan)));
}

TEST(Atan2, KeepsItsErrorBoundAllTheWayRound) {
  for (const double radius : {1e-300, 1.0, 1e300}) {
    for (const double turns : linear_sweep(-0.5, 0.5, 5003)) {
      const double y = radius * std::sin(2.0 * std::numbers::pi * turns);
      const double x = radius * std::cos(2.0 * std::numbers::pi * turns);
      const long double exact =
          std::atan2(static_cast<long double>(y), static_cast<long double>(x));
      ASSERT_LE(std::abs(atan2(y, x) - exact), 1e-15L) << y << " " << x;
    }
  }
}

TEST(Atan2, StaysInItsRangeAndKnowsTheAxes) {
  EXPECT_EQ(atan2(0.0, 0.0), 0.0);
  EXPECT_EQ(atan2(0.0, 1.0), 0.0);
  EXPECT_EQ(atan2(0.0, -1.0), kPi);
  EXPECT_EQ(atan2(-0.0, -1.0), -kPi);
  EXPECT_EQ(atan2(1.0, 0.0), kPi / 2);
  EXPECT_EQ(atan2(-1.0, 0.0), -kPi / 2);
  EXPECT_EQ(atan2(kInf, 1.0), kPi / 2);
  EXPECT_EQ(atan2(1.0, -kInf), kPi);
  EXPECT_EQ(atan2(kInf, kInf), kPi / 4);
  EXPECT_EQ(atan2(kDenormal, kMax), 0.0);
  EXPECT_NEAR(atan2(kDenormal, kDenormal), kPi / 4, 1e-15);
  EXPECT_TRUE(std::isnan(atan2(kNan, 1.0)));
  EXPECT_TRUE(std::isnan(atan2(1.0, kNan)));
}

TEST(Acos, KeepsItsErrorBoundUpToTheEnds) {
  const auto exact = [](long double x) { return std::acos(x); };
  const auto f = [](double x) { return acos(x); };
  expect_within(linear_sweep(-1.0, 1.0, 20011), f, exact, kAbsolute(1e-15));
  expect_within(linear_sweep(0.99999999, 1.0, 2003), f, exact, kAbsolute(1e-15));
  expect_within(linear_sweep(-1.0, -0.99999999, 2003), f, exact, kAbsolute(1e-15));
  EXPECT_EQ(acos(1.5), 0.0);
  EXPECT_EQ(acos(-kInf), kPi);
  EXPECT_TRUE(std::isnan(acos(kNan)));
}

TEST(LogGamma, IsTheLogarithmOfTheFactorial) {
  double log_factorial = 0.0;
  for (int n = 1; n <= 170; ++n) {
    log_factorial += std::log(static_cast<double>(n));
    EXPECT_NEAR(log_gamma(n + 1.0), log_factorial, 1e-14 * (1.0 + log_factorial));
  }
  EXPECT_NEAR(log_gamma(0.5), 0.5 * std::log(std::numbers::pi), 1e-14);
}

TEST(LogGamma, KeepsItsErrorBound) {
  const auto exact = [](long double x) { return std::lgamma(x); };
  const auto f = [](double x) { return log_gamma(x); };
  const auto bound = [](double, double value) { return 1e-14 * std::max(1.0, std::abs(value)); };
  expect_within(linear_sweep(0.01, 30.0, 10007), f, exact, bound);
  expect_within(octave_sweep(-1022, 1000, 5), f, exact, bound);
}

TEST(LogGamma, OutsideItsDomainItReturnsAtOnce) {
  EXPECT_EQ(log_gamma(kInf), kInf);
  for (const double x : {0.0, -0.5, -1e300, -kInf, kNan}) EXPECT_TRUE(std::isnan(log_gamma(x)));
}

// One hash over everything: a changed bit on another CPU, compiler or day is noticed.
TEST(Elementary, GivesTheGoldenBits) {
  BitsHash hash;
  std::vector<double> xs = linear_sweep(-30.0, 30.0, 5003);
  for (const double x : octave_sweep(-1074, 1024, 3)) xs.insert(xs.end(), {x, -x});
  for (const double x : xs) {
    const SinCos turn = sin_cos_turns(x);
    const double positive = std::abs(x) + kDenormal;
    for (const double y :
         {turn.sin, turn.cos, sin(x), cos(x), tan(x), exp(x), log(positive), pow(positive, 1.7),
          tanh(x), atan2(x, 0.7), atan2(-1.3, x), acos(x), log_gamma(positive)}) {
      hash.add(y);
    }
  }
  EXPECT_EQ(hash.value(), 0x47f28f05ea2170a5u) << std::hex << hash.value();
}

}  // namespace
}  // namespace swell
