// Foam at a packet's pixels, of whatever source, and the light that it sends back.
#if defined(SWELL_RENDER_WATER_FOAM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_WATER_FOAM_INL_H_
#undef SWELL_RENDER_WATER_FOAM_INL_H_
#else
#define SWELL_RENDER_WATER_FOAM_INL_H_
#endif

#include "ocean/coast/foam_lace.h"
#include "render/tile/sun_shadow-inl.h"
#include "render/water/foam.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// The part of a packet's pixels that foam hides, how thick it is there, and how many bubbles the
// water has between and around it; all in [0, 1].
struct FoamLayer {
  V cover, thickness, bubbles;
};

HWY_INLINE FoamLayer NoFoam() {
  const V zero = hn::Zero(D());
  return {zero, zero, zero};
}

// Foam of two sources.
HWY_INLINE FoamLayer Join(const FoamLayer& a, const FoamLayer& b) {
  return {Max(a.cover, b.cover), Max(a.thickness, b.thickness), Max(a.bubbles, b.bubbles)};
}

using ocean::kFoamRim;

// How far foam in [0, 1] is over the threshold of its lace: hidden is what is kFoamRim over it. 0
// for less foam than a fiftieth, at least kFoamRim for 1.
HWY_INLINE V FoamOver(const SlopeLayer& lace, V3 p, V level_m, V foam) {
  const D d;
  const auto some = foam > 0.02f;
  if (hn::AllFalse(d, some)) return hn::Zero(d);
  // A step between two mip levels is no wider than the lace's own irregularity.
  V code, unused;
  NearestSlopes(lace, p, level_m, code, unused);
  const V threshold = MulAdd(code, 0.5f, 0.5f);
  return IfThenElseZero(some, MulSub(foam, 1.0f + kFoamRim, threshold));
}

HWY_INLINE V CoverOfOver(V over) { return Clamp(over * (1.0f / kFoamRim), 0.0f, 1.0f); }

// The part of a packet's pixels that foam hides.
HWY_INLINE V FoamCover(const SlopeLayer& lace, V3 p, V level_m, V foam) {
  return CoverOfOver(FoamOver(lace, p, level_m, foam));
}

// Foam so far over its threshold.
HWY_INLINE FoamLayer FoamOfOver(V over) {
  return {CoverOfOver(over), Clamp(over, 0.0f, 1.0f), hn::Zero(D())};
}

// Water of radiance `light` under foam, which the sun's light meets at an angle of that cosine and
// which sees so much of sun and sky.
HWY_INLINE V3 AddFoam(const FoamLight& material, const FoamOpacity& opacity, const FoamLayer& foam,
                      V cos_sun, const LightSeen& seen, V3 light) {
  const D d;
  if (hn::AllFalse(d, Max(foam.cover, foam.bubbles) > hn::Zero(d))) return light;
  const V3 white =
      MulAdd(Constant(material.sun), cos_sun * seen.sun, Constant(material.sky) * seen.ambient);
  const V3 bubbly = {white.x * material.bubbles.x, white.y * material.bubbles.y,
                     white.z * material.bubbles.z};
  const V3 between = Lerp(light, bubbly, foam.bubbles * opacity.bubbles);
  return Lerp(between, white,
              foam.cover * MulAdd(foam.thickness, opacity.by_thickness, opacity.thin));
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
