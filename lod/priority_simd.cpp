#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lod/priority.h"
#include "math/check.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lod/priority_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace swell::lod {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::ScalableTag<float>;
using I = hn::RebindToSigned<F>;

// One axis, its origin at the eye or another point; no operand is ever NaN.
struct Axis {
  hn::Vec<I> floor;
  hn::Vec<F> fraction;

  HWY_INLINE hn::Vec<F> Relative(hn::Vec<I> lattice) const {
    return hn::Sub(hn::ConvertTo(F(), hn::Sub(lattice, floor)), fraction);
  }
};

HWY_INLINE Axis MakeAxis(int floor, float fraction) {
  return {hn::Set(I(), floor), hn::Set(F(), fraction)};
}

// Distance from 0 to [low, high].
HWY_INLINE hn::Vec<F> DistanceTo(hn::Vec<F> low, hn::Vec<F> high) {
  return hn::Max(hn::Max(low, hn::Neg(high)), hn::Zero(F()));
}

// Subtrees' boxes on the lattice, cut to the domain.
struct Boxes {
  hn::Vec<I> x_low, x_high, y_low, y_high;
};

struct Interval {
  hn::Vec<F> low, high;
};

// The products of members of two intervals.
HWY_INLINE Interval Product(Interval a, Interval b) {
  const auto p = hn::Mul(a.low, b.low), q = hn::Mul(a.low, b.high);
  const auto r = hn::Mul(a.high, b.low), s = hn::Mul(a.high, b.high);
  return {hn::Min(hn::Min(p, q), hn::Min(r, s)), hn::Max(hn::Max(p, q), hn::Max(r, s))};
}

// What the surface in boxes can be: slopes along x and y, and z relative to the eye.
struct Relief {
  Interval slope_x, slope_y, z;
};

// The largest codes in the cells under the corners of each box; two words, as of ReliefCell.
struct ReliefCodes {
  hn::Vec<I> slope, height;
};

HWY_INLINE ReliefCodes CodesUnder(const PriorityFrame& frame, const Boxes& box, hn::Vec<I> level) {
  const I di;
  const auto zero = hn::Zero(di), one = hn::Set(di, 1);
  const auto finest = hn::Set(di, frame.relief.levels - 1);
  const auto q = hn::Min(
      hn::Max(hn::Sub(hn::ShiftRight<1>(hn::Add(level, one)), hn::Set(di, 2)), zero), finest);
  const auto begin = hn::And(hn::Set(di, 0x55555555), hn::Sub(hn::Shl(one, hn::Add(q, q)), one));
  const auto shift = hn::Sub(hn::Set(di, frame.lattice_bits), q);
  const auto west = hn::Shr(box.x_low, shift), east = hn::Shr(hn::Sub(box.x_high, one), shift);
  const auto south = hn::Add(begin, hn::Shl(hn::Shr(box.y_low, shift), q));
  const auto north = hn::Add(begin, hn::Shl(hn::Shr(hn::Sub(box.y_high, one), shift), q));

  static_assert(sizeof(ReliefCell) == 8);
  const auto* words = reinterpret_cast<const std::int32_t*>(frame.relief.cells.data());
  const auto largest = [&](auto codes_tag, int word) HWY_ATTR {
    const auto at = [&](hn::Vec<I> row, hn::Vec<I> column) HWY_ATTR {
      const auto number = hn::Add(row, column);
      return hn::BitCast(codes_tag, hn::GatherIndex(di, words + word, hn::Add(number, number)));
    };
    return hn::BitCast(di, hn::Max(hn::Max(at(south, west), at(south, east)),
                                   hn::Max(at(north, west), at(north, east))));
  };
  return {largest(hn::Repartition<std::int8_t, F>(), 0),
          largest(hn::Repartition<std::int16_t, F>(), 1)};
}

