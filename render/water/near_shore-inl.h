// What a shore does to the sea before it, a packet at a time.
#if defined(SWELL_RENDER_WATER_NEAR_SHORE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_WATER_NEAR_SHORE_INL_H_
#undef SWELL_RENDER_WATER_NEAR_SHORE_INL_H_
#else
#define SWELL_RENDER_WATER_NEAR_SHORE_INL_H_
#endif

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

// Sine and cosine of a lag's turns.
struct AlongShore {
  V sine, cosine;
};
HWY_INLINE AlongShore FindAlong(glm::vec3 lag, V3 p) {
  const V turns = MulAdd(p.x, lag.x, MulAdd(p.y, lag.y, lag.z));
  AlongShore along;
  SinCosTurns(D(), turns, along.sine, along.cosine);
  return along;
}

// Foam of the fronts where `part` of their reach is left to the shore and land leaves `kept` of the
// waves: the lower waves are, the nearer to the shore they break.
HWY_INLINE V FrontFoam(const SurfFronts& fronts, V3 p, V part, V kept, V level_m) {
  const D d;
  const V zero = hn::Zero(d), one = Constant(1.0f);
  const V seaward = Max(part, zero);
  const V zone = SmoothBlend(Clamp(NegMulAdd(seaward / Max(kept, 0.1f), 1.5f, 1.5f), 0.0f, 1.0f));
  const V strength = zone * Clamp(MulAdd(kept, 2.0f, -0.3f), 0.0f, 1.0f);
  if (hn::AllFalse(d, strength > zero)) return zero;
  const AlongShore a = FindAlong(fronts.lag_a, p), b = FindAlong(fronts.lag_b, p),
                   c = FindAlong(fronts.lag_c, p);
  const V turns = MulAdd(Sqrt(seaward), fronts.reach_turns, fronts.cycles);
  // Which of the slow waves along the shore delay a front, and where it is high.
  const V lag[kSurfFronts] = {a.sine, b.sine, a.cosine, b.cosine};
  const V high[kSurfFronts] = {b.sine + c.cosine, a.cosine - c.sine, c.sine - b.cosine,
                               -a.sine - c.cosine};
  V foam = zero, mean = zero;
  for (int n = 0; n < kSurfFronts; ++n) {
    const V phase = MulAdd(lag[n], 0.06f, turns) + 0.25f * static_cast<float>(n);
    const V past = phase - Floor(phase);  // since the front was there, in [0, 1)
    const V height = Clamp(MulAdd(high[n], 0.35f, 0.65f), 0.0f, 1.0f);
    const V comes = Min(past * 30.0f, one);
    const V left = Max(NegMulAdd(past, fronts.drain, one), zero);
    const V shape = comes * (left * left);
    foam = Max(foam, height * shape);
    mean = MulAdd(height, fronts.mean, mean);
  }
  const V seen = Clamp(fronts.level_lost - level_m, 0.0f, 1.0f);
  return strength * Lerp(mean, foam, seen);
}

// What the near shore's map says of a packet; all 0 outside it.
struct NearShoreAt {
  hn::Mask<D> inside;
  V taken;  // of the open sea's waves, in [0, 1]
  V foam;   // of surf fronts
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

HWY_INLINE NearShoreAt SampleNearShore(const NearShore& near, V3 p, V level_m) {
  const D d;
  const V zero = hn::Zero(d);
  const LayerPlace place = PlaceIn(near.map, p.x, p.y);
  NearShoreAt at = {IsInside(near.map, place), zero, zero};
  if (hn::AllFalse(d, at.inside)) return at;
  V taken, part;
  SampleNearest(near.map, place, level_m - 0.5f, taken, part);
  at.taken = IfThenElseZero(at.inside, taken * near.taken_gain);
  if (!near.fronts.on) return at;
  const auto is_surf = at.inside & (part < 0.995f);
  if (hn::AllFalse(d, is_surf)) return at;
  const V kept = 1.0f - taken;
  at.foam = IfThenElseZero(is_surf, FrontFoam(near.fronts, p, part, kept, level_m));
  return at;
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
