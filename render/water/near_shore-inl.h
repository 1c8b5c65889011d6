// What a shore does to the sea before it, a packet at a time.
#if defined(SWELL_RENDER_WATER_NEAR_SHORE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_WATER_NEAR_SHORE_INL_H_
#undef SWELL_RENDER_WATER_NEAR_SHORE_INL_H_
#else
#define SWELL_RENDER_WATER_NEAR_SHORE_INL_H_
#endif

#include "ocean/coast/front_function-inl.h"
#include "render/packets/packet-inl.h"
#include "render/water/near_shore.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// Whether a place is in a layer's square.
HWY_INLINE hn::Mask<D> IsInside(const SlopeLayer& layer, const LayerPlace& place) {
  const V low = hn::Zero(D()),
          high = Constant(0.999f * 256.0f * static_cast<float>(layer.map->size));
  return ((place.x_fx8 > low) & (place.y_fx8 > low)) &
         ((place.x_fx8 < high) & (place.y_fx8 < high));
}

// How much of the fronts pixels of this footprint show.
HWY_INLINE V FrontsSeen(const SurfFronts& fronts, V level_m) {
  return Clamp(fronts.level_lost - level_m, 0.0f, 1.0f);
}

// How much foam fronts have where `part` of their reach is left to the shore and land leaves `kept`
// of the waves: the lower waves are, the nearer to the shore they break.
HWY_INLINE V FoamStrength(V seaward, V kept) {
  const V zone = SmoothBlend(Clamp(NegMulAdd(seaward / Max(kept, 0.1f), 1.5f, 1.5f), 0.0f, 1.0f));
  return zone * Clamp(MulAdd(kept, 2.0f, -0.3f), 0.0f, 1.0f);
}

HWY_INLINE V FoamOfFronts(const SurfFronts& fronts, const ocean::HWY_NAMESPACE::Fronts& at,
                          V strength, V level_m) {
  V foam = hn::Zero(D()), mean = foam;
  for (int n = 0; n < ocean::kSurfFronts; ++n) {
    const V shape = ocean::HWY_NAMESPACE::FoamOfFront(at.past[n], fronts.drain);
    foam = Max(foam, at.height[n] * shape);
    mean = MulAdd(at.height[n], fronts.mean, mean);
  }
  return strength * Lerp(mean, foam, FrontsSeen(fronts, level_m));
}

HWY_INLINE V FrontFoam(const SurfFronts& fronts, V3 p, V part, V kept, V level_m) {
  const D d;
  const V zero = hn::Zero(d);
  const V seaward = Max(part, zero);
  const V strength = FoamStrength(seaward, kept);
  if (hn::AllFalse(d, strength > zero)) return zero;
  return FoamOfFronts(fronts, ocean::HWY_NAMESPACE::FindFronts(fronts, p.x, p.y, seaward), strength,
                      level_m);
}

// Fronts that lift the water, at a packet; all 0 where they do not.
struct FrontsAt {
  V ceded;  // of the sea's waves, to the fronts
  V slope_x, slope_y, variance;
  V foam;
};

HWY_INLINE FrontsAt NoFronts() {
  const V zero = hn::Zero(D());
  return {zero, zero, zero, zero, zero};
}

// The mean square of the front function's rate by turns, on the narrowest face.
constexpr float kMeanSquareRate = 58.0f;

// inside: lanes in the near shore's square.
HWY_INLINE FrontsAt SampleFronts(const SurfFronts& fronts, V3 p, V kept, hn::Mask<D> inside,
                                 V level_m) {
  const D d;
  const V zero = hn::Zero(d), one = Constant(1.0f);
  V root, height, east, north;
  const LayerPlace place = PlaceIn(fronts.lift, p.x, p.y);
  SampleNearest(fronts.lift, place, level_m - 0.5f, root, height);
  const V seaward = Max(root, zero), part = ocean::kFrontsFrom * seaward * seaward;
  const V share = hn::IfThenElseZero(inside, ocean::HWY_NAMESPACE::ShareOfFronts(part, kept));
  FrontsAt at = NoFronts();
  if (hn::AllFalse(d, share > zero)) return at;
  at.ceded = one - Sqrt(Max(NegMulAdd(share, share, one), zero));
  SampleNearest(fronts.seaward, place, level_m - 0.5f, east, north);
  // The slope of the part, and of turns with it: turns = reach_turns sqrt(part).
  const V by_part = Constant(0.5f * fronts.reach_turns) / Sqrt(Max(part, 1e-3f));
  const V height_m = hn::IfThenElseZero(inside, Max(height, zero) * fronts.lift_m);
  const auto found = ocean::HWY_NAMESPACE::FindFronts(fronts, p.x, p.y, part);
  const auto lift = ocean::HWY_NAMESPACE::LiftOfFronts(found, part);
  const V rate =
      MulAdd(lift.by_turns, by_part, lift.by_width * ocean::HWY_NAMESPACE::FaceOfFronts(part).rate);
  const V seen = FrontsSeen(fronts, level_m);
  const V slope = height_m * rate * seen * fronts.per_reach_m;
  at.slope_x = slope * east;
  at.slope_y = slope * north;
  const V steep = height_m * by_part * fronts.per_reach_m;
  at.variance = NegMulAdd(seen, seen, one) * steep * steep * kMeanSquareRate;
  at.foam =
      hn::IfThenElseZero(inside, FoamOfFronts(fronts, found, FoamStrength(part, kept), level_m));
  return at;
}

// What the near shore's map says of a packet; all 0 outside it.
struct NearShoreAt {
  hn::Mask<D> inside;
  V taken;          // of the open sea's waves, in [0, 1]
  V foam;           // of surf fronts
  FrontsAt fronts;  // that lift the water
};

// What land leaves of the waves, for what divides by it: at least a fiftieth.
HWY_INLINE V KeptBeside(const NearShore& near, V3 p, V level_m) {
  const V one = Constant(1.0f);
  if (!near.map.map || near.taken_gain == 0.0f) return one;
  const LayerPlace place = PlaceIn(near.map, p.x, p.y);
  V taken, unused;
  SampleNearest(near.map, place, level_m - 0.5f, taken, unused);
  const V kept = Max(one - taken, 0.02f);
  return IfThenElse(IsInside(near.map, place), kept, one);
}

// left: what other foam and waves leave of these; fronts that do not lift the water are not looked
// for where it is 0.
HWY_INLINE NearShoreAt SampleNearShore(const NearShore& near, V3 p, V level_m, V left) {
  const D d;
  const V zero = hn::Zero(d);
  const LayerPlace place = PlaceIn(near.map, p.x, p.y);
  NearShoreAt at = {IsInside(near.map, place), zero, zero, NoFronts()};
  if (hn::AllFalse(d, at.inside)) return at;
  V taken, part;
  SampleNearest(near.map, place, level_m - 0.5f, taken, part);
  at.taken = IfThenElseZero(at.inside, taken * near.taken_gain);
  if (!near.fronts.on) return at;
  if (near.fronts.lifts()) {
    at.fronts = SampleFronts(near.fronts, p, 1.0f - taken, at.inside, level_m);
    at.foam = at.fronts.foam;
    return at;
  }
  const auto is_surf = at.inside & (part < 0.995f) & (left > 0.0f);
  if (hn::AllFalse(d, is_surf)) return at;
  const V kept = 1.0f - taken;
  at.foam = IfThenElseZero(is_surf, FrontFoam(near.fronts, p, part, kept, level_m));
  return at;
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