HWY_INLINE Relief ReliefIn(const PriorityFrame& frame, const Boxes& box, hn::Vec<I> level) {
  const F d;
  const ReliefFrame& relief = frame.relief;
  const auto most = hn::Set(d, relief.max_slope);
  if (relief.cells.empty())
    return {{hn::Neg(most), most},
            {hn::Neg(most), most},
            {hn::Set(d, relief.z_low), hn::Set(d, relief.z_high)}};
  const ReliefCodes codes = CodesUnder(frame, box, level);
  const auto slope = [&](auto code_on_top) HWY_ATTR {
    return hn::Mul(hn::ConvertTo(d, hn::ShiftRight<24>(code_on_top)),
                   hn::Set(d, relief.slope_unit));
  };
  const auto height = [&](auto code_on_top) HWY_ATTR {
    return hn::Mul(hn::ConvertTo(d, hn::ShiftRight<16>(code_on_top)),
                   hn::Set(d, relief.height_unit));
  };
  const auto eye_z = hn::Set(d, relief.eye_z);
  return {{hn::Neg(slope(hn::ShiftLeft<16>(codes.slope))), slope(hn::ShiftLeft<24>(codes.slope))},
          {hn::Neg(slope(codes.slope)), slope(hn::ShiftLeft<8>(codes.slope))},
          {hn::Sub(hn::Neg(height(codes.height)), eye_z),
           hn::Sub(height(hn::ShiftLeft<16>(codes.height)), eye_z)}};
}

// How much further away than it is a part with this relief counts, squared.
HWY_INLINE hn::Vec<F> ReliefFactor(const ReliefFrame& frame, const Relief& relief, Interval x,
                                   Interval y) {
  const F d;
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  const Interval along_x = Product(relief.slope_x, x), along_y = Product(relief.slope_y, y);
  const auto facing_most = hn::Sub(hn::Add(along_x.high, along_y.high), relief.z.low);
  const auto facing_least = hn::Sub(hn::Add(along_x.low, along_y.low), relief.z.high);
  const auto silhouette = hn::And(hn::Le(facing_least, zero), hn::Ge(facing_most, zero));
  const auto back = hn::Lt(facing_most, zero);

  const auto width = hn::Max(hn::Sub(relief.slope_x.high, relief.slope_x.low),
                             hn::Sub(relief.slope_y.high, relief.slope_y.low));
  const auto spread = hn::Min(hn::Mul(width, hn::Set(d, kInvFullSpread)), one);
  const auto flat = hn::Add(one, hn::Mul(hn::Set(d, frame.flat_gain), hn::Sub(one, spread)));
  const auto by_facing = hn::Mul(hn::IfThenElse(back, hn::Set(d, frame.back_facing), one),
                                 hn::IfThenElse(silhouette, one, hn::Set(d, frame.off_silhouette)));
  const auto below = hn::Lt(relief.z.high, hn::Set(d, -frame.eye_z));
  const auto by_place = hn::Mul(by_facing, hn::IfThenElse(below, hn::Set(d, frame.sunken), one));
  return hn::Mul(by_place, hn::Mul(flat, flat));
}

// (1 + d / (8 D))^16
HWY_INLINE hn::Vec<F> HazeFactor(hn::Vec<F> distance, float inv_haze) {
  const F d;
  const auto share = hn::Min(hn::Mul(distance, hn::Set(d, inv_haze)), hn::Set(d, kMostHaze));
  const auto q = hn::Add(hn::Set(d, 1.0f), share);
  const auto q2 = hn::Mul(q, q), q4 = hn::Mul(q2, q2), q8 = hn::Mul(q4, q4);
  return hn::Mul(q8, q8);
}

