// Foam on broken waves and on the sheets of water that they send up the beach.
#if defined(SWELL_RENDER_WATER_FOAM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_WATER_FOAM_INL_H_
#undef SWELL_RENDER_WATER_FOAM_INL_H_
#else
#define SWELL_RENDER_WATER_FOAM_INL_H_
#endif

#include "render/tile/sun_shadow-inl.h"
#include "render/water/foam.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

constexpr float kFoamRim = 0.3f;  // width of a bubble's rim, as a threshold

// How far foam in [0, 1] is over the threshold of its lace: hidden is what is kFoamRim over it. 0
// for less foam than a fiftieth, at least kFoamRim for 1.
HWY_INLINE V FoamOver(const Foam& material, V3 p, V level_m, V foam) {
  const D d;
  const auto some = foam > 0.02f;
  if (hn::AllFalse(d, some)) return hn::Zero(d);
  // A step between two mip levels is no wider than the lace's own irregularity.
  V code, unused;
  NearestSlopes(material.pattern, p, level_m, code, unused);
  const V threshold = MulAdd(code, 0.5f, 0.5f);
  return IfThenElseZero(some, MulSub(foam, 1.0f + kFoamRim, threshold));
}

HWY_INLINE V CoverOfOver(V over) { return Clamp(over * (1.0f / kFoamRim), 0.0f, 1.0f); }

// The part of a packet's pixels that foam hides.
HWY_INLINE V FoamCover(const Foam& material, V3 p, V level_m, V foam) {
  return CoverOfOver(FoamOver(material, p, level_m, foam));
}

// seen: by the foam.
HWY_INLINE V3 AddFoam(const Foam& material, V cover, const LightSeen& seen, V3 light) {
  const V3 foam =
      MulAdd(Constant(material.sun_light), seen.sun, Constant(material.sky_light) * seen.ambient);
  return Lerp(light, foam, cover * 0.92f);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
