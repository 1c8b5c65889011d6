// Fresnel's reflectance of a dielectric on Highway vectors.
#if defined(SWELL_RENDER_MATERIALS_FRESNEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_FRESNEL_INL_H_
#undef SWELL_RENDER_MATERIALS_FRESNEL_INL_H_
#else
#define SWELL_RENDER_MATERIALS_FRESNEL_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Unpolarised reflectance for light that meets a medium of relative index n >= 1 at angle theta to
// the normal; cos_theta is clamped to [0, 1]. Absolute error 1e-6.
// Source: Cook and Torrance, A Reflectance Model for Computer Graphics, 1982, with
// g^2 = n^2 - 1 + c^2: R = 1/2 ((g-c)/(g+c))^2 (1 + ((c(g+c)-1)/(c(g-c)+1))^2),
// here as one quotient.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V FresnelReflectance(D d, V cos_theta, float n) {
  const V one = hn::Set(d, 1.0f);
  const V c = hn::Min(hn::Max(cos_theta, hn::Zero(d)), one);
  const V g = hn::Sqrt(hn::MulAdd(c, c, hn::Set(d, n * n - 1.0f)));
  const V minus = hn::Sub(g, c), plus = hn::Add(g, c);
  const V s = hn::MulSub(c, plus, one), t = hn::MulAdd(c, minus, one);
  const V minus_t = hn::Mul(minus, t), minus_s = hn::Mul(minus, s), plus_t = hn::Mul(plus, t);
  const V numerator = hn::MulAdd(minus_t, minus_t, hn::Mul(minus_s, minus_s));
  return hn::Div(hn::Mul(numerator, hn::Set(d, 0.5f)), hn::Mul(plus_t, plus_t));
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
