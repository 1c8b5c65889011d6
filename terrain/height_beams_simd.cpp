#include <algorithm>
#include <cmath>

#include "math/check.h"
#include "terrain/height_rays.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "terrain/height_beams_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "terrain/height_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::terrain {
namespace HWY_NAMESPACE {

// What a beam covers along an axis between t and t_on, in cells of the grid.
struct Cover {
  V low, high;
};

HWY_INLINE Cover CoverOf(const Axis& axis, V low, V high, V t, V t_on) {
  constexpr float kRounding = 0.02f;
  const float from = static_cast<float>(axis.whole) + axis.part;
  return {Min(low * t, low * t_on) + (from - kRounding),
          Max(high * t, high * t_on) + (from + kRounding)};
}

// How far on a beam covers no more than `size` cells along an axis.
HWY_INLINE V Reach(V low, V high, V t, V size) {
  const V wide = high - low;
  const V speed = Max(Max(Abs(low), Abs(high)), 1e-20f);
  return NegMulAdd(wide, t, size) / (speed + wide);
}

// Whether a beam has left the grid behind.
HWY_INLINE M Left(const Axis& axis, V low, V high, V t) {
  const V zero = hn::Zero(D()), one = Constant(1.0f);
  const Cover at = CoverOf(axis, low, high, t, t);
  const M before = (at.high < -one) & (high <= zero);
  const M behind = (at.low > axis.cells + 1.0f) & (low >= zero);
  return before | behind;
}

// Whether it is above a height and goes up from there.
HWY_INLINE M RisesAbove(V height, const RayHeights& lowest, V t) {
  const V zero = hn::Zero(D());
  const M rises = (lowest.z_t >= zero) & (lowest.z_tt >= zero);
  return rises & (lowest.At(t) > height);
}

// Beams of rays: at t they lie between (x_low, y_low) t and (x_high, y_high) t, in cells, and no
// lower than `lowest` and `floor`.
struct BeamPacket {
  V x_low, x_high, y_low, y_high;
  RayHeights lowest;
  V floor;
};

// Returns up to where beams are free from t on. Steps as long as the beam covers two by two blocks
// at most, larger ones after each that is free.
HWY_INLINE V CastBeam(const HeightPyramid& p, const Axis& axis_x, const Axis& axis_y,
                      const BeamPacket& beam, V t) {
  const auto& [x_low, x_high, y_low, y_high, lowest, floor] = beam;
  const D d;
  const DI di;
  constexpr int kMostSteps = 48;
  const VI one = Whole(1);
  VI level = LevelOf(Max(x_high - x_low, y_high - y_low) * t, 3, p.levels);
  // One block covers all; a metre above it is beyond rounding.
  const V highest_of_all = Constant(p.base_m + p.step_m * static_cast<float>(p.maxima[1]) + 1.0f);
  M active = hn::FirstN(d, hn::Lanes(d));
  const auto block_of = [&](V cell, VI of_level) HWY_ATTR {
    const V last = Constant(static_cast<float>(p.side) - 1.0f);
    return hn::Shr(hn::ConvertTo(di, Min(Max(cell, 0.0f), last)), of_level);
  };
  for (int k = 0; k < kMostSteps && !hn::AllFalse(d, active); ++k) {
    const V size = ToFloat(hn::Shl(one, level)) - 0.1f;
    const V way = Min(Reach(x_low, x_high, t, size), Reach(y_low, y_high, t, size));
    const V t_on = t + way;
    const Cover x = CoverOf(axis_x, x_low, x_high, t, t_on);
    const Cover y = CoverOf(axis_y, y_low, y_high, t, t_on);
    const VI i0 = block_of(x.low, level), i1 = block_of(x.high, level);
    const VI j0 = block_of(y.low, level), j1 = block_of(y.high, level);
    const VI blocks = hn::Shr(Whole(p.side), level);
    const auto code = [&](VI i, VI j) HWY_ATTR {
      return GatherCodes(p.maxima.data(), (blocks + j) * blocks + i);
    };
    const V highest = Max(Max(code(i0, j0), code(i1, j0)), Max(code(i0, j1), code(i1, j1)));
    const V ground = MulAdd(highest, p.step_m, p.base_m);
    const V rise = lowest.z_t * t_on, bend = lowest.z_tt * t_on * t_on;
    const V low = Max(lowest.z + Min(lowest.z_tt * t * t, bend) + Min(lowest.z_t * t, rise), floor);
    const V size_m = Abs(lowest.z) + Abs(bend) + Abs(rise);
    const V rounding = 1e-6f * size_m;
    const M is_free = (way > 0.0f) & (low - rounding > ground);
    t = IfThenElse(active & is_free, t_on, t);
    const M leaves =
        (active & is_free) & ((Left(axis_x, x_low, x_high, t) | Left(axis_y, y_low, y_high, t)) |
                              RisesAbove(highest_of_all, lowest, t));
    t = IfThenElse(leaves, hn::Inf(d), t);
    active = hn::AndNot(leaves, active);
    const VI coarser = Min(level + one, Whole(p.levels));
    level = IfI(is_free, coarser, level - one);
    active = active & hn::RebindMask(d, level > Whole(0));
    level = Max(level, one);
    // A beam that is wider than blocks of this level is too wide for finer ones.
    active = active & (is_free | (way > 0.0f));
  }
  return t;
}

void CastBeams(const HeightPyramid& pyramid, glm::dvec2 from_world, const HeightBeams& beams,
               std::span<float> t_free) {
  const Grid& grid = pyramid.grid;
  const glm::dvec2 from = from_world - grid.min_world;
  const Axis axis_x(from.x, grid.spacing_m, grid.samples_x);
  const Axis axis_y(from.y, grid.spacing_m, grid.samples_y);
  const V per_m = Constant(static_cast<float>(1.0 / grid.spacing_m));
  for (std::size_t n = 0; n < t_free.size(); n += kLanes) {
    const auto load = [&](std::span<const float> values) HWY_ATTR { return LoadSome(values, n); };
    const auto scaled = [&](std::span<const float> values)
                            HWY_ATTR { return load(values) * per_m; };
    const BeamPacket beam = {scaled(beams.x_low),
                             scaled(beams.x_high),
                             scaled(beams.y_low),
                             scaled(beams.y_high),
                             {load(beams.z), load(beams.z_t), load(beams.z_tt)},
                             load(beams.floor)};
    StoreSome(CastBeam(pyramid, axis_x, axis_y, beam, load(beams.begin)), n, t_free);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::terrain
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::terrain {

HWY_EXPORT(CastBeams);

void cast_beams(const HeightPyramid& pyramid, glm::dvec2 from_world, const HeightBeams& beams,
                std::span<float> t_free) {
  const std::size_t count = t_free.size();
  for (const auto& values : {beams.x_low, beams.x_high, beams.y_low, beams.y_high, beams.z,
                             beams.z_t, beams.z_tt, beams.floor, beams.begin})
    SWELL_CHECK(values.size() == count, "beams={} values={}", count, values.size());
  HWY_DYNAMIC_DISPATCH(CastBeams)(pyramid, from_world, beams, t_free);
}

}  // namespace swell::terrain
#endif
