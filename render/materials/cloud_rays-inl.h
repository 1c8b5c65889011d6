// Follows rays through what scatters light.
#if defined(SWELL_RENDER_MATERIALS_CLOUD_RAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_CLOUD_RAYS_INL_H_
#undef SWELL_RENDER_MATERIALS_CLOUD_RAYS_INL_H_
#else
#define SWELL_RENDER_MATERIALS_CLOUD_RAYS_INL_H_
#endif

#include "render/materials/volume_clouds.h"
#include "render/tile/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// What a ray gathers between two distances.
struct CloudLightSeen {
  V opacity;      // the part of what lies behind that is hidden
  V sun, sky;     // sunlight scattered to the eye, over the irradiance, and the part of skylight
  V front, back;  // where clouds begin and end
  V distance;     // their mean distance
  V clear;        // up to here there is surely nothing
};

// A ray that lets through less than this is followed no further and lets through nothing. From
// kLittlePassing on what is let through goes there evenly, so that nothing jumps.
constexpr float kLeastPassing = 1.0f / 100.0f, kLittlePassing = 1.0f / 40.0f;

// The length of steps at a distance: step_m up to far_m, twice as long from there on, and so on.
HWY_INLINE V StepAt(V t, const CloudSteps& steps) {
  const DI di;
  const V ratio = hn::Mul(t, Constant(1.0f / steps.far_m));
  const V power = hn::BitCast(D(), hn::And(hn::BitCast(di, ratio), hn::Set(di, 0x7f800000)));
  return hn::Mul(hn::Max(power, Constant(1.0f)), Constant(steps.step_m));
}

// 1 / x of powers of two.
HWY_INLINE V InverseOfPower(V x) {
  const DI di;
  return hn::BitCast(D(), hn::Sub(hn::Set(di, 0x7f000000), hn::BitCast(di, x)));
}

// x rounded down to whole steps, which are powers of two.
HWY_INLINE V WholeSteps(V x, V step) {
  return hn::Mul(hn::Floor(hn::Mul(x, InverseOfPower(step))), step);
}

// Rays on their way.
struct RaysUnderWay {
  V t, end;
  V passes, weighted;  // what is let through; distances times what each step hides
  V known, sun, sky;   // the light at a distance
  CloudLightSeen seen;
};

// Steps that are passed over or taken together.
struct StepGroup {
  V step, length, first, next;
};
HWY_INLINE StepGroup GroupAt(V t, const CloudSteps& steps) {
  const V step = StepAt(t, steps), length = hn::Mul(step, Constant(float{CloudSteps::kGroup}));
  const V first = WholeSteps(t, length);
  return {step, length, first, hn::Add(first, length)};
}

// The body of a cloud at the middles of the first, the second and the third part of a group,
// between which it lies on straight lines; no form is above those of all three.
struct BodyLine {
  V middle, body0, body1, body2, highest;
};

// Takes the steps of a group where `taken`.
template <class Field>
HWY_INLINE void TakeSteps(const Field& field, const StepGroup& group, const BodyLine& line,
                          V most_per_m, hn::Mask<D> taken, RaysUnderWay& rays) {
  constexpr int kGroup = CloudSteps::kGroup;
  const D d;
  const V zero = hn::Zero(d), per_m = InverseOfPower(group.length);
  const V rise0 = hn::Mul(hn::Mul(hn::Sub(line.body1, line.body0), Constant(3.0f)), per_m);
  const V rise1 = hn::Mul(hn::Mul(hn::Sub(line.body2, line.body1), Constant(3.0f)), per_m);
  // The optical depth of each step.
  V from[kGroup], to[kGroup], depth[kGroup];
  V sum = zero;
  for (int i = 0; i < kGroup; ++i) {
    from[i] = hn::Max(hn::MulAdd(group.step, Constant(float(i)), group.first), rays.t);
    to[i] = hn::Min(hn::MulAdd(group.step, Constant(float(i + 1)), group.first), rays.end);
    const V middle = hn::Mul(hn::Add(from[i], to[i]), Constant(0.5f));
    const V after = hn::Sub(middle, line.middle);
    const V rise = hn::IfThenElse(hn::Lt(after, zero), rise0, rise1);
    const V body = hn::MulAdd(rise, after, line.body1);
    const V form = hn::Min(field.Form(middle, body), line.highest);
    const auto here = hn::And(taken, hn::Lt(from[i], to[i]));
    const V density = hn::IfThenElseZero(here, field.Density(middle, form));
    depth[i] = hn::Mul(hn::Mul(density, most_per_m), hn::Sub(to[i], from[i]));
    sum = hn::Add(sum, depth[i]);
  }
  const auto some = hn::Gt(sum, zero);
  if (hn::AllFalse(d, some)) return;
  // What they hide and scatter.
  if (!hn::AllFalse(d, hn::AndNot(hn::Eq(rays.known, group.first), some)))
    field.Light(group.first, rays.sun, rays.sky);
  V sun_next, sky_next;
  field.Light(group.next, sun_next, sky_next);
  CloudLightSeen& seen = rays.seen;
  for (int i = 0; i < kGroup; ++i) {
    const V middle = hn::Mul(hn::Add(from[i], to[i]), Constant(0.5f));
    const V part = hn::Mul(hn::Sub(middle, group.first), per_m);
    const V hidden = hn::NegMulAdd(rays.passes, Exp(d, hn::Neg(depth[i])), rays.passes);
    const auto hides = hn::Gt(hidden, zero);
    seen.sun = hn::MulAdd(hidden, Lerp(rays.sun, sun_next, part), seen.sun);
    seen.sky = hn::MulAdd(hidden, Lerp(rays.sky, sky_next, part), seen.sky);
    rays.weighted = hn::MulAdd(hidden, middle, rays.weighted);
    seen.front = hn::IfThenElse(hides, hn::Min(seen.front, from[i]), seen.front);
    seen.back = hn::IfThenElse(hides, to[i], seen.back);
    rays.passes = hn::Sub(rays.passes, hidden);
  }
  rays.known = group.next, rays.sun = sun_next, rays.sky = sky_next;
}

