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

HWY_BEFORE_NAMESPACE();
namespace swell {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// sin and cos of 2 pi x. |x| < 2^22. Absolute error 2e-7.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void SinCosTurns(D d, V x, V& sin_out, V& cos_out) {
  const hn::RebindToSigned<D> di;
  // x = whole turns + quarter / 4 + f, exactly, |f| <= 1/8.
  const V r = hn::Sub(x, hn::Round(x));
  const V quarter = hn::Round(hn::Mul(r, hn::Set(d, 4.0f)));
  const V f = hn::NegMulAdd(quarter, hn::Set(d, 0.25f), r);
  const V f2 = hn::Mul(f, f);
  // Taylor series of sin(2 pi f) / f and cos(2 pi f) in f^2.
  V s = hn::Set(d, 42.058693f);
  s = hn::MulAdd(s, f2, hn::Set(d, -76.705859f));
  s = hn::MulAdd(s, f2, hn::Set(d, 81.605249f));
  s = hn::MulAdd(s, f2, hn::Set(d, -41.341702f));
  s = hn::MulAdd(s, f2, hn::Set(d, 6.2831853f));
  s = hn::Mul(s, f);
  V c = hn::Set(d, -26.426257f);
  c = hn::MulAdd(c, f2, hn::Set(d, 60.244641f));
  c = hn::MulAdd(c, f2, hn::Set(d, -85.456817f));
  c = hn::MulAdd(c, f2, hn::Set(d, 64.939394f));
  c = hn::MulAdd(c, f2, hn::Set(d, -19.739209f));
  c = hn::MulAdd(c, f2, hn::Set(d, 1.0f));
  // Quarter turns: odd ones swap, 1 and 2 negate the cosine, 2 and 3 the sine.
  const auto q = hn::ConvertTo(di, quarter);
  const auto odd = hn::MaskFromVec(
      hn::BitCast(d, hn::Neg(hn::And(q, hn::Set(di, 1)))));
  const auto two = hn::Set(di, 2);
  const auto sin_sign = hn::ShiftLeft<30>(hn::And(q, two));
  const auto cos_sign = hn::ShiftLeft<30>(hn::And(hn::Add(q, hn::Set(di, 1)), two));
  sin_out = hn::Xor(hn::IfThenElse(odd, c, s), hn::BitCast(d, sin_sign));
  cos_out = hn::Xor(hn::IfThenElse(odd, s, c), hn::BitCast(d, cos_sign));
}

// 2^x, x clamped to [-126, 126]. Relative error 3e-7.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Exp2(D d, V x) {
  const hn::RebindToSigned<D> di;
  x = hn::Min(hn::Max(x, hn::Set(d, -126.0f)), hn::Set(d, 126.0f));
  const V k = hn::Round(x);
  const V r = hn::Sub(x, k);  // [-0.5, 0.5], exact
  V p = hn::Set(d, 1.5403530e-4f);
  p = hn::MulAdd(p, r, hn::Set(d, 1.3333558e-3f));
  p = hn::MulAdd(p, r, hn::Set(d, 9.6181291e-3f));
  p = hn::MulAdd(p, r, hn::Set(d, 5.5504109e-2f));
  p = hn::MulAdd(p, r, hn::Set(d, 2.4022651e-1f));
  p = hn::MulAdd(p, r, hn::Set(d, 6.9314718e-1f));
  p = hn::MulAdd(p, r, hn::Set(d, 1.0f));
  const auto power = hn::ShiftLeft<23>(hn::Add(hn::ConvertTo(di, k), hn::Set(di, 127)));
  return hn::Mul(p, hn::BitCast(d, power));
}

// e^x, x clamped so that the result lies in [2^-126, 2^126]. Relative error 3e-7 (1 + |x|).
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Exp(D d, V x) {
  return Exp2(d, hn::Mul(x, hn::Set(d, 1.44269504f)));
}

// log2 of a positive normal x. Absolute error 2e-6.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Log2(D d, V x) {
  const hn::RebindToSigned<D> di;
  const auto bits = hn::BitCast(di, x);
  // x = m 2^e with m in [sqrt(1/2), sqrt(2)).
  const auto e = hn::ShiftRight<23>(hn::Sub(bits, hn::Set(di, 0x3f3504f3)));
  const V m = hn::BitCast(d, hn::Sub(bits, hn::ShiftLeft<23>(e)));
  const V one = hn::Set(d, 1.0f);
  const V s = hn::Div(hn::Sub(m, one), hn::Add(m, one));
  const V s2 = hn::Mul(s, s);
  // 2 atanh(s) / ln 2, |s| <= 0.1716.
  V p = hn::Set(d, 0.41219858f);
  p = hn::MulAdd(p, s2, hn::Set(d, 0.57707802f));
  p = hn::MulAdd(p, s2, hn::Set(d, 0.96179669f));
  p = hn::MulAdd(p, s2, hn::Set(d, 2.8853901f));
  return hn::MulAdd(p, s, hn::ConvertTo(d, e));
}

}  // namespace HWY_NAMESPACE
}  // namespace swell
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
