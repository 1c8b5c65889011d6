// What a shore does to the sea before it, a packet at a time.
#if defined(SWELL_RENDER_MATERIALS_NEAR_SHORE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_NEAR_SHORE_INL_H_
#undef SWELL_RENDER_MATERIALS_NEAR_SHORE_INL_H_
#else
#define SWELL_RENDER_MATERIALS_NEAR_SHORE_INL_H_
#endif

#include "render/materials/near_shore.h"
#include "render/tile/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// Whether a place is in a layer's square.
HWY_INLINE hn::Mask<D> IsInside(const SlopeLayer& layer, const LayerPlace& place) {
  const V low = hn::Zero(D()),
          high = Constant(0.999f * 256.0f * static_cast<float>(layer.map->size));
  return hn::And(hn::And(hn::Gt(place.x_fx8, low), hn::Gt(place.y_fx8, low)),
                 hn::And(hn::Lt(place.x_fx8, high), hn::Lt(place.y_fx8, high)));
}

// Sine and cosine of a lag's turns.
struct AlongShore {
  V sine, cosine;
};
HWY_INLINE AlongShore FindAlong(glm::vec3 lag, V3 p) {
  const V turns =
      hn::MulAdd(p.x, Constant(lag.x), hn::MulAdd(p.y, Constant(lag.y), Constant(lag.z)));
  AlongShore along;
  SinCosTurns(D(), turns, along.sine, along.cosine);
  return along;
}

// Foam of the fronts where `part` of their reach is left to the shore and land leaves `kept` of the
// waves: the lower waves are, the nearer to the shore they break.
HWY_INLINE V FrontFoam(const SurfFronts& fronts, V3 p, V part, V kept, V level_m) {
  const D d;
  const V zero = hn::Zero(d), one = Constant(1.0f);
  const V seaward = hn::Max(part, zero);
  const V zone = SmoothBlend(Clamp(hn::NegMulAdd(hn::Div(seaward, hn::Max(kept, Constant(0.1f))),
                                                 Constant(1.5f), Constant(1.5f)),
                                   0.0f, 1.0f));
  const V strength =
      hn::Mul(zone, Clamp(hn::MulAdd(kept, Constant(2.0f), Constant(-0.3f)), 0.0f, 1.0f));
  if (hn::AllFalse(d, hn::Gt(strength, zero))) return zero;
  const AlongShore a = FindAlong(fronts.lag_a, p), b = FindAlong(fronts.lag_b, p),
                   c = FindAlong(fronts.lag_c, p);
  const V turns =
      hn::MulAdd(hn::Sqrt(seaward), Constant(fronts.reach_turns), Constant(fronts.cycles));
  // Which of the slow waves along the shore delay a front, and where it is high.
  const V lag[kSurfFronts] = {a.sine, b.sine, a.cosine, b.cosine};
  const V high[kSurfFronts] = {hn::Add(b.sine, c.cosine), hn::Sub(a.cosine, c.sine),
                               hn::Sub(c.sine, b.cosine), hn::Sub(hn::Neg(a.sine), c.cosine)};
  V foam = zero, mean = zero;
  for (int n = 0; n < kSurfFronts; ++n) {
    const V phase = hn::Add(hn::MulAdd(lag[n], Constant(0.06f), turns),
                            Constant(0.25f * static_cast<float>(n)));
    const V past = hn::Sub(phase, hn::Floor(phase));  // since the front was there, in [0, 1)
    const V height = Clamp(hn::MulAdd(high[n], Constant(0.35f), Constant(0.65f)), 0.0f, 1.0f);
    const V comes = hn::Min(hn::Mul(past, Constant(30.0f)), one);
    const V left = hn::Max(hn::NegMulAdd(past, Constant(fronts.drain), one), zero);
    const V shape = hn::Mul(comes, hn::Mul(left, left));
    foam = hn::Max(foam, hn::Mul(height, shape));
    mean = hn::MulAdd(height, Constant(fronts.mean), mean);
  }
  const V seen = Clamp(hn::Sub(Constant(fronts.level_lost), level_m), 0.0f, 1.0f);
  return hn::Mul(strength, Lerp(mean, foam, seen));
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
  SampleNearest(near.map, place, hn::Sub(level_m, Constant(0.5f)), taken, unused);
  const V kept = hn::Max(hn::Sub(one, taken), Constant(0.02f));
  return hn::IfThenElse(IsInside(near.map, place), kept, one);
}

HWY_INLINE NearShoreAt SampleNearShore(const NearShore& near, V3 p, V level_m) {
  const D d;
  const V zero = hn::Zero(d);
  const LayerPlace place = PlaceIn(near.map, p.x, p.y);
  NearShoreAt at = {IsInside(near.map, place), zero, zero};
  if (hn::AllFalse(d, at.inside)) return at;
  V taken, part;
  SampleNearest(near.map, place, hn::Sub(level_m, Constant(0.5f)), taken, part);
  at.taken = hn::IfThenElseZero(at.inside, hn::Mul(taken, Constant(near.taken_gain)));
  if (!near.fronts.on) return at;
  const auto is_surf = hn::And(at.inside, hn::Lt(part, Constant(0.995f)));
  if (hn::AllFalse(d, is_surf)) return at;
  const V kept = hn::Sub(Constant(1.0f), taken);
  at.foam = hn::IfThenElseZero(is_surf, FrontFoam(near.fronts, p, part, kept, level_m));
  return at;
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