HWY_INLINE hn::Mask<F> TouchesAFocus(const FocusFrame& focus, const Boxes& box, hn::Vec<I> level) {
  const F d;
  const I di;
  auto touches = hn::FirstN(d, 0);
  const auto apart = hn::Or(hn::Or(hn::Gt(box.x_low, hn::Set(di, focus.high.x)),
                                   hn::Lt(box.x_high, hn::Set(di, focus.low.x))),
                            hn::Or(hn::Gt(box.y_low, hn::Set(di, focus.high.y)),
                                   hn::Lt(box.y_high, hn::Set(di, focus.low.y))));
  if (hn::AllTrue(di, apart)) return touches;
  for (std::size_t i = 0; i < static_cast<std::size_t>(focus.count); ++i) {
    const Axis x = MakeAxis(focus.centre_floor[i].x, focus.centre_fraction[i].x);
    const Axis y = MakeAxis(focus.centre_floor[i].y, focus.centre_fraction[i].y);
    const auto dx = DistanceTo(x.Relative(box.x_low), x.Relative(box.x_high));
    const auto dy = DistanceTo(y.Relative(box.y_low), y.Relative(box.y_high));
    const auto distance2 = hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy));
    const auto inside = hn::Le(distance2, hn::Set(d, focus.radius2[i]));
    const auto narrow = hn::RebindMask(d, hn::Gt(level, hn::Set(di, focus.last_level[i])));
    touches = hn::Or(touches, hn::AndNot(narrow, inside));
  }
  return hn::AndNot(hn::RebindMask(d, apart), touches);
}

HWY_INLINE hn::Vec<F> PowerOfTwo(hn::Vec<I> exponent) {
  return hn::BitCast(F(), hn::ShiftLeft<23>(hn::Add(exponent, hn::Set(I(), 127))));
}

// The keys of one vector of diamonds; priority_key in priority.cpp says the same in scalars.
template <bool kWithFactors>
HWY_INLINE hn::Vec<I> Keys(const PriorityFrame& frame, const Axis& axis_x, const Axis& axis_y,
                           hn::Vec<I> x, hn::Vec<I> y, hn::Vec<I> level) {
  const F d;
  const I di;
  const auto zero = hn::Zero(di), n = hn::Set(di, 1 << frame.lattice_bits);

  // The subtree's box, cut to the domain.
  const auto one = hn::Set(di, 1);
  const auto h = hn::Shr(n, hn::Add(hn::ShiftRight<1>(level), one));
  const auto half = hn::Mul(h, hn::Sub(hn::Set(di, 3), hn::And(level, one)));
  const Boxes box{hn::Max(hn::Sub(x, half), zero), hn::Min(hn::Add(x, half), n),
                  hn::Max(hn::Sub(y, half), zero), hn::Min(hn::Add(y, half), n)};
  const auto x_low = axis_x.Relative(box.x_low), x_high = axis_x.Relative(box.x_high);
  const auto y_low = axis_y.Relative(box.y_low), y_high = axis_y.Relative(box.y_high);

  // Outside one of the planes, sunk as far as any of it may be?
  auto outside = hn::FirstN(d, 0);
  const auto far_x = hn::Max(hn::Neg(x_low), x_high), far_y = hn::Max(hn::Neg(y_low), y_high);
  const auto most_drop = hn::Mul(hn::Add(hn::Mul(far_x, far_x), hn::Mul(far_y, far_y)),
                                 hn::Set(d, frame.drop_per_step2));
  for (const PriorityFrame::Plane& plane : frame.planes) {
    const auto nx = hn::Set(d, plane.nx), ny = hn::Set(d, plane.ny);
    const auto most_x = hn::Max(hn::Mul(nx, x_low), hn::Mul(nx, x_high));
    const auto most_y = hn::Max(hn::Mul(ny, y_low), hn::Mul(ny, y_high));
    const auto most_z =
        hn::Add(hn::Mul(most_drop, hn::Set(d, plane.by_drop)), hn::Set(d, plane.max_z));
    const auto most = hn::Add(hn::Add(most_x, most_y), most_z);
    outside = hn::Or(outside, hn::Lt(most, hn::Zero(d)));
  }

  // (distance / size)^2.
  const auto dx = DistanceTo(x_low, x_high), dy = DistanceTo(y_low, y_high);
  const auto horizontal2 = hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy));
  outside = hn::Or(outside, hn::Gt(horizontal2, hn::Set(d, frame.horizon2)));
  auto distance2_z = hn::Set(d, frame.distance2_z);
  auto relief_factor = hn::Set(d, 1.0f);
  if constexpr (kWithFactors) {
    if (frame.relief.counts) {
      const Relief relief = ReliefIn(frame, box, level);
      const auto dz = DistanceTo(relief.z.low, relief.z.high);
      distance2_z = hn::Mul(dz, dz);
      relief_factor = ReliefFactor(frame.relief, relief, {x_low, x_high}, {y_low, y_high});
    }
  }
  const auto distance2 = hn::Add(horizontal2, distance2_z);
  const auto inv_size2 = hn::Max(PowerOfTwo(hn::And(level, hn::Set(di, frame.level_mask))),
                                 hn::Set(d, frame.least_inv_size2));
  const auto inv_curved2 =
      hn::Mul(PowerOfTwo(hn::Add(level, level)), hn::Set(d, frame.curvature_inv_size2));
  auto key = hn::Mul(distance2, hn::Min(inv_size2, inv_curved2));
  if constexpr (kWithFactors) {
    key = hn::Mul(key, relief_factor);
    if (frame.inv_haze > 0.0f) key = hn::Mul(key, HazeFactor(hn::Sqrt(distance2), frame.inv_haze));
    const auto focused = TouchesAFocus(frame.focus, box, level);
    key = hn::IfThenElse(focused, hn::Mul(key, hn::Set(d, frame.focus.factor)), key);
    key = hn::Min(key, hn::Set(d, kLastKey));
  }
  const auto culled = hn::BitCast(d, hn::Set(di, static_cast<std::int32_t>(kCulledKey)));
  return hn::BitCast(di, hn::IfThenElse(outside, culled, key));
}

