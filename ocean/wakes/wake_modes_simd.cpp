#include <cstdlib>

#include "math/elementary.h"
#include "ocean/spectrum/patch_waves.h"
#include "ocean/wakes/wake_modes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/wakes/wake_modes_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "math/elementary-inl.h"
#include "ocean/spectrum/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::ocean {
namespace HWY_NAMESPACE {

struct ComplexV {
  V re, im;
};
// Beside the next; clang-tidy does not see who uses it.
using swell::HWY_NAMESPACE::operator*;  // NOLINT(misc-unused-using-decls)

HWY_INLINE ComplexV operator*(ComplexV a, ComplexV b) {
  return {MulSub(a.re, b.re, a.im * b.im), MulAdd(a.re, b.im, a.im * b.re)};
}

// e^(2 pi i turns).
HWY_INLINE ComplexV OnCircle(V turns) {
  ComplexV e;
  swell::HWY_NAMESPACE::SinCosTurns(D(), turns, e.im, e.re);
  return e;
}

// A packet of modes: wave counts along x and y, wave number, frequency, group velocity.
struct Modes {
  V count_x, count_y;
  V k;  // rad/m
  V turns_per_s;
  V going_x, going_y;  // m/s
};

HWY_INLINE Modes ModesAt(const WakeWindow& window, V count_x, V count_y) {
  const V one = Constant(1.0f), to_k = Constant(static_cast<float>(2.0 * kPi / window.length_m));
  Modes m;
  m.count_x = count_x;
  m.count_y = count_y;
  const V counts2 = MulAdd(count_x, count_x, count_y * count_y);
  const V counts = Sqrt(Max(counts2, Constant(0.25f)));  // nothing is made of k = 0
  m.k = counts * to_k;
  V omega2 = m.k * window.gravity_mps2, group = Constant(0.5f);
  if (window.depth_m > 0.0f) {
    // tanh(k d) and 1/2 + k d / sinh(2 k d) by e = exp(-2 k d).
    const V kd2 = m.k * (2.0f * window.depth_m);
    const V e = swell::HWY_NAMESPACE::Exp(D(), -Min(kd2, Constant(60.0f)));
    omega2 = omega2 * ((one - e) / (one + e));
    group = group + kd2 * e / NegMulAdd(e, e, one);
  }
  const V omega = Sqrt(omega2);
  m.turns_per_s = omega * static_cast<float>(0.5 / kPi);
  const V speed = group * omega / (m.k * counts);
  m.going_x = speed * count_x;
  m.going_y = speed * count_y;
  return m;
}

// Where waves that were made in a window end, along one axis.
struct Limits {
  float low_m, high_m;
};

HWY_INLINE Limits LimitsOf(const WakeWindow& window, int axis) {
  const float length_m = static_cast<float>(window.length_m), inside = 0.5f * kWakeRim;
  return {window.end_m[axis] + inside * length_m, window.end_m[axis] + (1.0f - inside) * length_m};
}

// When something at x for s = 0 that goes on by v comes to a limit.
HWY_INLINE V LeavesAt(Limits limits, V x, V v) {
  const M stands = Abs(v) < 1e-6f;
  v = IfThenElse(stands, Constant(1e-6f), v);
  const V end = IfThenElse(v > 0.0f, Constant(limits.high_m), Constant(limits.low_m));
  return (end - x) / v;
}

// How far x lies inside, 0 outside.
HWY_INLINE V Inside(Limits limits, V x) {
  const V inside = Min(x - limits.low_m, limits.high_m - x);
  return Max(inside, 0.0f);
}

// ---- A hump at one moment

HWY_INLINE void AddRing(const WakeWindow& window, const WakeRing& ring, const Modes& m,
                        ComplexV& sum) {
  const D d;
  const auto length_m = static_cast<float>(window.length_m);
  const V leaves = Min(LeavesAt(LimitsOf(window, 0), Constant(ring.x_m), m.going_x),
                       LeavesAt(LimitsOf(window, 1), Constant(ring.y_m), m.going_y));
  // 1 up to two thirds of that age, then down to 0 with no slope.
  const V part = Constant(3.0f * ring.age_s) / Max(leaves, Constant(1e-6f));
  const V late = Min(Max(part - 2.0f, 0.0f), Constant(1.0f));
  const V kept =
      NegMulAdd(late * late, NegMulAdd(late, Constant(2.0f), Constant(3.0f)), Constant(1.0f));
  const V spread = m.k * m.k * (-0.25f * ring.radius_m * ring.radius_m);
  const float volume = static_cast<float>(kPi) * ring.radius_m * ring.radius_m * ring.height_m;
  const V size = swell::HWY_NAMESPACE::Exp(d, spread) * kept * (volume / (length_m * length_m));
  const V place =
      MulAdd(m.count_x, Constant(ring.x_m / length_m), m.count_y * (ring.y_m / length_m));
  const ComplexV e = OnCircle(-MulAdd(m.turns_per_s, Constant(ring.age_s), place));
  sum.re = MulAdd(size, e.re, sum.re);
  sum.im = MulAdd(size, e.im, sum.im);
}

// ---- A hull

// The integral of e^(2 pi i (phase + rate s)) over ages s, times `weight`, added to sum; nothing
// where `to` is not after `from`.
HWY_INLINE void AddIntegral(V phase, V rate, V from, V to, float weight, ComplexV& sum) {
  const V half = Max(to - from, 0.0f) * 0.5f;
  const V middle = (from + to) * 0.5f;
  const ComplexV e = OnCircle(MulAdd(rate, middle, phase));
  const V turns = rate * half;
  const V angle = turns * static_cast<float>(2.0 * kPi);
  const M small = Abs(angle) < 1e-3f;
  const V sine = OnCircle(turns).im;
  const V sinc = IfThenElse(small, Constant(1.0f), sine / IfThenElse(small, Constant(1.0f), angle));
  const V size = half * sinc * (2.0f * weight);
  sum.re = MulAdd(size, e.re, sum.re);
  sum.im = MulAdd(size, e.im, sum.im);
}

// The age from which on a mode's waves are outside, or the hull was not there yet. Waves from
// before a turn may come in again: so that none are there all at once, waves that are near the
// window's end at a turn count as if they left soon after it.
HWY_INLINE V OldestInside(const WakeWindow& window, const Modes& m) {
  const Limits x_limits = LimitsOf(window, 0), y_limits = LimitsOf(window, 1);
  const float stays_s_m = 11.0f / window.hull.speed_mps;
  V oldest = Constant(window.stretches.back().to_s);
  M left = hn::MaskFromVec(hn::Zero(D()));
  for (const WakeStretch& s : window.stretches) {
    const V x = Constant(s.x_m), v_x = m.going_x - s.u_mps, turn = Constant(s.to_s);
    const V y = Constant(s.y_m), v_y = m.going_y - s.v_mps;
    const V out = Min(LeavesAt(x_limits, x, v_x), LeavesAt(y_limits, y, v_y));
    const V at = Max(out, Constant(s.from_s));
    const M leaves = hn::AndNot(left, at < turn);
    oldest = IfThenElse(leaves, Min(at, oldest), oldest);
    left = left | leaves;
    const V inside_m =
        Min(Inside(x_limits, MulAdd(v_x, turn, x)), Inside(y_limits, MulAdd(v_y, turn, y)));
    oldest = Min(oldest, MulAdd(inside_m, Constant(stays_s_m), turn));
  }
  return oldest;
}

// What a hull is to waves: it pushes water aside at the bow and draws it in again along its run to
// the stern, where the flow is softer. Two Gaussians, of which the second is longer and as strong.
constexpr float kBowPlace = 0.40f, kSternPlace = 0.32f;     // parts of the length off the middle
constexpr float kBowLength = 0.075f, kSternLength = 0.15f;  // deviations, parts of the length
constexpr float kHullBeam = 0.30f;                          // the same across, of the beam
constexpr float kFullness = 0.55f;  // of the midship section in its rectangle

// The amplitude of the hull's source on a heading, of unit components, over the window's area.
HWY_INLINE ComplexV HullShape(const WakeWindow& window, const Modes& m, float ahead_x,
                              float ahead_y) {
  const D d;
  const WakeHull& hull = window.hull;
  const V to_k = Constant(static_cast<float>(2.0 * kPi / window.length_m));
  const V along = to_k * MulAdd(m.count_x, Constant(ahead_x), m.count_y * ahead_y);
  const V across = to_k * MulSub(m.count_x, Constant(ahead_y), m.count_y * ahead_x);
  const float beam_m = kHullBeam * hull.beam_m;
  // Half of the draught deep, in the mean.
  const V wide =
      MulAdd(across * across, Constant(-0.5f * beam_m * beam_m), m.k * (-0.5f * hull.draught_m));
  const V along2 = along * along;
  const auto gauss = [&](float deviation_m) HWY_ATTR {
    return swell::HWY_NAMESPACE::Exp(
        d, MulAdd(along2, Constant(-0.5f * deviation_m * deviation_m), wide));
  };
  const V bow = gauss(kBowLength * hull.length_m), stern = gauss(kSternLength * hull.length_m);
  const V turns = along * static_cast<float>(0.5 / kPi);
  const ComplexV to_bow = OnCircle(turns * (-kBowPlace * hull.length_m));
  const ComplexV to_stern = OnCircle(turns * (kSternPlace * hull.length_m));
  const auto area_m2 = static_cast<float>(window.length_m * window.length_m);
  const V flux = Constant(kFullness * hull.speed_mps * hull.beam_m * hull.draught_m / area_m2);
  return {flux * MulSub(bow, to_bow.re, stern * to_stern.re),
          flux * MulSub(bow, to_bow.im, stern * to_stern.im)};
}

HWY_INLINE void AddHull(const WakeWindow& window, const Modes& m, ComplexV& sum) {
  const D d;
  const auto inv_length = static_cast<float>(1.0 / window.length_m);
  const V oldest = Max(OldestInside(window, m), Constant(1e-3f));
  const V half_age = oldest * 0.5f;
  const V inv_oldest = 1.0f / oldest;  // turns a second of the fading
  for (const WakeStretch& s : window.stretches) {
    const V phase =
        -MulAdd(m.count_x, Constant(s.x_m * inv_length), m.count_y * (s.y_m * inv_length));
    const V rate =
        MulAdd(m.count_x, Constant(s.u_mps * inv_length), m.count_y * (s.v_mps * inv_length)) -
        m.turns_per_s;
    const V from = Constant(s.from_s), to = Min(Constant(s.to_s), oldest);
    if (hn::AllFalse(d, from < to)) continue;
    ComplexV integral = {hn::Zero(d), hn::Zero(d)};
    AddIntegral(phase, rate, from, Min(to, half_age), 1.0f, integral);
    // From half of the oldest age T on (1 - cos(2 pi s / T)) / 2.
    const V late = Max(from, half_age);
    AddIntegral(phase, rate, late, to, 0.5f, integral);
    AddIntegral(phase, rate + inv_oldest, late, to, -0.25f, integral);
    AddIntegral(phase, rate - inv_oldest, late, to, -0.25f, integral);
    const float inv_speed = 1.0f / window.hull.speed_mps;
    const ComplexV part = HullShape(window, m, s.u_mps * inv_speed, s.v_mps * inv_speed) * integral;
    sum.re = sum.re + part.re;
    sum.im = sum.im + part.im;
  }
}

// ---- Both

// Heights' modes times what makes velocities of them: -i omega, or g k / omega along k.
HWY_INLINE ComplexV FieldOf(const WakeWindow& window, WakeField field, const Modes& m, ComplexV a) {
  const V omega = m.turns_per_s * static_cast<float>(2.0 * kPi);
  switch (field) {
    case WakeField::kHeight:
      return a;
    case WakeField::kRise:
      return {omega * a.im, -(omega * a.re)};
    case WakeField::kDriftX:
    case WakeField::kDriftY:
      break;
  }
  // g k / omega (k_x / k) = g k_x / omega.
  const V count = field == WakeField::kDriftX ? m.count_x : m.count_y;
  const V drift =
      count *
      static_cast<float>(2.0 * kPi / window.length_m * static_cast<double>(window.gravity_mps2)) /
      omega;
  return {drift * a.re, drift * a.im};
}

void FillWake(const WakeWindow& window, WakeField field, const FftPlan& plan, int column0,
              float* re, float* im) {
  const D d;
  const V most2 = Constant(window.most_counts * window.most_counts);
  for (int j = 0; j < kWakeSamples; ++j) {
    const V count_y = Constant(static_cast<float>(wave_count(j, kWakeSamples)));
    float* const row_re = re + static_cast<std::size_t>(plan.slot[j]) * kFftBatch;
    float* const row_im = im + static_cast<std::size_t>(plan.slot[j]) * kFftBatch;
    for (std::size_t lane = 0; lane < kFftBatch; lane += hn::Lanes(d)) {
      const V column = hn::Iota(d, static_cast<float>(column0) + static_cast<float>(lane));
      const V count_x = IfThenElse(column < 0.5f * kWakeSamples, column, column - kWakeSamples);
      const V counts2 = MulAdd(count_x, count_x, count_y * count_y);
      const M some = (counts2 > 0.0f) & (counts2 < most2);
      ComplexV sum = {hn::Zero(d), hn::Zero(d)};
      if (!hn::AllFalse(d, some)) {
        const Modes m = ModesAt(window, count_x, count_y);
        for (const WakeRing& ring : window.rings) AddRing(window, ring, m, sum);
        if (!window.stretches.empty()) AddHull(window, m, sum);
        sum = FieldOf(window, field, m, sum);
      }
      hn::Store(IfThenElseZero(some, sum.re), d, row_re + lane);
      hn::Store(IfThenElseZero(some, sum.im), d, row_im + lane);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::ocean
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::ocean {

HWY_EXPORT(FillWake);

bool fill_wake(const WakeWindow& window, WakeField field, const FftPlan& plan, int column0,
               float* re, float* im) {
  if (window.rings.empty() && window.stretches.empty()) return false;
  HWY_DYNAMIC_DISPATCH(FillWake)(window, field, plan, column0, re, im);
  return true;
}

}  // namespace swell::ocean
#endif  // HWY_ONCE
