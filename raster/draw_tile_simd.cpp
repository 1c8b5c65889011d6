#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "math/check.h"
#include "raster/pass_state.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/draw_tile_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "math/lanes-inl.h"
#include "raster/draw_small-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::raster {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

constexpr int kLanes = static_cast<int>(hn::MaxLanes(D()));
static_assert(kLanes <= 16, "a packet must fit the smallest tile");

// While a tile is drawn, a pixel without a triangle has this depth, so that depth 0 still wins.
constexpr float kEmptyDepth = -1.0f;

// The pixels of a triangle in a tile as rows of whole packets. Relative to the tile, inclusive.
struct PacketRect {
  std::int32_t x, y0, y1, packets;
};

// Edge functions of a tile's pixels, in steps of one pixel:
//   E(x, y) >= 0  <=>  floor(E / 256) >= 0,  and a pixel's step in E is 256 a or 256 b exactly,
// so e = floor(E(origin) / 256) + a dx + b dy has the sign of E. If an edge changes sign inside
// the tile, |e| <= 64 (|a| + |b|) < 2^30 everywhere in it.
struct TileEdges {
  std::int32_t e[3], a[3], b[3];
};

// Packets that cover the triangle's box; one packet where that is enough. A triangle listed for its
// samples may have no pixel centre in the tile: no rows (y0 > y1), or packets that no edge lets
// through within the viewport.
HWY_INLINE PacketRect RectInTile(const SetupTriangle& t, const TileTarget& tile) {
  const std::int32_t x0 = std::max(t.min_x - tile.x0, 0);
  const std::int32_t x1 = std::min(t.max_x - tile.x0, tile.size - 1);
  const std::int32_t y0 = std::max(t.min_y - tile.y0, 0);
  const std::int32_t y1 = std::min(t.max_y - tile.y0, tile.size - 1);
  if (x1 - x0 < kLanes) return {std::min(x0, tile.size - kLanes), y0, y1, 1};
  const std::int32_t x = x0 & -kLanes;
  return {x, y0, y1, (x1 - x) / kLanes + 1};
}

// Edge functions at the rectangle's first pixel; an edge that the whole rectangle is inside of
// becomes 0. False if the whole rectangle is outside of an edge.
HWY_INLINE bool EdgesInRect(const SetupTriangle& t, const TileTarget& tile, const PacketRect& rect,
                            TileEdges& out) {
  const std::int32_t px_fx8 = (tile.x0 + rect.x) * kPixelFx8 + kHalfPixelFx8;
  const std::int32_t py_fx8 = (tile.y0 + rect.y0) * kPixelFx8 + kHalfPixelFx8;
  const std::int64_t steps_x = rect.packets * kLanes - 1;
  const std::int64_t steps_y = rect.y1 - rect.y0;
  for (int i = 0; i < 3; ++i) {
    const Edge edge = edge_of(t, i);
    const std::int64_t e = edge.at(px_fx8, py_fx8) >> kFractionBits;
    const std::int64_t span_x = edge.a * steps_x, span_y = edge.b * steps_y;
    const std::int64_t lowest =
        e + std::min<std::int64_t>(span_x, 0) + std::min<std::int64_t>(span_y, 0);
    const std::int64_t highest =
        e + std::max<std::int64_t>(span_x, 0) + std::max<std::int64_t>(span_y, 0);
    if (highest < 0) return false;
    const bool crosses = lowest < 0;
    out.e[i] = crosses ? static_cast<std::int32_t>(e) : 0;
    out.a[i] = crosses ? edge.a : 0;
    out.b[i] = crosses ? edge.b : 0;
  }
  return true;
}

HWY_INLINE V ToPixels(std::int32_t fx8) {
  const D d;
  return hn::Set(d, static_cast<float>(fx8) * (1.0f / kPixelFx8));
}

