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

  // Outside one of the planes?
  auto outside = hn::FirstN(d, 0);
  for (const PriorityFrame::Plane& plane : frame.planes) {
    const auto nx = hn::Set(d, plane.nx), ny = hn::Set(d, plane.ny);
    const auto most_x = hn::Max(hn::Mul(nx, x_low), hn::Mul(nx, x_high));
    const auto most_y = hn::Max(hn::Mul(ny, y_low), hn::Mul(ny, y_high));
    const auto most = hn::Add(hn::Add(most_x, most_y), hn::Set(d, plane.max_z));
    outside = hn::Or(outside, hn::Lt(most, hn::Zero(d)));
  }

  // (distance / size)^2.
  const auto dx = DistanceTo(x_low, x_high), dy = DistanceTo(y_low, y_high);
  const auto distance2 =
      hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Set(d, frame.distance2_z));
  const auto exponent = hn::Add(hn::And(level, hn::Set(di, frame.level_mask)), hn::Set(di, 127));
  auto key = hn::Mul(distance2, hn::BitCast(d, hn::ShiftLeft<23>(exponent)));
  if constexpr (kWithFactors) {
    const auto focused = TouchesAFocus(frame.focus, box, level);
    key = hn::IfThenElse(focused, hn::Mul(key, hn::Set(d, frame.focus.factor)), key);
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
  if (frame.focus.count > 0)
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
