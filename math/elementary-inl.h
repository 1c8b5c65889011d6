// Elementary functions on Highway vectors of float: the same bits on every target, because they
// use only +, -, *, written FMA and exact rounding. Include after <hwy/highway.h> inside a
// *_simd.cpp file (included once per target). Max errors are tested on every target.
#if defined(SWELL_MATH_ELEMENTARY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_MATH_ELEMENTARY_INL_H_
#undef SWELL_MATH_ELEMENTARY_INL_H_
#else
#define SWELL_MATH_ELEMENTARY_INL_H_
#endif

#include <hwy/highway.h>
#if HWY_ARCH_X86
#include <immintrin.h>
#endif

#include <cstdint>
#include <limits>

#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell {
namespace HWY_NAMESPACE {
#if !HWY_ARCH_X86
// What an instruction made of x, which ends at the highest and the lowest integer, as x86 has it.
template <class V, class VI>
HWY_INLINE VI LowestBeyondInt(V x, VI number) {
  const hn::DFromV<VI> di;
  const auto fits = hn::RebindMask(di, hn::Abs(x) < hn::Set(hn::DFromV<V>(), 2147483648.0f));
  return hn::IfThenElse(fits, number, hn::Set(di, std::numeric_limits<std::int32_t>::min()));
}
#endif

template <class V>
using IntegersOf = hn::Vec<hn::RebindToSigned<hn::DFromV<V>>>;

// x without its fraction, and the whole number nearest to x (of two, the even one). The lowest
// integer where |x| >= 2^31 or x is NaN; Highway's own conversions take three more instructions to
// give the highest one on that side.
template <class V>
HWY_INLINE IntegersOf<V> TruncateToInt(V x) {
#if HWY_TARGET == HWY_AVX2
  if constexpr (sizeof(V) == 32) return IntegersOf<V>{_mm256_cvttps_epi32(x.raw)};
  if constexpr (sizeof(V) == 16) return IntegersOf<V>{_mm_cvttps_epi32(x.raw)};
#elif HWY_ARCH_X86
  if constexpr (sizeof(V) == 64) return IntegersOf<V>{_mm512_cvttps_epi32(x.raw)};
  if constexpr (sizeof(V) == 32) return IntegersOf<V>{_mm256_cvttps_epi32(x.raw)};
  if constexpr (sizeof(V) == 16) return IntegersOf<V>{_mm_cvttps_epi32(x.raw)};
#else
  return LowestBeyondInt(x, hn::ConvertTo(hn::RebindToSigned<hn::DFromV<V>>(), x));
#endif
}

template <class V>
HWY_INLINE IntegersOf<V> RoundToInt(V x) {
#if HWY_TARGET == HWY_AVX2
  if constexpr (sizeof(V) == 32) return IntegersOf<V>{_mm256_cvtps_epi32(x.raw)};
  if constexpr (sizeof(V) == 16) return IntegersOf<V>{_mm_cvtps_epi32(x.raw)};
#elif HWY_ARCH_X86
  if constexpr (sizeof(V) == 64) return IntegersOf<V>{_mm512_cvtps_epi32(x.raw)};
  if constexpr (sizeof(V) == 32) return IntegersOf<V>{_mm256_cvtps_epi32(x.raw)};
  if constexpr (sizeof(V) == 16) return IntegersOf<V>{_mm_cvtps_epi32(x.raw)};
#else
  return LowestBeyondInt(x, hn::NearestInt(x));
#endif
}

// sin and cos of 2 pi x. Absolute error 1e-7 for every finite x (from 2^23 on all x are whole
// turns). Infinity and NaN give NaN.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void SinCosTurns(D d, V x, V& sin_out, V& cos_out) {
  const hn::RebindToSigned<D> di;
  // x = whole turns + quarter / 4 + f, exactly, |f| <= 1/8.
  const V r = x - hn::Round(x);
  const V quarter = hn::Round(r * 4.0f);
  const V f = NegMulAdd(quarter, 0.25f, r);
  const V f2 = f * f;
  // Taylor series of sin(2 pi f) / f and cos(2 pi f) in f^2.
  V s = hn::Set(d, 42.058693f);
  s = MulAdd(s, f2, -76.705859f);
  s = MulAdd(s, f2, 81.605249f);
  s = MulAdd(s, f2, -41.341702f);
  s = MulAdd(s, f2, 6.2831853f);
  s = s * f;
  V c = hn::Set(d, -26.426257f);
  c = MulAdd(c, f2, 60.244641f);
  c = MulAdd(c, f2, -85.456817f);
  c = MulAdd(c, f2, 64.939394f);
  c = MulAdd(c, f2, -19.739209f);
  c = MulAdd(c, f2, 1.0f);
  // Quarter turns: odd ones swap, 1 and 2 negate the cosine, 2 and 3 the sine.
  const auto q = TruncateToInt(quarter);
  const auto odd = hn::MaskFromVec(hn::BitCast(d, -(q & 1)));
  const auto two = hn::Set(di, 2);
  const auto sin_sign = hn::ShiftLeft<30>(q & two);
  const auto cos_sign = hn::ShiftLeft<30>((q + 1) & two);
  sin_out = hn::Xor(IfThenElse(odd, c, s), hn::BitCast(d, sin_sign));
  cos_out = hn::Xor(IfThenElse(odd, s, c), hn::BitCast(d, cos_sign));
}

