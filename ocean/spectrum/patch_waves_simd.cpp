#include <algorithm>
#include <cstddef>
#include <cstdlib>

#include "math/elementary.h"
#include "ocean/spectrum/patch_waves.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/spectrum/patch_waves_simd.cpp"
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

// omega t in turns, less whole turns. In double: after years at sea the fraction is still exact
// to 1e-6 of a turn.
HWY_INLINE hn::Vec<DHalf> HalfTurnsAt(const double* turns_per_s, double t_s) {
  const DDouble dd;
  const auto turns = hn::LoadU(dd, turns_per_s) * hn::Set(dd, t_s);
  return hn::DemoteTo(DHalf(), turns - hn::Round(turns));
}

HWY_INLINE V TurnsAt(D d, const double* turns_per_s, double t_s) {
  return hn::Combine(d, HalfTurnsAt(turns_per_s + hn::Lanes(DDouble()), t_s),
                     HalfTurnsAt(turns_per_s, t_s));
}

// h(k, t) of the waves from position `at`.
HWY_INLINE ComplexV WavesAt(D d, const PatchWaves& waves, std::size_t at, double t_s) {
  V s, c;
  swell::HWY_NAMESPACE::SinCosTurns(d, TurnsAt(d, waves.turns_per_s.data() + at, t_s), s, c);
  const V re =
      MulAdd(hn::LoadU(d, waves.cos_re.data() + at), c, hn::LoadU(d, waves.sin_re.data() + at) * s);
  const V im =
      MulAdd(hn::LoadU(d, waves.cos_im.data() + at), c, hn::LoadU(d, waves.sin_im.data() + at) * s);
  return {re, im};
}

// omega, in rad/s.
HWY_INLINE V OmegaAt(D d, const double* turns_per_s) {
  const DHalf dh;
  const DDouble dd;
  const auto two_pi = hn::Set(dd, 2.0 * kPi);
  const auto half = [&](const double* turns)
                        HWY_ATTR { return hn::DemoteTo(dh, two_pi * hn::LoadU(dd, turns)); };
  return hn::Combine(d, half(turns_per_s + hn::Lanes(dd)), half(turns_per_s));
}

// dh/dt of the waves from position `at`.
HWY_INLINE ComplexV RatesAt(D d, const PatchWaves& waves, std::size_t at, double t_s) {
  V s, c;
  swell::HWY_NAMESPACE::SinCosTurns(d, TurnsAt(d, waves.turns_per_s.data() + at, t_s), s, c);
  const V omega = OmegaAt(d, waves.turns_per_s.data() + at);
  const V re =
      MulSub(hn::LoadU(d, waves.sin_re.data() + at), c, hn::LoadU(d, waves.cos_re.data() + at) * s);
  const V im =
      MulSub(hn::LoadU(d, waves.sin_im.data() + at), c, hn::LoadU(d, waves.cos_im.data() + at) * s);
  return {omega * re, omega * im};
}

HWY_INLINE void StoreRow(D d, ComplexV v, std::size_t offset, float* re, float* im) {
  hn::Store(v.re, d, re + offset);
  hn::Store(v.im, d, im + offset);
}

HWY_INLINE void ZeroRow(D d, std::size_t offset, float* re, float* im) {
  for (std::size_t lane = 0; lane < kFftBatch; lane += hn::Lanes(d)) {
    StoreRow(d, {hn::Zero(d), hn::Zero(d)}, offset + lane, re, im);
  }
}

// f_a + i f_b, f = waves_at(waves, position).
template <class WavesOfPatch>
HWY_INLINE void FillPair(const PatchWaves& a, const PatchWaves* b, const FftPlan& plan, int column0,
                         float* re, float* im, WavesOfPatch waves_at) {
  const D d;
  const int reach = reach_of(a, b);
  for (int j = 0; j < a.size; ++j) {
    const std::size_t offset = static_cast<std::size_t>(plan.slot[j] * kFftBatch);
    if (std::abs(wave_count(j, a.size)) > reach) {
      ZeroRow(d, offset, re, im);
      continue;
    }
    const std::size_t at = wave_position(column0, j, a.size);
    for (std::size_t lane = 0; lane < kFftBatch; lane += hn::Lanes(d)) {
      ComplexV h = waves_at(a, at + lane);
      if (b != nullptr) {
        const ComplexV h_b = waves_at(*b, at + lane);
        h = {h.re - h_b.im, h.im + h_b.re};
      }
      StoreRow(d, h, offset + lane, re, im);
    }
  }
}

void FillHeights(const PatchWaves& a, const PatchWaves* b, const FftPlan& plan, double t_s,
                 int column0, float* re, float* im) {
  FillPair(a, b, plan, column0, re, im, [&](const PatchWaves& waves, std::size_t at) HWY_ATTR {
    return WavesAt(D(), waves, at, t_s);
  });
}

void FillRising(const PatchWaves& a, const PatchWaves* b, const FftPlan& plan, double t_s,
                int column0, float* re, float* im) {
  FillPair(a, b, plan, column0, re, im, [&](const PatchWaves& waves, std::size_t at) HWY_ATTR {
    return RatesAt(D(), waves, at, t_s);
  });
}

