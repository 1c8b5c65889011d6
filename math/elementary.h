// Elementary functions in double precision from +, -, *, / and sqrt alone, so that they give the
// same bits on every x86-64 CPU. The C library's do not (its double sin, exp, log ... take other
// paths on CPUs without FMA); nothing that feeds a pixel may call those. For SIMD code in single
// precision see elementary-inl.h.
//
// Errors below are against the exact value, tested in tests/math/elementary_test.cpp.
#pragma once

#include <limits>

namespace swell {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kTwoPi = 2.0 * kPi;
inline constexpr double kRadPerDeg = kPi / 180.0;
constexpr double radians(double deg) { return deg * kRadPerDeg; }
template <typename T>
inline constexpr T kInfinity = std::numeric_limits<T>::infinity();

struct SinCos {
  double sin, cos;
};

// sin and cos of 2 pi x. The reduction is exact: absolute error 4e-16 for |x| < 2^52. NaN or
// infinity gives NaN.
SinCos sin_cos_turns(double x);

// Absolute error 4e-16 (1 + |x|).
double sin(double x);
double cos(double x);
double tan(double x);

// Relative error 1e-15 down to 2^-1022, absolute error 1e-323 below; 0 below -745, infinity where
// a double cannot hold the result (above 709.78).
double exp(double x);
// Relative error 1e-15; -infinity at 0, NaN below.
double log(double x);
// x >= 0, y finite: exp(y log x), relative error 1e-15 (1 + |y log x|). 1 at y = 0. NaN for x < 0.
double pow(double x, double y);
double tanh(double x);  // relative error 1e-14

// Absolute error 1e-15, in [-pi, pi]; 0 at the origin.
double atan2(double y, double x);
double acos(double x);  // x clamped to [-1, 1], absolute error 1e-15

// log Gamma(x) for x > 0, error 1e-14 max(1, |result|). NaN for other x.
double log_gamma(double x);

}  // namespace swell
