// Follows rays through what scatters light.
#if defined(SWELL_RENDER_SKY_CLOUD_RAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_SKY_CLOUD_RAYS_INL_H_
#undef SWELL_RENDER_SKY_CLOUD_RAYS_INL_H_
#else
#define SWELL_RENDER_SKY_CLOUD_RAYS_INL_H_
#endif

#include "render/packets/packet-inl.h"
#include "render/sky/sky_maps.h"
#include "render/sky/volume_clouds.h"

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
  const V ratio = t * (1.0f / steps.far_m);
  const V power = hn::BitCast(D(), hn::BitCast(di, ratio) & 0x7f800000);
  return Max(power, 1.0f) * steps.step_m;
}

// 1 / x of powers of two.
HWY_INLINE V InverseOfPower(V x) {
  const DI di;
  return hn::BitCast(D(), 0x7f000000 - hn::BitCast(di, x));
}

// x rounded down to whole steps, which are powers of two.
HWY_INLINE V WholeSteps(V x, V step) { return Floor(x * InverseOfPower(step)) * step; }

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
  const V step = StepAt(t, steps), length = step * float{CloudSteps::kGroup};
  const V first = WholeSteps(t, length);
  return {step, length, first, first + length};
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
  const V rise0 = (line.body1 - line.body0) * 3.0f * per_m;
  const V rise1 = (line.body2 - line.body1) * 3.0f * per_m;
  // The optical depth of each step.
  V from[kGroup], to[kGroup], depth[kGroup];
  V sum = zero;
  for (int i = 0; i < kGroup; ++i) {
    from[i] = Max(MulAdd(group.step, float(i), group.first), rays.t);
    to[i] = Min(MulAdd(group.step, float(i + 1), group.first), rays.end);
    const V middle = (from[i] + to[i]) * 0.5f;
    const V after = middle - line.middle;
    const V rise = IfThenElse(after < zero, rise0, rise1);
    const V body = MulAdd(rise, after, line.body1);
    const V form = Min(field.Form(middle, body), line.highest);
    const auto here = taken & (from[i] < to[i]);
    const V density = IfThenElseZero(here, field.Density(middle, form));
    depth[i] = density * most_per_m * (to[i] - from[i]);
    sum = sum + depth[i];
  }
  const auto some = sum > zero;
  if (hn::AllFalse(d, some)) return;
  // What they hide and scatter.
  if (!hn::AllFalse(d, hn::AndNot(rays.known == group.first, some)))
    field.Light(group.first, rays.sun, rays.sky);
  V sun_next, sky_next;
  field.Light(group.next, sun_next, sky_next);
  CloudLightSeen& seen = rays.seen;
  for (int i = 0; i < kGroup; ++i) {
    const V middle = (from[i] + to[i]) * 0.5f;
    const V part = (middle - group.first) * per_m;
    const V hidden = NegMulAdd(rays.passes, Exp(d, -depth[i]), rays.passes);
    const auto hides = hidden > zero;
    seen.sun = MulAdd(hidden, Lerp(rays.sun, sun_next, part), seen.sun);
    seen.sky = MulAdd(hidden, Lerp(rays.sky, sky_next, part), seen.sky);
    rays.weighted = MulAdd(hidden, middle, rays.weighted);
    seen.front = IfThenElse(hides, Min(seen.front, from[i]), seen.front);
    seen.back = IfThenElse(hides, to[i], seen.back);
    rays.passes = rays.passes - hidden;
  }
  rays.known = group.next, rays.sun = sun_next, rays.sky = sky_next;
}

// The next group of each ray, and whether it may hold a cloud.
struct GroupAhead {
  StepGroup group;
  V empty_until;
  BodyLine line;
  hn::Mask<D> taken;
};

