// The front function: what a front of surf is like before, at and behind its crest, a vector of
// places at a time. Queries, vertices and shaders have their fronts from here.
//
// With `past` the turns since the crest was at a place, in [0, 1), and w the face's width in turns:
//   face   past > 1 - w         x^2 (3 - 2x),       x from 0 at its foot to 1 at the crest
//   back   past < 1/4 - w       (1 - y)^3 (1 + 3y), y from 0 at the crest to 1 at its end
//   foam   from the crest on it drains, thick at first
// The back ends where the next front's face begins. Source: Gabdrakhmanov, figure 7.
#if defined(SWELL_OCEAN_COAST_FRONT_FUNCTION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_OCEAN_COAST_FRONT_FUNCTION_INL_H_
#undef SWELL_OCEAN_COAST_FRONT_FUNCTION_INL_H_
#else
#define SWELL_OCEAN_COAST_FRONT_FUNCTION_INL_H_
#endif

#include "math/elementary-inl.h"
#include "math/lanes-inl.h"
#include "ocean/coast/front_clock.h"

HWY_BEFORE_NAMESPACE();
namespace swell::ocean {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

// Sine and cosine of a lag's turns.
struct AlongShore {
  V sine, cosine;
};
HWY_INLINE AlongShore FindAlong(glm::vec3 lag, V x, V y) {
  const V turns = MulAdd(x, lag.x, MulAdd(y, lag.y, lag.z));
  AlongShore along;
  SinCosTurns(D(), turns, along.sine, along.cosine);
  return along;
}

// Where the four fronts are at a place, one a component.
struct Fronts {
  V past[kSurfFronts];    // turns since the front was there, in [0, 1)
  V height[kSurfFronts];  // of the front along the shore, in [0, 1]
};

// part: distance to the shore over the reach, 0 or more. Clock: FrontClock, or what has its
// members.
template <class Clock>
HWY_INLINE Fronts FindFronts(const Clock& clock, V x, V y, V part) {
  const AlongShore a = FindAlong(clock.lag_a, x, y), b = FindAlong(clock.lag_b, x, y),
                   c = FindAlong(clock.lag_c, x, y);
  const V turns = MulAdd(Sqrt(part), clock.reach_turns, clock.cycles);
  // Which of the slow waves along the shore delay a front, and where it is high.
  const V lag[kSurfFronts] = {a.sine, b.sine, a.cosine, b.cosine};
  const V high[kSurfFronts] = {b.sine + c.cosine, a.cosine - c.sine, c.sine - b.cosine,
                               -a.sine - c.cosine};
  Fronts fronts;
  for (int n = 0; n < kSurfFronts; ++n) {
    const V phase = MulAdd(lag[n], 0.06f, turns) + 0.25f * static_cast<float>(n);
    fronts.past[n] = phase - Floor(phase);
    fronts.height[n] = Clamp(MulAdd(high[n], 0.35f, 0.65f), 0.0f, 1.0f);
  }
  return fronts;
}

// Foam of a front, in [0, 1]; drain: what is gone of it until the next, over all of it.
HWY_INLINE V FoamOfFront(V past, float drain) {
  const V comes = Min(past * 30.0f, 1.0f);
  const V left = Max(NegMulAdd(past, drain, 1.0f), hn::Zero(D()));
  return comes * (left * left);
}

// The face's width [turns], which falls towards the shore, and its rate by the part of the reach.
struct FrontFace {
  V width, rate;
};
constexpr float kSteepFace = 0.05f, kFaceByPart = 0.06f, kSteepestPart = 0.5f;

HWY_INLINE FrontFace FaceOfFronts(V part) {
  const V over = part - kSteepestPart;
  const auto changes = (over > 0.0f) & (over < 1.0f);
  return {MulAdd(Clamp(over, 0.0f, 1.0f), kFaceByPart, kSteepFace),
          hn::IfThenElseZero(changes, Constant(kFaceByPart))};
}

// A front's height over its trough, in [0, 1], and its rates by turns and by the face's width.
struct FrontShape {
  V value, by_turns, by_width;
};

HWY_INLINE FrontShape ShapeOfFront(V past, V width) {
  const V one = Constant(1.0f);
  const V to_crest = (one - past) / width, x = Max(one - to_crest, 0.0f);
  const V face_rate = 6.0f * x * (one - x);
  const V length = 0.25f - width, y = Min(past / length, one), left = one - y;
  const V left2 = left * left, back_rate = -12.0f * y * left2;
  const auto is_face = x > 0.0f;
  return {
      IfThenElse(is_face, x * x * NegMulAdd(x, 2.0f, 3.0f), left * left2 * MulAdd(y, 3.0f, one)),
      IfThenElse(is_face, face_rate / width, back_rate / length),
      IfThenElse(is_face, face_rate * to_crest / width, back_rate * y / length)};
}

// The highest front at a place. part: 0 or more.
HWY_INLINE FrontShape LiftOfFronts(const Fronts& fronts, V part) {
  const V zero = hn::Zero(D());
  const V width = FaceOfFronts(part).width;
  FrontShape lift = {zero, zero, zero};
  for (int n = 0; n < kSurfFronts; ++n) {
    const FrontShape shape = ShapeOfFront(fronts.past[n], width);
    const V value = shape.value * fronts.height[n];
    const auto is_higher = value > lift.value;
    lift.value = IfThenElse(is_higher, value, lift.value);
    lift.by_turns = IfThenElse(is_higher, shape.by_turns * fronts.height[n], lift.by_turns);
    lift.by_width = IfThenElse(is_higher, shape.by_width * fronts.height[n], lift.by_width);
  }
  return lift;
}

// The fronts' part in the surface where land leaves `kept` of the sea's waves.
HWY_INLINE V ShareOfFronts(V part, V kept) {
  return SmoothBlend(kFrontsFrom - part / Max(kept, 0.1f));
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::ocean
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
