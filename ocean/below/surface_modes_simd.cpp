#include <algorithm>
#include <cstdlib>

#include "math/check.h"
#include "math/elementary.h"
#include "ocean/below/surface_modes.h"
#include "ocean/spectrum/patch_waves.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/below/surface_modes_simd.cpp"
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

// A packet of modes: unit vectors along their waves, 0 where they have no direction, the squares of
// their frequencies, and what is left of them below the surface.
struct Modes {
  V to_x, to_y;
  V omega2;
  V cosh_part, sinh_part, tanh_kd;
};

HWY_INLINE void Decay(const SurfaceModes& modes, float below_m, V k, Modes& m) {
  const D d;
  const V one = Constant(1.0f);
  m.cosh_part = m.sinh_part = swell::HWY_NAMESPACE::Exp(d, k * -below_m);
  m.tanh_kd = one;
  if (modes.depth_m <= 0.0f) return;
  // By e^(-2 k d) and e^(-2 k (d - s)).
  const auto exp_of = [&](float length_m) HWY_ATTR {
    return swell::HWY_NAMESPACE::Exp(d, -Min(k * (2.0f * length_m), Constant(60.0f)));
  };
  const V whole = exp_of(modes.depth_m), rest = exp_of(modes.depth_m - below_m);
  m.cosh_part = m.cosh_part * ((one + rest) / (one + whole));
  m.sinh_part = m.sinh_part * ((one - rest) / (one - whole));
  m.tanh_kd = (one - whole) / (one + whole);
}

HWY_INLINE Modes ModesAt(const SurfaceModes& modes, float below_m, int i, int j) {
  const D d;
  const int n = modes.plan.size;
  const float per_count_x = static_cast<float>(2.0 * kPi / modes.length_m.x);
  const float per_count_y = static_cast<float>(2.0 * kPi / modes.length_m.y);
  const V column = hn::Iota(d, static_cast<float>(i));
  const V half = Constant(static_cast<float>(n / 2));
  const V kx = IfThenElse(column < half, column, column - static_cast<float>(n)) * per_count_x;
  const V ky = Constant(static_cast<float>(wave_count(j, n)) * per_count_y);
  const V k2 = MulAdd(kx, kx, ky * ky);
  const M is_wave = k2 > 0.0f;
  const V k = IfThenElse(is_wave, Sqrt(k2), Constant(modes.mean_rad_m));
  Modes m;
  Decay(modes, below_m, k, m);
  // Waves of two samples have no sign.
  const M has_sign = is_wave & hn::Ne(column, half) & hn::Ne(Constant(static_cast<float>(j)), half);
  m.to_x = IfThenElseZero(has_sign, kx / k);
  m.to_y = IfThenElseZero(has_sign, ky / k);
  m.omega2 = modes.omega2.empty() ? k * m.tanh_kd * static_cast<float>(modes.gravity_mps2)
                                  : hn::LoadU(d, modes.omega2.data() + j * n + i);
  return m;
}

// The field's modes from those of the surface, `at` being that of the first lane.
HWY_INLINE ComplexV FieldOf(const SurfaceModes& modes, MotionField field, const Modes& m,
                            std::size_t at) {
  const D d;
  const SurfaceModes::Field& surface = modes.fields[surface_field(field)];
  const float scale = 1.0f / static_cast<float>(modes.plan.size * modes.plan.size);
  const V re = hn::LoadU(d, surface.re.data() + at) * scale;
  const V im = hn::LoadU(d, surface.im.data() + at) * -scale;
  switch (field) {
    case kVelocityX:
    case kVelocityY:
    case kHead:
      return {re * m.cosh_part, im * m.cosh_part};
    case kVelocityZ:
      return {re * m.sinh_part, im * m.sinh_part};
    case kAccelerationZ: {
      const V rate = -(m.omega2 * m.sinh_part);
      return {re * rate, im * rate};
    }
    default: {  // i k / |k| of the former
      const V to = field == kAccelerationX ? m.to_x : m.to_y;
      const V rate = m.omega2 * m.cosh_part * to / m.tanh_kd;
      return {im * rate, -(re * rate)};
    }
  }
}

void FillBelow(const SurfaceModes& modes, float below_m, MotionField a,
               std::optional<MotionField> b, int column0, float* re, float* im) {
  const D d;
  const int n = modes.plan.size;
  for (int j = 0; j < n; ++j) {
    const auto to = static_cast<std::size_t>(modes.plan.slot[j]) * kFftBatch;
    for (int lane = 0; lane < kFftBatch; lane += static_cast<int>(hn::Lanes(d))) {
      const Modes m = ModesAt(modes, below_m, column0 + lane, j);
      const auto at = static_cast<std::size_t>(j * n + column0 + lane);
      ComplexV f = FieldOf(modes, a, m, at);
      if (b) {
        const ComplexV g = FieldOf(modes, *b, m, at);
        f = {f.re - g.im, f.im + g.re};
      }
      hn::Store(f.re, d, re + to + lane);
      hn::Store(f.im, d, im + to + lane);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::ocean
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::ocean {

HWY_EXPORT(FillBelow);

void find_modes(const std::vector<float>& samples, MotionField field, std::vector<float>& planes,
                SurfaceModes& modes, Workers& workers) {
  const auto n = static_cast<std::size_t>(modes.plan.size);
  SWELL_CHECK(samples.size() == n * n, "{} samples, size={}", samples.size(), n);
  SurfaceModes::Field& to = modes.fields[field];
  to.re.resize(n * n);
  to.im.resize(n * n);
  to.is_made = true;
  const auto fill = [&](int, int column0, float* re, float* im) {
    for (std::size_t j = 0; j < n; ++j) {
      const auto at = static_cast<std::size_t>(modes.plan.slot[j]) * kFftBatch;
      std::copy_n(samples.data() + j * n + static_cast<std::size_t>(column0), kFftBatch, re + at);
      std::fill_n(im + at, kFftBatch, 0.0f);
    }
    return true;
  };
  // The inverse transform of a real field is the conjugate of its transform.
  const FftOutput output = {to.re.data(), to.im.data()};
  inverse_fft_2d(modes.plan, fill, {&output, 1}, planes, workers);
}

bool fill_below(const SurfaceModes& modes, double below_m, MotionField a,
                std::optional<MotionField> b, int column0, float* re, float* im) {
  int nearest = modes.plan.size;
  for (int i = column0; i < column0 + kFftBatch; ++i)
    nearest = std::min(nearest, std::abs(wave_count(i, modes.plan.size)));
  if (kTwoPi / modes.length_m.x * nearest * below_m > kLeastDecay) return false;
  const float floor_m = modes.depth_m > 0.0f ? modes.depth_m : kInfinity<float>;
  HWY_DYNAMIC_DISPATCH(FillBelow)
  (modes, std::min(static_cast<float>(below_m), floor_m), a, b, column0, re, im);
  return true;
}

}  // namespace swell::ocean
#endif  // HWY_ONCE
