// Draws small triangles of a tile side by side, a lane each: depth and primitive of the pixels
// whose centres they cover. The same arithmetic as one by one, for the same bits.
// Per-target code: for *_simd.cpp files and what they include.
#if defined(SWELL_RASTER_DRAW_SMALL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RASTER_DRAW_SMALL_INL_H_
#undef SWELL_RASTER_DRAW_SMALL_INL_H_
#else
#define SWELL_RASTER_DRAW_SMALL_INL_H_
#endif

#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "math/lanes-inl.h"
#include "raster/small_packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::raster {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

// A tile's buffers, and the pixels of the window that it holds. [px]
struct TileTarget {
  float* HWY_RESTRICT depth;
  std::uint32_t* HWY_RESTRICT primitive;
  std::int32_t size, x0, y0, x_end, y_end;
};

// Where each lane's triangle is drawn next: pixels of its box, row by row.
struct SmallBoxes {
  VI x0, y0, width, count;  // [px]
};

HWY_INLINE SmallBoxes BoxesInTile(const SmallVertices& v, const TileTarget& tile) {
  constexpr std::int32_t kToFirst = kPixelFx8 - 1 - kHalfPixelFx8;
  const auto first = [&](const VI(&c)[3], std::int32_t least) HWY_ATTR {
    const VI low = Min(Min(c[0], c[1]), c[2]);
    return Max(hn::ShiftRight<kFractionBits>(low + kToFirst), least);
  };
  const auto last = [&](const VI(&c)[3], std::int32_t end) HWY_ATTR {
    const VI high = Max(Max(c[0], c[1]), c[2]);
    return Min(hn::ShiftRight<kFractionBits>(high - kHalfPixelFx8), end - 1);
  };
  const VI x0 = first(v.x, tile.x0), y0 = first(v.y, tile.y0);
  const VI width = Max(last(v.x, tile.x_end) - x0 + 1, 0);
  return {x0, y0, width, width * Max(last(v.y, tile.y_end) - y0 + 1, 0)};
}

// An edge function at each lane's pixel, and its steps: to the next pixel of a row, and from a
// row's last to the next one's first.
struct PixelEdge {
  VI e, a, wrap;
};

HWY_INLINE PixelEdge SetUpEdge(const SmallVertices& v, int i, VI px_fx8, VI py_fx8, VI width) {
  const SmallEdge edge = EdgeOf(v, i);
  const VI a = hn::ShiftLeft<kFractionBits>(edge.a), b = hn::ShiftLeft<kFractionBits>(edge.b);
  return {edge.At(px_fx8, py_fx8), a, b - a * (width - 1)};
}

// The pixels of the lanes' boxes, each lane's one after the other.
struct SmallPixels {
  alignas(64) std::array<float, kMostSmallPixels * kLanes> depth;
  alignas(64) std::array<std::int32_t, kMostSmallPixels * kLanes> place;  // in the tile
  std::array<std::uint8_t, kLanes> covered;  // bit k: the lane covers its k-th pixel
};

// Depth tests of what is covered, one lane after the other: triangles may cover each other.
HWY_INLINE void ResolveSmall(const SmallPixels& pixels, V primitive, const TileTarget& tile) {
  static_assert(kMostSmallPixels == 8);
  constexpr std::size_t kAtOnce = kLanes < 8 ? kLanes : 8;
  std::array<std::uint32_t, kLanes> number;
  hn::StoreU(hn::BitCast(DU(), primitive), DU(), number.data());
  for (std::size_t first = 0; first < kLanes; first += kAtOnce) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &pixels.covered[first], kAtOnce);
    for (; bits != 0; bits &= bits - 1) {
      const auto bit = static_cast<std::size_t>(std::countr_zero(bits));
      const std::size_t lane = first + bit / 8, from = bit % 8 * kLanes + lane;
      const std::int32_t pixel = pixels.place[from];
      if (!(pixels.depth[from] > tile.depth[pixel])) continue;
      tile.depth[pixel] = pixels.depth[from];
      tile.primitive[pixel] = number[lane];
    }
  }
}

// Draws a packet of which `count` lanes are used.
HWY_INLINE void DrawSmall(const SmallCorners* HWY_RESTRICT corners,
                          const SmallDepths* HWY_RESTRICT depths, std::size_t count,
                          const TileTarget& tile) {
  const D d;
  const DI di;
  const SmallVertices v = LoadVertices(corners);
  const SmallPlanes plane = SetUpPlanes(v, depths);
  SmallBoxes box = BoxesInTile(v, tile);
  box.count = IfThenElseZero(CountFrom(0) < static_cast<int>(count), box.count);

  const VI px_fx8 = hn::ShiftLeft<kFractionBits>(box.x0) + kHalfPixelFx8;
  const VI py_fx8 = hn::ShiftLeft<kFractionBits>(box.y0) + kHalfPixelFx8;
  PixelEdge edge[3];
  for (int i = 0; i < 3; ++i) edge[i] = SetUpEdge(v, i, px_fx8, py_fx8, box.width);
  const auto to_px = [&](VI fx8) HWY_ATTR { return hn::ConvertTo(d, fx8) * (1.0f / kPixelFx8); };
  const V dx0 = to_px(px_fx8 - plane.x_ref);
  V dx = dx0, dy = to_px(py_fx8 - plane.y_ref);
  VI pixel = (box.y0 - tile.y0) * tile.size + (box.x0 - tile.x0);
  const VI next_row = tile.size + 1 - box.width;
  VI column = hn::Zero(di), covered = hn::Zero(di);

  SmallPixels pixels;
  const int most = hn::GetLane(hn::MaxOfLanes(di, box.count));
  for (int k = 0; k < most; ++k) {
    const auto inside = ((edge[0].e | edge[1].e) | edge[2].e) > -1;
    const auto is_left = hn::Set(di, k) < box.count;
    covered = covered | IfThenElseZero(inside & is_left, hn::Set(di, 1 << k));
    const V plane_z = MulAdd(plane.dz_dx, dx, MulAdd(plane.dz_dy, dy, plane.z_min));
    const std::size_t to = static_cast<std::size_t>(k) * kLanes;
    hn::Store(Min(Max(plane_z, plane.z_min), plane.z_max), d, &pixels.depth[to]);
    hn::Store(pixel, di, &pixels.place[to]);
    // The next pixel.
    column = column + 1;
    const auto ends = column == box.width;
    const M ends_row = hn::RebindMask(d, ends);
    for (PixelEdge& e : edge) e.e = e.e + IfThenElse(ends, e.wrap, e.a);
    pixel = pixel + IfThenElse(ends, next_row, hn::Set(di, 1));
    column = IfThenElse(ends, hn::Zero(di), column);
    dx = IfThenElse(ends_row, dx0, dx + 1.0f);
    dy = dy + IfThenElseZero(ends_row, hn::Set(d, 1.0f));
  }
  const hn::Rebind<std::uint8_t, DI> d8;
  hn::StoreU(hn::DemoteTo(d8, covered), d8, pixels.covered.data());
  ResolveSmall(pixels, plane.primitive, tile);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::raster
HWY_AFTER_NAMESPACE();

#endif  // include guard per target
