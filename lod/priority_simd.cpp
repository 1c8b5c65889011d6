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

// The ends of a subtree on one axis, relative to the eye; no operand is ever NaN.
struct Axis {
  hn::Vec<I> eye_floor;
  hn::Vec<F> eye_fraction;

  HWY_INLINE hn::Vec<F> FromEye(hn::Vec<I> lattice) const {
    return hn::Sub(hn::ConvertTo(F(), hn::Sub(lattice, eye_floor)), eye_fraction);
  }
};

// The keys of one vector of diamonds; priority_key in priority.cpp says the same in scalars.
HWY_INLINE hn::Vec<I> Keys(const PriorityFrame& frame, const Axis& axis_x, const Axis& axis_y,
                           hn::Vec<I> x, hn::Vec<I> y, hn::Vec<I> level) {
  const F d;
  const I di;
  const auto zero = hn::Zero(di), n = hn::Set(di, 1 << frame.lattice_bits);

  // The subtree's box, cut to the domain.
  const auto one = hn::Set(di, 1);
  const auto h = hn::Shr(n, hn::Add(hn::ShiftRight<1>(level), one));
  const auto half = hn::Mul(h, hn::Sub(hn::Set(di, 3), hn::And(level, one)));
  const auto x_low = axis_x.FromEye(hn::Max(hn::Sub(x, half), zero));
  const auto x_high = axis_x.FromEye(hn::Min(hn::Add(x, half), n));
  const auto y_low = axis_y.FromEye(hn::Max(hn::Sub(y, half), zero));
  const auto y_high = axis_y.FromEye(hn::Min(hn::Add(y, half), n));

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
  const auto dx = hn::Max(hn::Max(x_low, hn::Neg(x_high)), hn::Zero(d));
  const auto dy = hn::Max(hn::Max(y_low, hn::Neg(y_high)), hn::Zero(d));
  const auto distance2 =
      hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Set(d, frame.distance2_z));
  const auto exponent = hn::Add(hn::And(level, hn::Set(di, frame.level_mask)), hn::Set(di, 127));
  const auto key = hn::Mul(distance2, hn::BitCast(d, hn::ShiftLeft<23>(exponent)));
  const auto culled = hn::BitCast(d, hn::Set(di, static_cast<std::int32_t>(kCulledKey)));
  return hn::BitCast(di, hn::IfThenElse(outside, culled, key));
}

void ComputeKeys(const PriorityFrame& frame, std::size_t count, const std::int32_t* x,
                 const std::int32_t* y, const std::int32_t* level, PriorityKey* keys) {
  const F d;
  const I di;
  const hn::RebindToUnsigned<F> du;
  const Axis axis_x{hn::Set(di, frame.eye_floor.x), hn::Set(d, frame.eye_fraction.x)};
  const Axis axis_y{hn::Set(di, frame.eye_floor.y), hn::Set(d, frame.eye_fraction.y)};
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
    const auto key = Keys(frame, axis_x, axis_y, hn::LoadU(di, x + i), hn::LoadU(di, y + i),
                          hn::LoadU(di, level + i));
    hn::StoreU(hn::BitCast(du, key), du, keys + i);
  }
  for (; i < count; ++i) keys[i] = priority_key(frame, x[i], y[i], level[i]);
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