// 2^x, x clamped to [-126, 126]; exact where x is whole. Relative error 1e-7. NaN gives NaN.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Exp2(D d, V x) {
  // Not Min and Max: which operand they return beside a NaN depends on the target.
  const V low = hn::Set(d, -126.0f), high = hn::Set(d, 126.0f);
  x = IfThenElse(x < low, low, x);
  x = IfThenElse(x > high, high, x);
  const V k = hn::Round(x);
  const V r = x - k;  // [-0.5, 0.5], exact
  // (2^r - 1) / r by interpolation at Chebyshev nodes: relative error 9e-9.
  V p = hn::Set(d, 0.000154531634f);
  p = MulAdd(p, r, 0.00133908633f);
  p = MulAdd(p, r, 0.00961808302f);
  p = MulAdd(p, r, 0.0555035695f);
  p = MulAdd(p, r, 0.240226507f);
  p = MulAdd(p, r, 0.693147182f);
  p = MulAdd(p, r, 1.0f);
  const auto power = hn::ShiftLeft<23>(TruncateToInt(k) + 127);
  return p * hn::BitCast(d, power);
}

// e^x, x clamped so that the result lies in [2^-126, 2^126]. Relative error
// 1e-7 (1 + |x|). NaN gives NaN.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Exp(D d, V x) {
  return Exp2(d, x * 1.44269504f);
}

// log2 of a positive normal x. Error 2e-7 (min(1, |log2 x|) + |log2 x| / 2). Other x give finite
// numbers: 0 and denormals [-127, -126], infinity 128, NaN and negative x anything.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Log2(D d, V x) {
  const hn::RebindToSigned<D> di;
  const auto bits = hn::BitCast(di, x);
  // x = m 2^e with m in [sqrt(1/2), sqrt(2)).
  const auto e = hn::ShiftRight<23>(bits - 0x3f3504f3);
  const V m = hn::BitCast(d, bits - hn::ShiftLeft<23>(e));
  const V one = hn::Set(d, 1.0f);
  const V s = (m - one) / (m + one);
  const V s2 = s * s;
  // 2 atanh(s) / (s ln 2) in s^2, |s| <= 0.1716, at Chebyshev nodes: relative error 1.4e-8.
  V p = hn::Set(d, 0.431717694f);
  p = MulAdd(p, s2, 0.576715171f);
  p = MulAdd(p, s2, 0.961798847f);
  p = MulAdd(p, s2, 2.88539004f);
  return MulAdd(p, s, hn::ConvertTo(d, e));
}

// log2 of a positive normal x without a division, for choosing levels of detail. Absolute error
// 1.1e-4, exact at powers of two. Other x as Log2.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Log2Coarse(D d, V x) {
  const hn::RebindToSigned<D> di;
  const auto bits = hn::BitCast(di, x);
  const auto e = hn::ShiftRight<23>(bits - 0x3f3504f3);
  const V m = hn::BitCast(d, bits - hn::ShiftLeft<23>(e));
  // log2(1 + y) / y on y in [sqrt(1/2) - 1, sqrt(2) - 1], by weighted least squares.
  const V y = m - 1.0f;
  V p = hn::Set(d, -0.3296294f);
  p = MulAdd(p, y, 0.51750935f);
  p = MulAdd(p, y, -0.72490419f);
  p = MulAdd(p, y, 1.4417606f);
  return MulAdd(p, y, hn::ConvertTo(d, e));
}

}  // namespace HWY_NAMESPACE
}  // namespace swell
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
