// Small triangles of a tile, a lane each.
// Per-target code: for *_simd.cpp files and what they include.
#if defined(SWELL_RASTER_SMALL_PACKET_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RASTER_SMALL_PACKET_INL_H_
#undef SWELL_RASTER_SMALL_PACKET_INL_H_
#else
#define SWELL_RASTER_SMALL_PACKET_INL_H_
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "math/lanes-inl.h"
#include "raster/pass_state.h"

HWY_BEFORE_NAMESPACE();
namespace swell::raster {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

// Small triangles that wait for their turn, in submission order, and are fetched meanwhile.
class SmallQueue {
 public:
  // Adds one if `counts`; there is room.
  HWY_INLINE void Add(const Chunk& chunk, std::uint32_t place, bool counts) {
    corners_[count_] = &chunk.corners[place];
    depths_[count_] = &chunk.depths[place];
    hwy::Prefetch(corners_[count_]);
    hwy::Prefetch(depths_[count_]);
    count_ += counts;
  }
  HWY_INLINE bool IsFull() const { return count_ == kRoom; }

  // Calls draw(corners, depths, count) with whole packets, of which `count` are used, and ends
  // empty.
  template <class Draw>
  HWY_INLINE void DrawAll(const Draw& draw) {
    alignas(64) std::array<SmallCorners, kLanes> corners{};
    alignas(64) std::array<SmallDepths, kLanes> depths{};
    for (std::size_t first = 0; first < count_; first += kLanes) {
      const std::size_t count = std::min(kLanes, count_ - first);
      for (std::size_t i = 0; i < count; ++i) {
        corners[i] = *corners_[first + i];
        depths[i] = *depths_[first + i];
      }
      draw(corners.data(), depths.data(), count);
    }
    count_ = 0;
  }