template <bool kWithFactors>
void ComputeAllKeys(const PriorityFrame& frame, std::size_t count, const std::int32_t* x,
                    const std::int32_t* y, const std::int32_t* level, PriorityKey* keys) {
  const F d;
  const I di;
  const hn::RebindToUnsigned<F> du;
  const Axis axis_x = MakeAxis(frame.eye_floor.x, frame.eye_fraction.x);
  const Axis axis_y = MakeAxis(frame.eye_floor.y, frame.eye_fraction.y);
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
    const auto key = Keys<kWithFactors>(frame, axis_x, axis_y, hn::LoadU(di, x + i),
                                        hn::LoadU(di, y + i), hn::LoadU(di, level + i));
    hn::StoreU(hn::BitCast(du, key), du, keys + i);
  }
  for (; i < count; ++i) keys[i] = priority_key(frame, x[i], y[i], level[i]);
}

void ComputeKeys(const PriorityFrame& frame, std::size_t count, const std::int32_t* x,
                 const std::int32_t* y, const std::int32_t* level, PriorityKey* keys) {
  if (frame.has_factors)
    ComputeAllKeys<true>(frame, count, x, y, level, keys);
  else
    ComputeAllKeys<false>(frame, count, x, y, level, keys);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::lod
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::lod {

HWY_EXPORT(ComputeKeys);

void compute_priority_keys(const PriorityFrame& frame, std::span<const std::int32_t> x,
                           std::span<const std::int32_t> y, std::span<const std::int32_t> level,
                           std::span<PriorityKey> keys) {
  SWELL_CHECK(x.size() == keys.size() && y.size() == keys.size() && level.size() == keys.size(),
              "x={} y={} level={} keys={}", x.size(), y.size(), level.size(), keys.size());
  HWY_DYNAMIC_DISPATCH(ComputeKeys)
  (frame, keys.size(), x.data(), y.data(), level.data(), keys.data());
}

}  // namespace swell::lod
#endif
