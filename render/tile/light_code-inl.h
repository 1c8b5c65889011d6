// Light as a byte of a lookup image: all that there is, from night to glints.
//
// c = sqrt(x / (x + 1)) of 0 to 1 is near sqrt(x) in the dark, where the eye sees steps, and never
// full: c = 1 would be infinite light. x = c^2 / (1 - c^2).
#if defined(SWELL_RENDER_TILE_LIGHT_CODE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_LIGHT_CODE_INL_H_
#undef SWELL_RENDER_TILE_LIGHT_CODE_INL_H_
#else
#define SWELL_RENDER_TILE_LIGHT_CODE_INL_H_
#endif

#include "render/tile/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

constexpr float kMostLightCode = 254.0f;  // light of 127

// Radiance as a byte, to the nearest; below 0 counts as 0. Steps are 0.008 sqrt(x) in the dark,
// 0.022 at 1 and 0.26 at 5.
HWY_INLINE VI EncodeLight(V radiance) {
  const V x = hn::Max(radiance, hn::Zero(D()));
  const V c = hn::Sqrt(hn::Div(x, hn::Add(x, Constant(1.0f))));
  const V code = hn::Min(hn::Mul(c, Constant(255.0f)), Constant(kMostLightCode));
  return hn::ConvertTo(DI(), hn::Add(code, Constant(0.5f)));
}

// Radiance of codes in [0, 1], blended ones too; what is over the largest code counts as that. The
// three channels share one division.
HWY_INLINE V3 DecodeLight(V3 code) {
  constexpr float kMost = (kMostLightCode / 255.0f) * (kMostLightCode / 255.0f);
  const V one = Constant(1.0f), most = Constant(kMost);
  const V3 c2 = {hn::Min(hn::Mul(code.x, code.x), most), hn::Min(hn::Mul(code.y, code.y), most),
                 hn::Min(hn::Mul(code.z, code.z), most)};
  const V3 rest = {hn::Sub(one, c2.x), hn::Sub(one, c2.y), hn::Sub(one, c2.z)};
  const V xy = hn::Mul(rest.x, rest.y);
  const V inverse = hn::Div(one, hn::Mul(xy, rest.z));
  const V inverse_z = hn::Mul(inverse, rest.z);  // of x y
  return {hn::Mul(c2.x, hn::Mul(inverse_z, rest.y)), hn::Mul(c2.y, hn::Mul(inverse_z, rest.x)),
          hn::Mul(c2.z, hn::Mul(inverse, xy))};
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