// `field` says Body(t), Form(t, body), of which MayHold(form) tells whether there may be something,
// Density(t, form) in [0, 1], Light(t, sun, sky) and EmptyUntil(t), a distance up to which there is
// surely nothing, or less than t.
template <class Field>
HWY_INLINE GroupAhead LookAhead(const Field& field, V t, hn::Mask<D> active,
                                const CloudSteps& steps) {
  const D d;
  const V zero = hn::Zero(d);
  const StepGroup group = GroupAt(t, steps);
  const V empty_until = field.EmptyUntil(t);
  const auto looked_at = active & (empty_until < group.next);
  if (hn::AllFalse(d, looked_at))
    return {group, empty_until, {zero, zero, zero, zero, zero}, looked_at};
  const V third = group.length * (1.0f / 3.0f);
  const V t1 = MulAdd(group.length, 0.5f, group.first);
  const V t0 = t1 - third, t2 = t1 + third;
  const V body0 = field.Body(t0), body1 = field.Body(t1), body2 = field.Body(t2);
  const V highest = Max(Max(field.Form(t0, body0), field.Form(t1, body1)), field.Form(t2, body2));
  return {
      group, empty_until, {t1, body0, body1, body2, highest}, looked_at & field.MayHold(highest)};
}

// Takes what lies ahead of the rays where it is `taken`.
template <class Field>
HWY_INLINE void TakeAhead(const Field& field, const GroupAhead& ahead, const CloudSteps& steps,
                          float extinction_per_m, RaysUnderWay& rays) {
  const V first = ahead.group.first;
  rays.seen.clear = IfThenElse(ahead.taken, Min(rays.seen.clear, first), rays.seen.clear);
  const V most = steps.most_depth / Max(first, steps.far_m);
  TakeSteps(field, ahead.group, ahead.line, Min(most, extinction_per_m), ahead.taken, rays);
}

// Where rays go on behind it.
HWY_INLINE V GoOn(const StepGroup& group, V empty_until, V end, const CloudSteps& steps) {
  const V length_there = StepAt(empty_until, steps) * float{CloudSteps::kGroup};
  return Min(Max(group.next, WholeSteps(empty_until, length_there)), end);
}

HWY_INLINE RaysUnderWay BeginRays(V begin, V end) {
  const V zero = hn::Zero(D()), one = Constant(1.0f);
  return {begin,           end,  one,  zero,
          Constant(-1.0f), zero, zero, {zero, zero, zero, end, begin, zero, end}};
}
HWY_INLINE hn::Mask<D> AreActive(const RaysUnderWay& rays) {
  return (rays.t < rays.end) & (rays.passes > kLeastPassing);
}

// What rays have seen that are not active any more.
HWY_INLINE CloudLightSeen EndRays(const RaysUnderWay& rays) {
  const V zero = hn::Zero(D()), one = Constant(1.0f);
  CloudLightSeen seen = rays.seen;
  // What is almost opaque is opaque.
  const V found = one - rays.passes;
  constexpr float kSlope = kLittlePassing / (kLittlePassing - kLeastPassing);
  const V less = (rays.passes - kLeastPassing) * kSlope;
  const V passes = Max(Min(rays.passes, less), zero);
  seen.opacity = one - passes;
  const V scale = seen.opacity / Max(found, 1e-20f);
  seen.sun = seen.sun * scale;
  seen.sky = seen.sky * scale;
  seen.distance = rays.weighted / Max(found, 1e-20f);
  seen.back = Max(seen.back, seen.front + one);
  return seen;
}

// Follows rays from `begin` to `end`, in steps that lie on a lattice of distances from the eye, the
// first and the last cut. Midpoints are sampled. What a step scatters is its source times what it
// hides, so that light is neither made nor lost whatever the step. A step hides at most 1 - e^-0.5:
// where far steps are longer the extinction is less, as of a cloud seen blurred. Groups of steps
// are passed over or taken, and the light between their ends is interpolated.
template <class Field>
HWY_INLINE CloudLightSeen FollowRays(const Field& field, V begin, V end, const CloudSteps& steps,
                                     float extinction_per_m) {
  const D d;
  RaysUnderWay rays = BeginRays(begin, end);
  for (;;) {
    const auto active = AreActive(rays);
    if (hn::AllFalse(d, active)) return EndRays(rays);
    const GroupAhead ahead = LookAhead(field, rays.t, active, steps);
    if (!hn::AllFalse(d, ahead.taken)) TakeAhead(field, ahead, steps, extinction_per_m, rays);
    const V go_on = GoOn(ahead.group, ahead.empty_until, rays.end, steps);
    rays.t = IfThenElse(active, go_on, rays.t);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