// (i k_x - k_y) f, f = waves_at(position, k_x, k_y).
template <class WavesOfPatch>
HWY_INLINE void FillGradient(const PatchWaves& waves, const FftPlan& plan, int column0, float* re,
                             float* im, WavesOfPatch waves_at) {
  const D d;
  for (int j = 0; j < waves.size; ++j) {
    const std::size_t offset = static_cast<std::size_t>(plan.slot[j] * kFftBatch);
    if (std::abs(wave_count(j, waves.size)) > waves.reach) {
      ZeroRow(d, offset, re, im);
      continue;
    }
    const V ky = hn::Set(d, waves.k_rad_m[j]);
    const std::size_t at = wave_position(column0, j, waves.size);
    for (std::size_t lane = 0; lane < kFftBatch; lane += hn::Lanes(d)) {
      const V kx = hn::LoadU(d, waves.k_rad_m.data() + column0 + lane);
      const ComplexV h = waves_at(at + lane, kx, ky);
      const V re_out = -MulAdd(ky, h.re, kx * h.im);
      const V im_out = MulSub(kx, h.re, ky * h.im);
      StoreRow(d, {re_out, im_out}, offset + lane, re, im);
    }
  }
}

void FillSlopes(const PatchWaves& waves, const FftPlan& plan, double t_s, int column0, float* re,
                float* im) {
  FillGradient(waves, plan, column0, re, im,
               [&](std::size_t at, V, V) HWY_ATTR { return WavesAt(D(), waves, at, t_s); });
}

HWY_INLINE ComplexV OverWaveNumber(ComplexV f, V kx, V ky) {
  const V k2 = MulAdd(kx, kx, ky * ky);
  const V k = Sqrt(Max(k2, 1e-30f));  // no waves at k = 0
  return {f.re / k, f.im / k};
}

void FillDisplacements(const PatchWaves& waves, const FftPlan& plan, double t_s, int column0,
                       float* re, float* im) {
  FillGradient(waves, plan, column0, re, im, [&](std::size_t at, V kx, V ky) HWY_ATTR {
    return OverWaveNumber(WavesAt(D(), waves, at, t_s), kx, ky);
  });
}

void FillDrift(const PatchWaves& waves, const FftPlan& plan, double t_s, int column0, float* re,
               float* im) {
  FillGradient(waves, plan, column0, re, im, [&](std::size_t at, V kx, V ky) HWY_ATTR {
    return OverWaveNumber(RatesAt(D(), waves, at, t_s), kx, ky);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::ocean
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::ocean {
namespace {

bool columns_hold_waves(int column0, int size, int reach) {
  int nearest = size;
  for (int i = column0; i < column0 + kFftBatch; ++i) {
    nearest = std::min(nearest, std::abs(wave_count(i, size)));
  }
  return nearest <= reach;
}

}  // namespace

HWY_EXPORT(FillHeights);
HWY_EXPORT(FillSlopes);
HWY_EXPORT(FillDisplacements);
HWY_EXPORT(FillRising);
HWY_EXPORT(FillDrift);

bool fill_heights(const PatchWaves& a, const PatchWaves* b, const FftPlan& plan, double t_s,
                  int column0, float* re, float* im) {
  if (!columns_hold_waves(column0, a.size, reach_of(a, b))) return false;
  HWY_DYNAMIC_DISPATCH(FillHeights)(a, b, plan, t_s, column0, re, im);
  return true;
}

bool fill_slopes(const PatchWaves& waves, const FftPlan& plan, double t_s, int column0, float* re,
                 float* im) {
  if (!columns_hold_waves(column0, waves.size, waves.reach)) return false;
  HWY_DYNAMIC_DISPATCH(FillSlopes)(waves, plan, t_s, column0, re, im);
  return true;
}

bool fill_displacements(const PatchWaves& waves, const FftPlan& plan, double t_s, int column0,
                        float* re, float* im) {
  if (!columns_hold_waves(column0, waves.size, waves.reach)) return false;
  HWY_DYNAMIC_DISPATCH(FillDisplacements)(waves, plan, t_s, column0, re, im);
  return true;
}

bool fill_rising(const PatchWaves& a, const PatchWaves* b, const FftPlan& plan, double t_s,
                 int column0, float* re, float* im) {
  if (!columns_hold_waves(column0, a.size, reach_of(a, b))) return false;
  HWY_DYNAMIC_DISPATCH(FillRising)(a, b, plan, t_s, column0, re, im);
  return true;
}

bool fill_drift(const PatchWaves& waves, const FftPlan& plan, double t_s, int column0, float* re,
                float* im) {
  if (!columns_hold_waves(column0, waves.size, waves.reach)) return false;
  HWY_DYNAMIC_DISPATCH(FillDrift)(waves, plan, t_s, column0, re, im);
  return true;
}

}  // namespace swell::ocean
#endif  // HWY_ONCE
