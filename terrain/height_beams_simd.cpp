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
  return {hn::Add(hn::Min(hn::Mul(low, t), hn::Mul(low, t_on)), Constant(from - kRounding)),
          hn::Add(hn::Max(hn::Mul(high, t), hn::Mul(high, t_on)), Constant(from + kRounding))};
}

// How far on a beam covers no more than `size` cells along an axis.
HWY_INLINE V Reach(V low, V high, V t, V size) {
  const V wide = hn::Sub(high, low);
  const V speed = hn::Max(hn::Max(hn::Abs(low), hn::Abs(high)), Constant(1e-20f));
  return hn::Div(hn::NegMulAdd(wide, t, size), hn::Add(speed, wide));
}

// Whether a beam has left the grid behind.
HWY_INLINE M Left(const Axis& axis, V low, V high, V t) {
  const V zero = hn::Zero(D()), one = Constant(1.0f);
  const Cover at = CoverOf(axis, low, high, t, t);
  const M before = hn::And(hn::Lt(at.high, hn::Neg(one)), hn::Le(high, zero));
  const M behind = hn::And(hn::Gt(at.low, Constant(axis.cells + 1.0f)), hn::Ge(low, zero));
  return hn::Or(before, behind);
}

// Whether it is above a height and goes up from there.
HWY_INLINE M RisesAbove(V height, const RayHeights& lowest, V t) {
  const V zero = hn::Zero(D());
  const M rises = hn::And(hn::Ge(lowest.z_t, zero), hn::Ge(lowest.z_tt, zero));
  return hn::And(rises, hn::Gt(lowest.At(t), height));
}

// Steps as long as the beam covers two by two blocks at most, larger ones after each that is free.
HWY_INLINE V CastBeam(const HeightPyramid& p, const Axis& axis_x, const Axis& axis_y, V x_low,
                      V x_high, V y_low, V y_high, const RayHeights& lowest, V floor, V t) {
  const D d;
  const DI di;
  constexpr int kMostSteps = 48;
  const VI one = Whole(1);
  VI level =
      LevelOf(hn::Mul(hn::Max(hn::Sub(x_high, x_low), hn::Sub(y_high, y_low)), t), 3, p.levels);
  // One block covers all; a metre above it is beyond rounding.
  const V highest_of_all = Constant(p.base_m + p.step_m * static_cast<float>(p.maxima[1]) + 1.0f);
  M active = hn::FirstN(d, hn::Lanes(d));
  const auto block_of = [&](V cell, VI of_level) HWY_ATTR {
    const V last = Constant(static_cast<float>(p.side) - 1.0f);
    return hn::Shr(hn::ConvertTo(di, hn::Min(hn::Max(cell, hn::Zero(d)), last)), of_level);
  };
  for (int k = 0; k < kMostSteps && !hn::AllFalse(d, active); ++k) {
    const V size = hn::Sub(ToFloat(hn::Shl(one, level)), Constant(0.1f));
    const V way = hn::Min(Reach(x_low, x_high, t, size), Reach(y_low, y_high, t, size));
    const V t_on = hn::Add(t, way);
    const Cover x = CoverOf(axis_x, x_low, x_high, t, t_on);
    const Cover y = CoverOf(axis_y, y_low, y_high, t, t_on);
    const VI i0 = block_of(x.low, level), i1 = block_of(x.high, level);
    const VI j0 = block_of(y.low, level), j1 = block_of(y.high, level);
    const VI blocks = hn::Shr(Whole(p.side), level);
    const auto code = [&](VI i, VI j) HWY_ATTR {
      return GatherCodes(p.maxima.data(), hn::Add(hn::Mul(hn::Add(blocks, j), blocks), i));
    };
    const V highest =
        hn::Max(hn::Max(code(i0, j0), code(i1, j0)), hn::Max(code(i0, j1), code(i1, j1)));
    const V ground = hn::MulAdd(highest, Constant(p.step_m), Constant(p.base_m));
    const V rise = hn::Mul(lowest.z_t, t_on), bend = hn::Mul(hn::Mul(lowest.z_tt, t_on), t_on);
    const V low =
        hn::Max(hn::Add(hn::Add(lowest.z, hn::Min(hn::Mul(hn::Mul(lowest.z_tt, t), t), bend)),
                        hn::Min(hn::Mul(lowest.z_t, t), rise)),
                floor);
    const V size_m = hn::Add(hn::Add(hn::Abs(lowest.z), hn::Abs(bend)), hn::Abs(rise));
    const V rounding = hn::Mul(Constant(1e-6f), size_m);
    const M is_free = hn::And(hn::Gt(way, hn::Zero(d)), hn::Gt(hn::Sub(low, rounding), ground));
    t = hn::IfThenElse(hn::And(active, is_free), t_on, t);
    const M leaves =
        hn::And(hn::And(active, is_free),
                hn::Or(hn::Or(Left(axis_x, x_low, x_high, t), Left(axis_y, y_low, y_high, t)),
                       RisesAbove(highest_of_all, lowest, t)));
    t = hn::IfThenElse(leaves, hn::Inf(d), t);
    active = hn::AndNot(leaves, active);
    const VI coarser = hn::Min(hn::Add(level, one), Whole(p.levels));
    level = IfI(is_free, coarser, hn::Sub(level, one));
    active = hn::And(active, hn::RebindMask(d, hn::Gt(level, Whole(0))));
    level = hn::Max(level, one);
    // A beam that is wider than blocks of this level is too wide for finer ones.
    active = hn::And(active, hn::Or(is_free, hn::Gt(way, hn::Zero(d))));
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
                            HWY_ATTR { return hn::Mul(load(values), per_m); };
    StoreSome(CastBeam(pyramid, axis_x, axis_y, scaled(beams.x_low), scaled(beams.x_high),
                       scaled(beams.y_low), scaled(beams.y_high),
                       {load(beams.z), load(beams.z_t), load(beams.z_tt)}, load(beams.floor),
                       load(beams.begin)),
              n, t_free);
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
