// Light as a byte of a planar map: all that there is, from night to glints.
//
// c = sqrt(x / (x + 1)) of 0 to 1 is near sqrt(x) in the dark, where the eye sees steps, and never
// full: c = 1 would be infinite light. x = c^2 / (1 - c^2).
#if defined(SWELL_RENDER_TILE_LIGHT_CODE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_LIGHT_CODE_INL_H_
#undef SWELL_RENDER_TILE_LIGHT_CODE_INL_H_
#else
#define SWELL_RENDER_TILE_LIGHT_CODE_INL_H_
#endif

#include "render/packets/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

constexpr float kMostLightCode = 254.0f;  // light of 127

// Radiance as a byte, to the nearest; below 0 counts as 0. Steps are 0.008 sqrt(x) in the dark,
// 0.022 at 1 and 0.26 at 5.
HWY_INLINE VI EncodeLight(V radiance) {
  const V x = Max(radiance, 0.0f);
  const V c = Sqrt(x / (x + 1.0f));
  const V code = Min(c * 255.0f, kMostLightCode);
  return TruncateToInt(code + 0.5f);
}

// Radiance of codes in [0, 1], blended ones too; what is over the largest code counts as that. The
// three channels share one division.
HWY_INLINE V3 DecodeLight(V3 code) {
  constexpr float kMost = (kMostLightCode / 255.0f) * (kMostLightCode / 255.0f);
  const V one = Constant(1.0f), most = Constant(kMost);
  const V3 c2 = {Min(code.x * code.x, most), Min(code.y * code.y, most),
                 Min(code.z * code.z, most)};
  const V3 rest = {one - c2.x, one - c2.y, one - c2.z};
  const V xy = rest.x * rest.y;
  const V inverse = one / (xy * rest.z);
  const V inverse_z = inverse * rest.z;  // of x y
  return {c2.x * (inverse_z * rest.y), c2.y * (inverse_z * rest.x), c2.z * (inverse * xy)};
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