// Depth test and store of one packet, whose covered lanes are those where `edges` is not negative.
// Whole stores: masked ones took 1.7 times the time on AVX2.
HWY_INLINE void DrawPacket(VI edges, V z, V primitive, float* HWY_RESTRICT depth,
                           float* HWY_RESTRICT id) {
  const D d;
  const auto inside = hn::RebindMask(d, edges > -1);
  const V old = hn::LoadU(d, depth);
  const auto wins = inside & (z > old);
  hn::StoreU(IfThenElse(wins, z, old), d, depth);
  hn::StoreU(IfThenElse(wins, primitive, hn::LoadU(d, id)), d, id);
}

HWY_INLINE void DrawTriangle(const SetupTriangle& t, const TileTarget& tile) {
  const D d;
  const DI di;
  const PacketRect rect = RectInTile(t, tile);
  TileEdges edges;
  if (rect.y0 > rect.y1 || !EdgesInRect(t, tile, rect, edges)) return;

  // Edges at the first packet's lanes.
  const VI lane = hn::Iota(di, 0);
  const auto first = [&](int i) { return hn::Set(di, edges.e[i]) + edges.a[i] * lane; };
  VI e0 = first(0), e1 = first(1), e2 = first(2);
  const VI b0 = hn::Set(di, edges.b[0]), b1 = hn::Set(di, edges.b[1]);
  const VI b2 = hn::Set(di, edges.b[2]);

  // Offsets from the depth plane's reference, exact: multiples of 1/256 below 2^15.
  const std::int32_t px_fx8 = (tile.x0 + rect.x) * kPixelFx8 + kHalfPixelFx8;
  const std::int32_t py_fx8 = (tile.y0 + rect.y0) * kPixelFx8 + kHalfPixelFx8;
  const V dx = ToPixels(px_fx8 - t.x_ref_fx8) + hn::Iota(d, 0.0f);
  V dy = ToPixels(py_fx8 - t.y_ref_fx8);
  const V dz_dx = hn::Set(d, t.dz_dx), dz_dy = hn::Set(d, t.dz_dy);
  const V z_min = hn::Set(d, t.z_min), z_max = hn::Set(d, t.z_max);
  const auto depth_at = [&](V x_offset, V z_row) {
    return Min(Max(MulAdd(dz_dx, x_offset, z_row), z_min), z_max);
  };

  const V primitive = hn::BitCast(d, hn::Set(di, static_cast<std::int32_t>(t.primitive)));
  float* HWY_RESTRICT depth = tile.depth + rect.y0 * tile.size + rect.x;
  float* HWY_RESTRICT id = reinterpret_cast<float*>(tile.primitive) + (depth - tile.depth);
  const std::int32_t rows = rect.y1 - rect.y0 + 1;
  const V one = hn::Set(d, 1.0f);
  const auto next_row = [&] {
    e0 = e0 + b0, e1 = e1 + b1, e2 = e2 + b2;
    dy = dy + one;
    depth += tile.size, id += tile.size;
  };

  if (rect.packets == 1) {
    for (std::int32_t row = 0; row < rows; ++row, next_row())
      DrawPacket((e0 | e1) | e2, depth_at(dx, MulAdd(dz_dy, dy, z_min)), primitive, depth, id);
    return;
  }

  const VI a0 = hn::Set(di, edges.a[0] * kLanes), a1 = hn::Set(di, edges.a[1] * kLanes);
  const VI a2 = hn::Set(di, edges.a[2] * kLanes);
  const V packet_width = hn::Set(d, static_cast<float>(kLanes));
  for (std::int32_t row = 0; row < rows; ++row, next_row()) {
    const V z_row = MulAdd(dz_dy, dy, z_min);
    VI f0 = e0, f1 = e1, f2 = e2;
    V x_offset = dx;
    for (std::int32_t p = 0; p < rect.packets; ++p) {
      const VI inside = (f0 | f1) | f2;
      DrawPacket(inside, depth_at(x_offset, z_row), primitive, depth + p * kLanes, id + p * kLanes);
      f0 = f0 + a0, f1 = f1 + a1, f2 = f2 + a2;
      x_offset = x_offset + packet_width;
    }
  }
}

