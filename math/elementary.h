// Elementary functions in double precision from +, -, *, / and sqrt alone, so that they give the
// same bits on every x86-64 CPU. The C library's do not (its double sin, exp, log ... take other
// paths on CPUs without FMA); nothing that feeds a pixel may call those. For SIMD code in single
// precision see elementary-inl.h.
//
// Errors below are against the exact value, tested in tests/math/elementary_test.cpp.
#pragma once

namespace swell {

inline constexpr double kPi = 3.14159265358979323846;

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

// Relative error 1e-15; 0 below -745, infinity above 710.
double exp(double x);
// Relative error 1e-15 (absolute near 1); -infinity at 0, NaN below.
double log(double x);
// x > 0 (or x = 0 with y > 0): exp(y log x), relative error 1e-15 (1 + |y log x|).
double pow(double x, double y);
double tanh(double x);  // relative error 1e-14

// Absolute error 1e-15, in [-pi, pi]; 0 at the origin.
double atan2(double y, double x);
double acos(double x);  // x clamped to [-1, 1], absolute error 1e-15 (1e-8 next to +-1)

// log Gamma(x) for x > 0, relative error 1e-14 (absolute near 1 and 2).
double log_gamma(double x);

}  // namespace swell
