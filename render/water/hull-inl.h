// What floating hulls do to the water around them.
#if defined(SWELL_RENDER_WATER_HULL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_WATER_HULL_INL_H_
#undef SWELL_RENDER_WATER_HULL_INL_H_
#else
#define SWELL_RENDER_WATER_HULL_INL_H_
#endif

#include "render/tile/shading_result-inl.h"
#include "render/water/foam-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

struct AtHulls {
  V sky_hidden;    // part of the sky's light that hulls keep off
  FoamLayer foam;  // at their waterlines
};

// How far q, relative to a waterline's middle, lies outside it [m]: along the line to the middle of
// a round one; 0 inside.
HWY_INLINE V OutsideWaterline(const Waterline& line, V x, V y) {
  const V zero = hn::Zero(D()), one = Constant(1.0f);
  const auto along = [&](glm::vec2 axis) HWY_ATTR { return Abs(MulAdd(x, axis.x, y * axis.y)); };
  const V a = along(line.right), b = along(line.ahead);
  if (line.is_round) {
    const V radii = Sqrt(MulAdd(a, a, b * b));
    const V length = Sqrt(MulAdd(x, x, y * y));
    const V inside = length / Max(radii, 1e-6f);
    return Max(length - inside, zero);
  }
  const auto beyond = [&](V part, glm::vec2 axis)
                          HWY_ATTR { return Max(part - one, zero) * (1.0f / glm::length(axis)); };
  const V da = beyond(a, line.right), db = beyond(b, line.ahead);
  return Sqrt(MulAdd(da, da, db * db));
}

// All hulls together at points of the water in a span of pixels.
inline HWY_NOINLINE AtHulls SampleHulls(const SunShadow& shadow, const SlopeLayer& lace,
                                        std::span<const std::uint16_t> casters,
                                        const PixelSpan& span, const V3& p, const V& level_m) {
  const D d;
  const V zero = hn::Zero(d), one = Constant(1.0f);
  AtHulls at = {zero, NoFoam()};
  V foam = zero;
  for (const std::uint16_t number : casters) {
    if (!shadow.casters.sea_pixels[number].meets(span)) continue;
    const ShadowCaster& caster = shadow.objects->casters[number];
    const Waterline& line = caster.waterline;
    const V3 q = p + Constant(-line.middle_rel);
    const V far = Max(Max(Abs(q.x), Abs(q.y)), Abs(q.z));
    const auto near = far < caster.near_m;
    if (hn::AllFalse(d, near)) continue;
    const V away = OutsideWaterline(line, q.x, q.y);
    // The form factor of a wall of the freeboard's height, as if the hull went on on both sides;
    // less as it looks narrower.
    const V fading = Clamp(MulAdd(away, -1.0f / ShadowCaster::kContact_m, one), 0.0f, 1.0f);
    const V sine = away / Sqrt(MulAdd(away, away, line.freeboard_m * line.freeboard_m + 1e-6f));
    const V narrow = line.radius_m / (away + line.radius_m);
    const V hidden = (one - sine) * 0.5f * (narrow * fading);
    at.sky_hidden = Max(at.sky_hidden, IfThenElseZero(near, hidden));
    // The ring is broader where the water flows off.
    const V towards = MulAdd(q.x, line.flow.x, q.y * line.flow.y);
    const V leeward = Clamp(towards * (1.0f / line.radius_m), -0.6f, 1.5f);
    const V width = (leeward + one) * line.foam_m;
    const V ring = Clamp(one - away / width, 0.0f, 1.0f);
    foam = Max(foam, IfThenElseZero(near, ring * line.foam));
  }
  if (hn::AllTrue(d, foam == zero)) return at;
  // Thinner towards its rim.
  const V thick = Min(MulAdd(foam, 1.1f, 0.2f), one);
  at.foam.cover = FoamCover(lace, p, level_m, foam) * thick;
  at.foam.thickness = IfThenElseZero(at.foam.cover > zero, one);
  return at;
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
