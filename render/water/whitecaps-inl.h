// Foam of the open sea's breaking waves.
#if defined(SWELL_RENDER_WATER_WHITECAPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_WATER_WHITECAPS_INL_H_
#undef SWELL_RENDER_WATER_WHITECAPS_INL_H_
#else
#define SWELL_RENDER_WATER_WHITECAPS_INL_H_
#endif

#include "ocean/open_sea/foam_on_crest.h"
#include "render/water/foam-inl.h"
#include "render/water/foam_map-inl.h"
#include "render/water/whitecaps.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// Levels of a lace's map at which its cells begin to melt, and are gone.
constexpr float kCellsMelt = 1.0f, kCellsGone = 3.5f;

// How much of a lace is seen in pixels of that size, in [0, 1].
HWY_INLINE V LaceSeen(const FoamLace& lace, V level_m) {
  const V left = kCellsGone - lace.log2_texels_per_m - level_m;
  return Clamp(left * (1.0f / (kCellsGone - kCellsMelt)), 0.0f, 1.0f);
}

// Two thresholds of foam in [0, 1], spread evenly.
struct Thresholds {
  V lace, tears;
};

HWY_INLINE Thresholds SampleLace(const FoamLace& lace, V3 p, V level_m) {
  const D d;
  const V half = Constant(0.5f);
  const V level = level_m + (lace.log2_texels_per_m + 0.5f);
  const V x = MulAdd(p.x, lace.x_fx8_per_m.x, MulAdd(p.y, lace.x_fx8_per_m.y, lace.x_eye_fx8));
  const V y = MulAdd(p.x, lace.y_fx8_per_m.x, MulAdd(p.y, lace.y_fx8_per_m.y, lace.y_eye_fx8));
  V lace_code, tears_code;
  texture::HWY_NAMESPACE::SampleLevel(d, *lace.map, RoundToInt(x), RoundToInt(y),
                                      TruncateToInt(Clamp(level, 0.0f, kCellsGone)), lace_code,
                                      tears_code);
  return {MulAdd(lace_code, half, half), MulAdd(tears_code, half, half)};
}

// Where the laces' place p was before eddies bent them, or they would lie in straight lines.
HWY_INLINE V3 BendLace(const Whitecaps& material, V3 p, V level_m) {
  constexpr float kMostBend_m = 1.4f;
  const V half = Constant(0.5f), scale = Constant(2.0f * kMostBend_m);
  const Thresholds eddies = SampleLace(material.eddies, p, level_m);
  p.x = MulAdd(eddies.lace - half, scale, p.x);
  p.y = MulAdd(eddies.tears - half, scale, p.y);
  return p;
}

// The sum of two thresholds as one that is itself spread evenly: the distribution of the sum.
HWY_INLINE V JoinThresholds(V a, V b) {
  const V sum = a + b, rest = 2.0f - sum;
  const V half = Constant(0.5f), one = Constant(1.0f);
  return IfThenElse(sum < one, sum * sum * half, NegMulAdd(rest * rest, half, one));
}

// The part of thresholds b, spread evenly, with which foam is over the sum of both.
HWY_INLINE V CoverOfJoined(V foam, V a) {
  const V two = Constant(2.0f), less = foam + foam, more = two - less;
  const V root = Sqrt(Max(Min(less, more), 0.0f));
  const V sum = IfThenElse(less < more, root, two - root);
  return Clamp(sum - a, 0.0f, 1.0f);
}

// The part of a pixel that foam hides: in the mean over thresholds it is `foam`, exactly.
HWY_INLINE V CoverOf(V foam, V threshold) {
  constexpr float kRim = 0.3f;  // width of a bubble's rim, as a threshold
  // Rims are narrow where they would reach beyond 0 or 1.
  const V room = Min(foam, 1.0f - foam);
  const V width = Max(Min(room + room, kRim), 1e-3f);
  return Clamp((foam - threshold) / width + 0.5f, 0.0f, 1.0f);
}

// As ocean::foam_on_crest().
HWY_INLINE V OnCrests(const Whitecaps& material, V height_m) {
  const V part = MulAdd(height_m, material.crest_per_m, 1.0f);
  return Clamp(part, 2.0f - ocean::kMostOnCrest, ocean::kMostOnCrest);
}

// Whitecaps of a coast's trains at a packet, what these leave of short waves' in shallow water, and
// what land takes of all.
struct CoastWhitecaps {
  V on_trains, short_part, taken;
};

HWY_INLINE CoastWhitecaps NoCoastWhitecaps() {
  const V zero = hn::Zero(D());
  return {zero, Constant(1.0f), zero};
}

// The part of the surface that is white at p, height_m over the mean level, but for its lace.
// long_foam: the longest patch's and the trains'.
HWY_INLINE V WhitecapsAt(const Whitecaps& material, V long_foam, V3 p, V height_m, V level_m,
                         const CoastWhitecaps& coast) {
  if (material.count == 0) return hn::Zero(D());
  const V one = Constant(1.0f);
  V free = one - long_foam;
  if (material.count > 1) {
    const V foam = FoamOfMap(material.foam[1], p, level_m);
    const V on_crest = Min(foam * OnCrests(material, height_m), one) * coast.short_part;
    free = NegMulAdd(on_crest, free, free);
  }
  return (one - free) * (one - coast.taken);
}

// Foam is as thick as it is over its threshold, so that lace and tears go on inside what is white
// all over; from far it has the mean of that.
HWY_INLINE FoamLayer TearWhitecaps(const Whitecaps& material, V3 p, V level_m, V foam) {
  const D d;
  const V zero = hn::Zero(d);
  const auto some = foam > material.least;
  if (hn::AllFalse(d, some)) return NoFoam();
  V cover = foam, thickness = foam * 0.5f;
  // Where it is 0 the blends below change no bit, whatever the lanes beside show.
  const V seen = IfThenElseZero(some, LaceSeen(material.tears, level_m));
  if (!hn::AllTrue(d, seen == zero)) {
    const V3 at = BendLace(material, p, level_m);
    const V tears = SampleLace(material.tears, at, level_m).tears;
    // Lace too fine to be seen leaves tears soft.
    V torn = CoverOfJoined(foam, tears), lace = Constant(0.5f);
    const V lace_seen = LaceSeen(material.lace, level_m);
    if (!hn::AllTrue(d, lace_seen == zero)) {
      lace = Lerp(lace, SampleLace(material.lace, at, level_m).lace, lace_seen);
      torn = Lerp(torn, CoverOf(foam, JoinThresholds(tears, lace)), lace_seen);
    }
    cover = Lerp(foam, torn, seen);
    thickness = Lerp(thickness, Max(foam - JoinThresholds(tears, lace), zero), seen);
  }
  return {IfThenElseZero(some, cover), IfThenElseZero(some, thickness), IfThenElseZero(some, foam)};
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
