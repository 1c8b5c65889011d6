// Fresnel's reflectance of a dielectric on Highway vectors.
#if defined(SWELL_RENDER_PACKETS_FRESNEL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_PACKETS_FRESNEL_INL_H_
#undef SWELL_RENDER_PACKETS_FRESNEL_INL_H_
#else
#define SWELL_RENDER_PACKETS_FRESNEL_INL_H_
#endif

#include <hwy/highway.h>

#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

// Unpolarised reflectance for light that meets a medium of relative index n >= 1 at angle theta to
// the normal; cos_theta is clamped to [0, 1]. Absolute error 1e-6.
// Source: Cook and Torrance, A Reflectance Model for Computer Graphics, 1982, with
// g^2 = n^2 - 1 + c^2: R = 1/2 ((g-c)/(g+c))^2 (1 + ((c(g+c)-1)/(c(g-c)+1))^2),
// here as one quotient.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V FresnelReflectance(D d, V cos_theta, float n) {
  const V one = hn::Set(d, 1.0f);
  const V c = Min(Max(cos_theta, 0.0f), one);
  const V g = Sqrt(MulAdd(c, c, n * n - 1.0f));
  const V minus = g - c, plus = g + c;
  const V s = MulSub(c, plus, one), t = MulAdd(c, minus, one);
  const V minus_t = minus * t, minus_s = minus * s, plus_t = plus * t;
  const V numerator = MulAdd(minus_t, minus_t, minus_s * minus_s);
  return numerator * 0.5f / (plus_t * plus_t);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
