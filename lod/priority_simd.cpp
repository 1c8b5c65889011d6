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

#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::lod {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

// One axis, its origin at the eye or another point; no operand is ever NaN.
struct Axis {
  VI floor;
  V fraction;

  HWY_INLINE V Relative(VI lattice) const { return hn::ConvertTo(D(), lattice - floor) - fraction; }
};

HWY_INLINE Axis MakeAxis(int floor, float fraction) {
  return {hn::Set(DI(), floor), hn::Set(D(), fraction)};
}

// Distance from 0 to [low, high].
HWY_INLINE V DistanceTo(V low, V high) { return Max(Max(low, -high), hn::Zero(D())); }

// Subtrees' boxes on the lattice, cut to the domain.
struct Boxes {
  VI x_low, x_high, y_low, y_high;
};

struct Interval {
  V low, high;
};

// The products of members of two intervals.
HWY_INLINE Interval Product(Interval a, Interval b) {
  const auto p = a.low * b.low, q = a.low * b.high;
  const auto r = a.high * b.low, s = a.high * b.high;
  return {Min(Min(p, q), Min(r, s)), Max(Max(p, q), Max(r, s))};
}

// What the surface in boxes can be: slopes along x and y, and z relative to the eye.
struct Relief {
  Interval slope_x, slope_y, z;
};

// The largest codes in the cells under the corners of each box; two words, as of ReliefCell.
struct ReliefCodes {
  VI slope, height;
};

HWY_INLINE ReliefCodes CodesUnder(const PriorityFrame& frame, const Boxes& box, VI level) {
  const DI di;
  const auto zero = hn::Zero(di), one = hn::Set(di, 1);
  const auto finest = hn::Set(di, frame.relief.levels - 1);
  const auto q = Min(Max(hn::ShiftRight<1>(level + one) - 2, zero), finest);
  const auto begin = 0x55555555 & (hn::Shl(one, q + q) - one);
  const auto shift = frame.lattice_bits - q;
  const auto west = hn::Shr(box.x_low, shift), east = hn::Shr(box.x_high - one, shift);
  const auto south = begin + hn::Shl(hn::Shr(box.y_low, shift), q);
  const auto north = begin + hn::Shl(hn::Shr(box.y_high - one, shift), q);

  static_assert(sizeof(ReliefCell) == 8);
  const auto* words = reinterpret_cast<const std::int32_t*>(frame.relief.cells.data());
  const auto largest = [&](auto codes_tag, int word) HWY_ATTR {
    const auto at = [&](VI row, VI column) HWY_ATTR {
      const auto number = row + column;
      return hn::BitCast(codes_tag, hn::GatherIndex(di, words + word, number + number));
    };
    return hn::BitCast(
        di, Max(Max(at(south, west), at(south, east)), Max(at(north, west), at(north, east))));
  };
  return {largest(hn::Repartition<std::int8_t, D>(), 0),
          largest(hn::Repartition<std::int16_t, D>(), 1)};
}

HWY_INLINE Relief ReliefIn(const PriorityFrame& frame, const Boxes& box, VI level) {
  const D d;
  const ReliefFrame& relief = frame.relief;
  const auto most = hn::Set(d, relief.max_slope);
  if (relief.cells.empty())
    return {{-most, most}, {-most, most}, {hn::Set(d, relief.z_low), hn::Set(d, relief.z_high)}};
  const ReliefCodes codes = CodesUnder(frame, box, level);
  const auto slope = [&](auto code_on_top) HWY_ATTR {
    return hn::ConvertTo(d, hn::ShiftRight<24>(code_on_top)) * relief.slope_unit;
  };
  const auto height = [&](auto code_on_top) HWY_ATTR {
    return hn::ConvertTo(d, hn::ShiftRight<16>(code_on_top)) * relief.height_unit;
  };
  const auto eye_z = hn::Set(d, relief.eye_z);
  return {{-slope(hn::ShiftLeft<16>(codes.slope)), slope(hn::ShiftLeft<24>(codes.slope))},
          {-slope(codes.slope), slope(hn::ShiftLeft<8>(codes.slope))},
          {-height(codes.height) - eye_z, height(hn::ShiftLeft<16>(codes.height)) - eye_z}};
}

// How much further away than it is a part with this relief counts, squared.
HWY_INLINE V ReliefFactor(const ReliefFrame& frame, const Relief& relief, Interval x, Interval y) {
  const D d;
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  const Interval along_x = Product(relief.slope_x, x), along_y = Product(relief.slope_y, y);
  const auto facing_most = along_x.high + along_y.high - relief.z.low;
  const auto facing_least = along_x.low + along_y.low - relief.z.high;
  const auto silhouette = (facing_least <= zero) & (facing_most >= zero);
  const auto back = facing_most < zero;

  const auto width =
      Max(relief.slope_x.high - relief.slope_x.low, relief.slope_y.high - relief.slope_y.low);
  const auto spread = Min(width * kInvFullSpread, one);
  const auto flat = one + frame.flat_gain * (one - spread);
  const auto by_facing =
      IfThenElse(back, frame.back_facing, one) * IfThenElse(silhouette, one, frame.off_silhouette);
  const auto below = relief.z.high < -frame.eye_z;
  const auto by_place = by_facing * IfThenElse(below, frame.sunken, one);
  return by_place * (flat * flat);
}