 private:
  static constexpr std::size_t kRoom = 64;
  std::size_t count_ = 0;
  std::array<const SmallCorners*, kRoom + 1> corners_;
  std::array<const SmallDepths*, kRoom + 1> depths_;
};

// Draws a tile's triangles in submission order, small ones by packets. `drawer` says
// MayCover(member) of a small one and MayDraw(triangle) of one of any size, and has
// DrawSmall(corners, depths, count) and Draw(triangle), before which all small ones were drawn that
// came before.
template <class Drawer>
HWY_INLINE void DrawInOrder(const Pass::State& state, int tile, Drawer& drawer) {
  SmallQueue small;
  const auto draw_small = [&]() HWY_ATTR {
    small.DrawAll([&](const SmallCorners* corners, const SmallDepths* depths, std::size_t count)
                      HWY_ATTR { drawer.DrawSmall(corners, depths, count); });
  };
  for (std::size_t c = 0; c < state.chunk_count; ++c) {
    const Chunk& chunk = state.chunks[c];
    const std::uint32_t end = chunk.tile_begin[tile + 1];
    constexpr std::uint32_t kAhead = 4;  // triangles fetched before their turn
    for (std::uint32_t m = chunk.tile_begin[tile]; m < end; ++m) {
      const Member member = chunk.members[m];
      if (member.is_small()) {
        small.Add(chunk, member.place(), drawer.MayCover(member));
        if (small.IsFull()) draw_small();
        continue;
      }
      const Member ahead = chunk.members[std::min(m + kAhead, end - 1)];
      if (!ahead.is_small()) hwy::Prefetch(&chunk.triangles[ahead.place()]);
      const SetupTriangle& t = chunk.triangles[member.place()];
      if (!drawer.MayDraw(t)) continue;
      draw_small();
      drawer.Draw(t);
    }
  }
  draw_small();
}

// Corners in the window, [1/256 px].
struct SmallVertices {
  VI x[3], y[3];
};

HWY_INLINE SmallVertices LoadVertices(const SmallCorners* HWY_RESTRICT corners) {
  SmallVertices v;
  VI second, third;
  hn::LoadInterleaved4(DI(), &corners->x_fx8, v.x[0], v.y[0], second, third);
  const auto low = [](VI both) HWY_ATTR { return hn::ShiftRight<16>(hn::ShiftLeft<16>(both)); };
  v.x[1] = v.x[0] + low(second), v.y[1] = v.y[0] + hn::ShiftRight<16>(second);
  v.x[2] = v.x[0] + low(third), v.y[2] = v.y[0] + hn::ShiftRight<16>(third);
  return v;
}

// The plane of depth, as of SetupTriangle.
struct SmallPlanes {
  V dz_dx, dz_dy, z_min, z_max;
  VI x_ref, y_ref;
  V primitive;
};

HWY_INLINE SmallPlanes SetUpPlanes(const SmallVertices& v, const SmallDepths* HWY_RESTRICT depths) {
  const D d;
  const DI di;
  const hn::RepartitionToWide<D> dd;
  const hn::Half<D> dh;
  SmallPlanes p;
  V z0, z1, z2;
  hn::LoadInterleaved4(d, depths->depth, z0, z1, z2, p.primitive);
  // In doubles, half of the lanes at a time.
  const auto slopes = [&](auto half_of, auto& dz_dx, auto& dz_dy) HWY_ATTR {
    const auto depth = [&](V z) HWY_ATTR { return hn::PromoteTo(dd, half_of(d, z)); };
    const auto offset = [&](VI to, VI from)
                            HWY_ATTR { return hn::PromoteTo(dd, half_of(di, to - from)); };
    const auto first = depth(z0);
    const auto dz1 = depth(z1) - first, dz2 = depth(z2) - first;
    const auto dx1 = offset(v.x[1], v.x[0]), dy1 = offset(v.y[1], v.y[0]);
    const auto dx2 = offset(v.x[2], v.x[0]), dy2 = offset(v.y[2], v.y[0]);
    const auto scale = hn::Set(dd, double{kPixelFx8}) / (dx1 * dy2 - dx2 * dy1);
    dz_dx = hn::DemoteTo(dh, (dz1 * dy2 - dz2 * dy1) * scale);
    dz_dy = hn::DemoteTo(dh, (dz2 * dx1 - dz1 * dx2) * scale);
  };
  hn::Vec<decltype(dh)> x_low, y_low, x_high, y_high;
  slopes([](auto, auto values) HWY_ATTR { return hn::LowerHalf(values); }, x_low, y_low);
  slopes([](auto tag, auto values)
             HWY_ATTR { return hn::UpperHalf(hn::Half<decltype(tag)>(), values); },
         x_high, y_high);
  p.dz_dx = hn::Combine(d, x_high, x_low);
  p.dz_dy = hn::Combine(d, y_high, y_low);

  const M second = z1 < z0;
  const V nearer = IfThenElse(second, z1, z0);
  const M third = z2 < nearer;
  p.z_min = IfThenElse(third, z2, nearer);
  p.z_max = Max(Max(z0, z1), z2);
  const auto at_far = [&](const VI(&c)[3]) HWY_ATTR {
    const VI of_two = IfThenElse(hn::RebindMask(di, second), c[1], c[0]);
    return IfThenElse(hn::RebindMask(di, third), c[2], of_two);
  };
  p.x_ref = at_far(v.x), p.y_ref = at_far(v.y);
  return p;
}

// An edge of each lane's triangle, as Edge: 32 bits hold it around its box.
struct SmallEdge {
  VI a, b, x, y, bias;

  HWY_INLINE VI At(VI px_fx8, VI py_fx8) const {
    return a * (px_fx8 - x) + b * (py_fx8 - y) + bias;
  }
};

HWY_INLINE SmallEdge EdgeOf(const SmallVertices& v, int i) {
  const DI di;
  const int j = i == 2 ? 0 : i + 1;
  const VI dx = v.x[j] - v.x[i], dy = v.y[j] - v.y[i];
  const auto is_top_left = (dy < 0) | ((dy == hn::Zero(di)) & (dx > 0));
  const VI bias = IfThenElse(is_top_left, hn::Zero(di), hn::Set(di, -1));
  return {-dy, dx, v.x[i], v.y[i], bias};
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::raster
HWY_AFTER_NAMESPACE();

#endif  // include guard per target