// Follows rays from `begin` to `end`, in steps that lie on a lattice of distances from the eye, the
// first and the last cut. Midpoints are sampled. What a step scatters is its source times what it
// hides, so that light is neither made nor lost whatever the step. A step hides at most 1 - e^-0.5:
// where far steps are longer the extinction is less, as of a cloud seen blurred. Groups of steps
// are passed over or taken, and the light between their ends is interpolated.
//
// `field` says Body(t), Form(t, body), of which MayHold(form) tells whether there may be something,
// Density(t, form) in [0, 1], Light(t, sun, sky) and EmptyUntil(t), a distance up to which there is
// surely nothing, or less than t.
template <class Field>
HWY_INLINE CloudLightSeen FollowRays(const Field& field, V begin, V end, const CloudSteps& steps,
                                     float extinction_per_m) {
  const D d;
  const V zero = hn::Zero(d), one = Constant(1.0f);
  RaysUnderWay rays = {begin,           end,  one,  zero,
                       Constant(-1.0f), zero, zero, {zero, zero, zero, end, begin, zero, end}};
  CloudLightSeen& seen = rays.seen;
  for (;;) {
    const auto active = hn::And(hn::Lt(rays.t, end), hn::Gt(rays.passes, Constant(kLeastPassing)));
    if (hn::AllFalse(d, active)) break;
    const StepGroup group = GroupAt(rays.t, steps);
    const V empty_until = field.EmptyUntil(rays.t);
    const auto looked_at = hn::And(active, hn::Lt(empty_until, group.next));
    if (!hn::AllFalse(d, looked_at)) {
      const V third = hn::Mul(group.length, Constant(1.0f / 3.0f));
      const V t1 = hn::MulAdd(group.length, Constant(0.5f), group.first);
      const V t0 = hn::Sub(t1, third), t2 = hn::Add(t1, third);
      const V body0 = field.Body(t0), body1 = field.Body(t1), body2 = field.Body(t2);
      const V highest =
          hn::Max(hn::Max(field.Form(t0, body0), field.Form(t1, body1)), field.Form(t2, body2));
      const auto taken = hn::And(looked_at, field.MayHold(highest));
      if (!hn::AllFalse(d, taken)) {
        seen.clear = hn::IfThenElse(taken, hn::Min(seen.clear, group.first), seen.clear);
        const V most =
            hn::Div(Constant(steps.most_depth), hn::Max(group.first, Constant(steps.far_m)));
        TakeSteps(field, group, {t1, body0, body1, body2, highest},
                  hn::Min(most, Constant(extinction_per_m)), taken, rays);
      }
    }
    const V length_there = hn::Mul(StepAt(empty_until, steps), Constant(float{CloudSteps::kGroup}));
    const V go_on = hn::Max(group.next, WholeSteps(empty_until, length_there));
    rays.t = hn::IfThenElse(active, hn::Min(go_on, end), rays.t);
  }
  // What is almost opaque is opaque.
  const V found = hn::Sub(one, rays.passes);
  constexpr float kSlope = kLittlePassing / (kLittlePassing - kLeastPassing);
  const V less = hn::Mul(hn::Sub(rays.passes, Constant(kLeastPassing)), Constant(kSlope));
  const V passes = hn::Max(hn::Min(rays.passes, less), zero);
  seen.opacity = hn::Sub(one, passes);
  const V scale = hn::Div(seen.opacity, hn::Max(found, Constant(1e-20f)));
  seen.sun = hn::Mul(seen.sun, scale);
  seen.sky = hn::Mul(seen.sky, scale);
  seen.distance = hn::Div(rays.weighted, hn::Max(found, Constant(1e-20f)));
  seen.back = hn::Max(seen.back, hn::Add(seen.front, one));
  return seen;
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
