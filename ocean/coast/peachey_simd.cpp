#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "math/check.h"
#include "ocean/coast/peachey.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ocean/coast/peachey_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "math/elementary-inl.h"
#include "ocean/spectrum/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::ocean {
namespace HWY_NAMESPACE {

// A place along one axis of the grid: the cell, and the samples from its lower border. Beyond the
// grid `free` leaves [0, 1]; `held` stays, and then does not change with the place: rate 0.
struct AxisPlace {
  VI cell;
  V free, held, rate;
};

struct HalfPlace {
  hn::Vec<DHalfInt> cell;
  hn::Vec<DHalf> free;
};

HWY_INLINE HalfPlace FindHalf(VDouble x_m, double min_m, double spacing_m, int cells) {
  const DDouble dd;
  const auto u = (x_m - hn::Set(dd, min_m)) / hn::Set(dd, spacing_m);
  // Compare and select: NaN ends in cell 0.
  const auto first = hn::Zero(dd), last = hn::Set(dd, cells - 1);
  auto cell = Floor(u);
  cell = IfThenElse(cell > first, cell, first);
  cell = IfThenElse(cell < last, cell, last);
  return {hn::DemoteTo(DHalfInt(), cell), hn::DemoteTo(DHalf(), u - cell)};
}

HWY_INLINE AxisPlace FindAxis(VDouble low_m, VDouble high_m, double min_m, double spacing_m,
                              int cells) {
  const D d;
  const HalfPlace low = FindHalf(low_m, min_m, spacing_m, cells);
  const HalfPlace high = FindHalf(high_m, min_m, spacing_m, cells);
  const V free = hn::Combine(d, high.free, low.free);
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  const auto below = free<zero, above = free> one;
  const V held = IfThenElse(above, one, IfThenElse(below, zero, free));
  return {hn::Combine(DI(), high.cell, low.cell), free, held, IfThenElse(below | above, zero, one)};
}

// A value and its derivative by x and y, per sample spacing.
struct Sampled {
  V value, dx, dy;
};

// Values that go on beyond the grid as they are on its border.
HWY_INLINE Sampled SampleHeld(const float* coefficients, VI offset, const AxisPlace& x,
                              const AxisPlace& y) {
  const D d;
  const V c0 = hn::GatherIndex(d, coefficients, offset);
  const V c1 = hn::GatherIndex(d, coefficients + 1, offset);
  const V c2 = hn::GatherIndex(d, coefficients + 2, offset);
  const V c3 = hn::GatherIndex(d, coefficients + 3, offset);
  const V by_x = MulAdd(c3, y.held, c1), by_y = MulAdd(c3, x.held, c2);
  const V value = MulAdd(c2, y.held, MulAdd(by_x, x.held, c0));
  return {value, by_x * x.rate, by_y * y.rate};
}

// Values that go on beyond the grid with their slope.
HWY_INLINE Sampled SampleFree(const float* coefficients, VI offset, const AxisPlace& x,
                              const AxisPlace& y) {
  const D d;
  const V c0 = hn::GatherIndex(d, coefficients, offset);
  const V c1 = hn::GatherIndex(d, coefficients + 1, offset);
  const V c2 = hn::GatherIndex(d, coefficients + 2, offset);
  const V c3 = hn::GatherIndex(d, coefficients + 3, offset);
  const V twist = x.held * y.held;
  const V plane = MulAdd(c2, y.free, MulAdd(c1, x.free, c0));
  return {MulAdd(c3, twist, plane), MulAdd(c3 * y.held, x.rate, c1),
          MulAdd(c3 * x.held, y.rate, c2)};
}

// The shore's part of the profile, and its derivative by the depth.
struct Blend {
  V part, rate;
};

HWY_INLINE Blend FindBlend(V depth_m, float deep_m, float shallow_m) {
  const D d;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  const V per_m = hn::Set(d, 1.0f / (deep_m - shallow_m));
  const V x = (deep_m - depth_m) * per_m;
  const V held = IfThenElse(x > one, one, IfThenElse(x > zero, x, zero));
  const V x2 = held * held;
  const V part = x2 * NegMulAdd(2.0f, held, 3.0f);
  // 6 x (1 - x) dx/dh; 0 at both ends.
  const V rate = -6.0f * ((held - x2) * per_m);
  return {part, rate};
}

// Adds one train to the height and, per sample spacing, the slopes.
template <bool kSlopes>
HWY_INLINE void AddTrain(const Sampled& theta, const Sampled& amplitude, const Sampled& depth,
                         const Blend& blend, V time_cycles, Sampled& z) {
  const D d;
  const V turns = theta.value - time_cycles;
  const V u = turns - Floor(turns);  // [0, 1]
  // Deep and shallow profile.
  V s, c;
  swell::HWY_NAMESPACE::SinCosTurns(d, u, s, c);
  const V centred = u - 0.5f;
  const V crest = MulAdd(8.0f * centred, centred, -1.0f);
  const V between = crest - c;
  const V w = MulAdd(blend.part, between, c);
  z.value = MulAdd(amplitude.value, w, z.value);
  if constexpr (kSlopes) {
    // d(A w) = w dA + A (w_u d theta + w_b d b).
    const V deep_rate = -6.2831853f * s;
    const V crest_rate = 16.0f * centred;
    const V w_u = MulAdd(blend.part, crest_rate - deep_rate, deep_rate);
    const V by_theta = amplitude.value * w_u;
    const V by_depth = amplitude.value * (between * blend.rate);
    z.dx = MulAdd(w, amplitude.dx, MulAdd(by_theta, theta.dx, z.dx));
    z.dy = MulAdd(w, amplitude.dy, MulAdd(by_theta, theta.dy, z.dy));
    z.dx = MulAdd(by_depth, depth.dx, z.dx);
    z.dy = MulAdd(by_depth, depth.dy, z.dy);
  }
}

// One packet of world points.
template <bool kSlopes>
HWY_INLINE Sampled TrainsPacket(const TrainSea& sea, const float* time_cycles,
                                const glm::dvec2* p_world) {
  const D d;
  const DDouble dd;
  // Find the cell.
  const double* const p = &p_world->x;
  VDouble x_low, y_low, x_high, y_high;
  hn::LoadInterleaved2(dd, p, x_low, y_low);
  hn::LoadInterleaved2(dd, p + 2 * hn::Lanes(dd), x_high, y_high);
  const double spacing_m = sea.grid.spacing_m;
  const AxisPlace x = FindAxis(x_low, x_high, sea.grid.min_world.x, spacing_m, sea.cells_x);
  const AxisPlace y = FindAxis(y_low, y_high, sea.grid.min_world.y, spacing_m, sea.cells_y);
  const VI cell = y.cell * sea.cells_x + x.cell;
  // Add up the trains.
  const Sampled depth = SampleHeld(sea.depth.data(), hn::ShiftLeft<2>(cell), x, y);
  const VI offset = cell * (8 * sea.trains);
  Sampled z{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  for (int i = 0; i < sea.trains; ++i) {
    const float* const wave = sea.waves.data() + 8 * i;
    const Sampled theta = SampleFree(wave, offset, x, y);
    const Sampled amplitude = SampleHeld(wave + 4, offset, x, y);
    const Blend blend = FindBlend(depth.value, sea.deep_depth_m[static_cast<std::size_t>(i)],
                                  sea.shallow_depth_m[static_cast<std::size_t>(i)]);
    AddTrain<kSlopes>(theta, amplitude, depth, blend, hn::Set(d, time_cycles[i]), z);
  }
  const V per_m = hn::Set(d, static_cast<float>(1.0 / spacing_m));
  return {z.value, z.dx * per_m, z.dy * per_m};
}

// Where the results go; slopes null if not wanted.
template <bool kSlopes>
HWY_INLINE void StorePacket(const Sampled& z, float* height_m, float* slope_x, float* slope_y) {
  const D d;
  hn::StoreU(z.value, d, height_m);
  if constexpr (kSlopes) {
    hn::StoreU(z.dx, d, slope_x);
    hn::StoreU(z.dy, d, slope_y);
  }
}

// Full packets, then one more for what is left, filled up with copies of the first point.
template <bool kSlopes>
HWY_INLINE void SampleAll(const TrainSea& sea, const float* time_cycles,
                          std::span<const glm::dvec2> p_world, float* height_m, float* slope_x,
                          float* slope_y) {
  constexpr std::size_t kMost = hn::MaxLanes(D());
  const std::size_t lanes = hn::Lanes(D());
  std::size_t i = 0;
  for (; i + lanes <= p_world.size(); i += lanes) {
    const Sampled z = TrainsPacket<kSlopes>(sea, time_cycles, p_world.data() + i);
    StorePacket<kSlopes>(z, height_m + i, kSlopes ? slope_x + i : nullptr,
                         kSlopes ? slope_y + i : nullptr);
  }
  if (i == p_world.size()) return;
  std::array<glm::dvec2, kMost> points;
  points.fill(p_world[i]);
  std::copy(p_world.begin() + static_cast<std::ptrdiff_t>(i), p_world.end(), points.begin());
  alignas(64) std::array<float, kMost> z, dx, dy;
  StorePacket<kSlopes>(TrainsPacket<kSlopes>(sea, time_cycles, points.data()), z.data(), dx.data(),
                       dy.data());
  const std::size_t rest = p_world.size() - i;
  std::copy_n(z.begin(), rest, height_m + i);
  if constexpr (kSlopes) {
    std::copy_n(dx.begin(), rest, slope_x + i);
    std::copy_n(dy.begin(), rest, slope_y + i);
  }
}

void SampleHeights(const TrainSea& sea, const float* time_cycles,
                   std::span<const glm::dvec2> p_world, float* height_m) {
  SampleAll<false>(sea, time_cycles, p_world, height_m, nullptr, nullptr);
}

void SampleSlopes(const TrainSea& sea, const float* time_cycles,
                  std::span<const glm::dvec2> p_world, float* height_m, float* slope_x,
                  float* slope_y) {
  SampleAll<true>(sea, time_cycles, p_world, height_m, slope_x, slope_y);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::ocean
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::ocean {
namespace {

// t / T of each train, less its whole part.
std::array<float, kMaxTrains> find_time_cycles(const TrainSea& sea, double t_s) {
  SWELL_CHECK(sea.trains <= kMaxTrains, "trains={}", sea.trains);
  SWELL_CHECK(std::isfinite(t_s), "t_s={}", t_s);
  SWELL_CHECK(sea.cells_x > 0 && sea.cells_y > 0, "cells={}x{}", sea.cells_x, sea.cells_y);
  std::array<float, kMaxTrains> cycles{};
  for (std::size_t i = 0; i < sea.period_s.size(); ++i) {
    const double turns = t_s / sea.period_s[i];
    cycles[i] = static_cast<float>(turns - std::floor(turns));
  }
  return cycles;
}

}  // namespace

HWY_EXPORT(SampleHeights);
HWY_EXPORT(SampleSlopes);

void sample_trains(const TrainSea& sea, double t_s, std::span<const glm::dvec2> p_world,
                   std::span<float> height_m) {
  SWELL_CHECK(p_world.size() == height_m.size(), "{} points, {} heights", p_world.size(),
              height_m.size());
  const std::array<float, kMaxTrains> cycles = find_time_cycles(sea, t_s);
  HWY_DYNAMIC_DISPATCH(SampleHeights)(sea, cycles.data(), p_world, height_m.data());
}

void sample_trains(const TrainSea& sea, double t_s, std::span<const glm::dvec2> p_world,
                   std::span<float> height_m, std::span<float> slope_x, std::span<float> slope_y) {
  SWELL_CHECK(p_world.size() == height_m.size() && p_world.size() == slope_x.size() &&
                  p_world.size() == slope_y.size(),
              "{} points, {} heights, {} and {} slopes", p_world.size(), height_m.size(),
              slope_x.size(), slope_y.size());
  const std::array<float, kMaxTrains> cycles = find_time_cycles(sea, t_s);
  HWY_DYNAMIC_DISPATCH(SampleSlopes)
  (sea, cycles.data(), p_world, height_m.data(), slope_x.data(), slope_y.data());
}

}  // namespace swell::ocean
#endif  // HWY_ONCE