void ClearTile(const TileTarget& tile) {
  const D d;
  const hn::ScalableTag<std::uint32_t> du;
  const V empty = hn::Set(d, kEmptyDepth);
  const auto none = hn::Set(du, kNoPrimitive);
  for (int i = 0; i < tile.size * tile.size; i += kLanes) {
    hn::StoreU(empty, d, tile.depth + i);
    hn::StoreU(none, du, tile.primitive + i);
  }
}

// Empties what lies right of the viewport, turns empty depths to 0 and counts the covered pixels.
int FinishTile(const TileTarget& tile, Viewport viewport) {
  const D d;
  const DI di;
  const hn::ScalableTag<std::uint32_t> du;
  const auto none = hn::Set(du, kNoPrimitive);
  const VI columns = hn::Set(di, viewport.width_px - tile.x0);
  const VI lane = hn::Iota(di, 0);
  std::size_t covered = 0;
  for (std::int32_t y = 0; y < tile.size; ++y) {
    for (std::int32_t x = 0; x < tile.size; x += kLanes) {
      const std::int32_t i = y * tile.size + x;
      const auto id = hn::LoadU(du, tile.primitive + i);
      const auto visible = hn::RebindMask(du, lane < columns - x) & (id != none);
      covered += hn::CountTrue(du, visible);
      hn::StoreU(IfThenElse(visible, id, none), du, tile.primitive + i);
      const V depth = hn::LoadU(d, tile.depth + i);
      hn::StoreU(IfThenElseZero(hn::RebindMask(d, visible), depth), d, tile.depth + i);
    }
  }
  return static_cast<int>(covered);
}

struct CentreDrawer {
  const TileTarget& tile;

  HWY_INLINE bool MayCover(Member member) const { return member.may_cover_centres(); }
  HWY_INLINE bool MayDraw(const SetupTriangle&) const { return true; }
  HWY_INLINE void DrawSmall(const SmallCorners* corners, const SmallDepths* depths,
                            std::size_t count) const {
    HWY_NAMESPACE::DrawSmall(corners, depths, count, tile);
  }
  HWY_INLINE void Draw(const SetupTriangle& t) const { DrawTriangle(t, tile); }
};

int DrawTile(const Pass::State& state, int tile_index, float* depth, std::uint32_t* primitive) {
  const std::int32_t size = state.grid.tile_size_px;
  const PixelBox box = tile_box(state.viewport, state.grid, tile_index);
  const TileTarget tile{depth,
                        primitive,
                        size,
                        box.x0_px,
                        box.y0_px,
                        box.x0_px + box.width_px,
                        box.y0_px + box.height_px};
  ClearTile(tile);
  CentreDrawer drawer{tile};
  DrawInOrder(state, tile_index, drawer);
  return FinishTile(tile, state.viewport);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::raster
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::raster {

HWY_EXPORT(DrawTile);

int draw_tile(const Pass& pass, int tile, std::span<float> depth,
              std::span<std::uint32_t> primitive) {
  const Pass::State& state = pass.state();
  const auto pixels = static_cast<std::size_t>(state.grid.tile_size_px) *
                      static_cast<std::size_t>(state.grid.tile_size_px);
  SWELL_CHECK(tile >= 0 && tile < state.grid.count(), "tile={} tiles={}", tile, state.grid.count());
  SWELL_CHECK(depth.size() == pixels && primitive.size() == pixels, "depth={} primitive={} of {}",
              depth.size(), primitive.size(), pixels);
  return HWY_DYNAMIC_DISPATCH(DrawTile)(state, tile, depth.data(), primitive.data());
}

}  // namespace swell::raster
#endif
