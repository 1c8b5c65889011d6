#include "math/elementary.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace swell {
namespace {

// c[0] + c[1] x + ... by Horner's rule.
template <std::size_t N>
double polynomial(double x, const std::array<double, N>& c) {
  double sum = c[N - 1];
  for (std::size_t i = N - 1; i-- > 0;) sum = sum * x + c[i];
  return sum;
}

// Taylor coefficients 1, 1/(a(a+1)), ... of sin(y)/y (first = 2) and cos(y) (first = 1) in -y^2.
template <std::size_t N>
constexpr std::array<double, N> alternating_factorials(int first) {
  std::array<double, N> c{};
  double factorial = 1.0;
  for (std::size_t i = 0; i < N; ++i) {
    c[i] = (i % 2 == 0 ? 1.0 : -1.0) / factorial;
    const int n = first + 2 * static_cast<int>(i);
    factorial *= static_cast<double>(n) * (n + 1);
  }
  return c;
}

// 1, 1/3, 1/5, ...: atanh(s)/s in s^2; with alternating signs atan(s)/s.
template <std::size_t N>
constexpr std::array<double, N> odd_reciprocals(double sign) {
  std::array<double, N> c{};
  double s = 1.0;
  for (std::size_t i = 0; i < N; ++i, s *= sign) c[i] = s / (2.0 * static_cast<double>(i) + 1.0);
  return c;
}

template <std::size_t N>
constexpr std::array<double, N> factorial_reciprocals() {
  std::array<double, N> c{};
  double factorial = 1.0;
  for (std::size_t i = 0; i < N; ++i) {
    c[i] = 1.0 / factorial;
    factorial *= static_cast<double>(i + 1);
  }
  return c;
}

constexpr double kLn2Hi = 0x1.62e42fee00000p-1;  // 32 bits, so that k * kLn2Hi is exact
constexpr double kLn2Lo = 0x1.a39ef35793c76p-33;

// 2^k for k in [-1022, 1023].
double power_of_two(int k) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(k + 1023) << 52);
}

double atan_first_octant(double t) {  // t in [0, 1]
  // Halve the angle twice: atan t = 2 atan(t / (1 + sqrt(1 + t^2))), then |t| <= 0.199.
  for (int i = 0; i < 2; ++i) t = t / (1.0 + std::sqrt(1.0 + t * t));
  static constexpr auto kCoefficients = odd_reciprocals<13>(-1.0);
  return 4.0 * t * polynomial(t * t, kCoefficients);
}

}  // namespace

SinCos sin_cos_turns(double x) {
  if (!(std::abs(x) < 0x1p52)) {
    // Every number this large is a whole number of turns; NaN and infinity have no angle.
    if (std::isfinite(x)) return {0.0, 1.0};
    return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  }
  // Exact reduction: x = whole turns + quarter / 4 + f, |f| <= 1/8.
  const double r = x - std::nearbyint(x);
  const double quarter = std::nearbyint(4.0 * r);
  const double y = (2.0 * kPi) * (r - 0.25 * quarter);
  static constexpr auto kSin = alternating_factorials<9>(2);
  static constexpr auto kCos = alternating_factorials<9>(1);
  const double s = y * polynomial(y * y, kSin);
  const double c = polynomial(y * y, kCos);
  switch (static_cast<int>(quarter) & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

double sin(double x) { return sin_cos_turns(x / (2.0 * kPi)).sin; }
double cos(double x) { return sin_cos_turns(x / (2.0 * kPi)).cos; }
double tan(double x) {
  const SinCos v = sin_cos_turns(x / (2.0 * kPi));
  return v.sin / v.cos;
}

double exp(double x) {
  if (std::isnan(x)) return x;
  if (x > 710.0) return std::numeric_limits<double>::infinity();
  if (x < -745.0) return 0.0;
  const double k = std::nearbyint(x * (1.0 / (kLn2Hi + kLn2Lo)));
  const double r = (x - k * kLn2Hi) - k * kLn2Lo;  // |r| <= 0.347
  static constexpr auto kCoefficients = factorial_reciprocals<15>();
  const double e = polynomial(r, kCoefficients);
  // Two steps, so that neither power leaves the normal range; only the last one rounds.
  const int half = static_cast<int>(k) / 2;
  return e * power_of_two(half) * power_of_two(static_cast<int>(k) - half);
}

double log(double x) {
  if (std::isnan(x) || x < 0.0) return std::numeric_limits<double>::quiet_NaN();
  if (x == 0.0) return -std::numeric_limits<double>::infinity();
  if (std::isinf(x)) return x;
  int exponent = 0;
  double m = std::frexp(x, &exponent);  // [0.5, 1)
  if (m < 0.70710678118654752) {
    m *= 2.0;
    --exponent;
  }
  // log m = 2 atanh((m - 1) / (m + 1)), |s| <= 0.1716.
  const double s = (m - 1.0) / (m + 1.0);
  static constexpr auto kCoefficients = odd_reciprocals<12>(1.0);
  const double series = 2.0 * s * polynomial(s * s, kCoefficients);
  return exponent * kLn2Hi + (exponent * kLn2Lo + series);
}

double pow(double x, double y) {
  if (y == 0.0) return 1.0;
  if (x == 0.0) return y > 0.0 ? 0.0 : std::numeric_limits<double>::infinity();
  return exp(y * log(x));
}

double tanh(double x) {
  const double a = std::abs(x);
  if (a > 20.0) return std::copysign(1.0, x);
  if (a < 0.02) {  // series: the quotient below would cancel
    const double q = x * x;
    return x * (1.0 + q * (-1.0 / 3 + q * (2.0 / 15 + q * (-17.0 / 315 + q * (62.0 / 2835)))));
  }
  const double e = exp(-2.0 * a);
  return std::copysign((1.0 - e) / (1.0 + e), x);
}

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return std::numeric_limits<double>::quiet_NaN();
  const double ax = std::abs(x), ay = std::abs(y);
  const double larger = std::max(ax, ay);
  if (larger == 0.0) return 0.0;
  double angle = std::isinf(larger) ? (ax == ay ? kPi / 4 : 0.0)
                                    : atan_first_octant(std::min(ax, ay) / larger);
  if (ay > ax) angle = kPi / 2 - angle;
  if (x < 0.0) angle = kPi - angle;
  return std::copysign(angle, y);
}

double acos(double x) {
  const double c = std::clamp(x, -1.0, 1.0);
  return atan2(std::sqrt((1.0 - c) * (1.0 + c)), c);
}

double log_gamma(double x) {
  if (!(x > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  if (std::isinf(x)) return x;
  // Gamma(x) = Gamma(x + n) / (x (x + 1) ... (x + n - 1)) up to x >= 10, then Stirling's series.
  double product = 1.0;
  while (x < 10.0) {
    product *= x;
    x += 1.0;
  }
  static constexpr std::array<double, 7> kStirling = {
      1.0 / 12, -1.0 / 360, 1.0 / 1260, -1.0 / 1680, 1.0 / 1188, -691.0 / 360360, 1.0 / 156};
  constexpr double kHalfLog2Pi = 0.91893853320467274178;
  const double series = polynomial(1.0 / (x * x), kStirling) / x;
  return (x - 0.5) * log(x) - x + kHalfLog2Pi + series - log(product);
}

}  // namespace swell