// (1 + d / (8 D))^16
HWY_INLINE V HazeFactor(V distance, float inv_haze) {
  const auto share = Min(distance * inv_haze, kMostHaze);
  const auto q = 1.0f + share;
  const auto q2 = q * q, q4 = q2 * q2, q8 = q4 * q4;
  return q8 * q8;
}

HWY_INLINE M TouchesAFocus(const FocusFrame& focus, const Boxes& box, VI level) {
  const D d;
  const DI di;
  auto touches = hn::FirstN(d, 0);
  const auto apart = ((box.x_low > focus.high.x) | (box.x_high < focus.low.x)) |
                     ((box.y_low > focus.high.y) | (box.y_high < focus.low.y));
  if (hn::AllTrue(di, apart)) return touches;
  for (std::size_t i = 0; i < static_cast<std::size_t>(focus.count); ++i) {
    const Axis x = MakeAxis(focus.centre_floor[i].x, focus.centre_fraction[i].x);
    const Axis y = MakeAxis(focus.centre_floor[i].y, focus.centre_fraction[i].y);
    const auto dx = DistanceTo(x.Relative(box.x_low), x.Relative(box.x_high));
    const auto dy = DistanceTo(y.Relative(box.y_low), y.Relative(box.y_high));
    const auto distance2 = dx * dx + dy * dy;
    const auto inside = distance2 <= focus.radius2[i];
    const auto narrow = hn::RebindMask(d, level > focus.last_level[i]);
    touches = touches | hn::AndNot(narrow, inside);
  }
  return hn::AndNot(hn::RebindMask(d, apart), touches);
}

HWY_INLINE V PowerOfTwo(VI exponent) { return hn::BitCast(D(), hn::ShiftLeft<23>(exponent + 127)); }

// The keys of one vector of diamonds; priority_key in priority.cpp says the same in scalars.
template <bool kWithFactors>
HWY_INLINE VI Keys(const PriorityFrame& frame, const Axis& axis_x, const Axis& axis_y, VI x, VI y,
                   VI level) {
  const D d;
  const DI di;
  const auto zero = hn::Zero(di), n = hn::Set(di, 1 << frame.lattice_bits);

  // The subtree's box, cut to the domain.
  const auto one = hn::Set(di, 1);
  const auto h = hn::Shr(n, hn::ShiftRight<1>(level) + one);
  const auto half = h * (3 - (level & one));
  const Boxes box{Max(x - half, zero), Min(x + half, n), Max(y - half, zero), Min(y + half, n)};
  const auto x_low = axis_x.Relative(box.x_low), x_high = axis_x.Relative(box.x_high);
  const auto y_low = axis_y.Relative(box.y_low), y_high = axis_y.Relative(box.y_high);

  // Outside one of the planes, sunk as far as any of it may be?
  auto outside = hn::FirstN(d, 0);
  const auto far_x = Max(-x_low, x_high), far_y = Max(-y_low, y_high);
  const auto most_drop = (far_x * far_x + far_y * far_y) * frame.drop_per_step2;
  for (const PriorityFrame::Plane& plane : frame.planes) {
    const auto nx = hn::Set(d, plane.nx), ny = hn::Set(d, plane.ny);
    const auto most_x = Max(nx * x_low, nx * x_high);
    const auto most_y = Max(ny * y_low, ny * y_high);
    const auto most_z = most_drop * plane.by_drop + plane.max_z;
    const auto most = most_x + most_y + most_z;
    outside = outside | (most < 0.0f);
  }

  // (distance / size)^2.
  const auto dx = DistanceTo(x_low, x_high), dy = DistanceTo(y_low, y_high);
  const auto horizontal2 = dx * dx + dy * dy;
  outside = outside | (horizontal2 > frame.horizon2);
  auto distance2_z = hn::Set(d, frame.distance2_z);
  auto relief_factor = hn::Set(d, 1.0f);
  if constexpr (kWithFactors) {
    if (frame.relief.counts) {
      const Relief relief = ReliefIn(frame, box, level);
      const auto dz = DistanceTo(relief.z.low, relief.z.high);
      distance2_z = dz * dz;
      relief_factor = ReliefFactor(frame.relief, relief, {x_low, x_high}, {y_low, y_high});
    }
  }
  const auto distance2 = horizontal2 + distance2_z;
  const auto inv_size2 = Max(PowerOfTwo(level & frame.level_mask), frame.least_inv_size2);
  const auto inv_curved2 = PowerOfTwo(level + level) * frame.curvature_inv_size2;
  auto key = distance2 * Min(inv_size2, inv_curved2);
  if constexpr (kWithFactors) {
    key = key * relief_factor;
    if (frame.inv_haze > 0.0f) key = key * HazeFactor(Sqrt(distance2), frame.inv_haze);
    const auto focused = TouchesAFocus(frame.focus, box, level);
    key = IfThenElse(focused, key * frame.focus.factor, key);
    key = Min(key, kLastKey);
  }
  const auto culled = hn::BitCast(d, hn::Set(di, static_cast<std::int32_t>(kCulledKey)));
  return hn::BitCast(di, IfThenElse(outside, culled, key));
}

template <bool kWithFactors>
void ComputeAllKeys(const PriorityFrame& frame, std::size_t count, const std::int32_t* x,
                    const std::int32_t* y, const std::int32_t* level, PriorityKey* keys) {
  const D d;
  const DI di;
  const DU du;
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
