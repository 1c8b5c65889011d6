#include <array>
#include <cstdint>

#include "math/check.h"
#include "raster/pass_state.h"
#include "raster/sample_edges.h"
#include "raster/samples.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/mark_touched_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::raster {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

constexpr int kLanes = static_cast<int>(hn::MaxLanes(DI()));
static_assert(kLanes <= 16, "a packet's mask has at most 16 bits");

// A bit for each lane that is not negative.
HWY_INLINE std::uint64_t BitsNotNegative(VI v) {
  const DI di;
  std::uint16_t bits = 0;
  hn::StoreMaskBits(di, v > -1, reinterpret_cast<std::uint8_t*>(&bits));
  return bits;
}

// Whether the mask has all pixels of the rectangle.
HWY_INLINE bool HasAll(const PixelMask& mask, const PixelRect& rect, std::uint64_t columns) {
  std::uint64_t missing = 0;
  for (std::int32_t y = rect.y0; y <= rect.y1; ++y) missing |= columns & ~mask.row(y);
  return missing == 0;
}

// A pixel is touched if each edge is not negative at the point of the pixel's sample square that
// lies farthest on the edge's inner side. In steps of one pixel, so that
//   E(x, y) + reach >= 0  <=>  floor((E(first) + reach) / 256) + a dx + b dy >= 0.
HWY_INLINE void MarkTriangle(const SetupTriangle& t, SampleExtent extent, const PixelBox& box,
                             PixelMask& mask) {
  const DI di;
  const PixelRect rect = sample_rect_in_tile(t, extent, box);
  if (rect.empty()) return;
  const std::uint64_t columns = bits_between(rect.x0, rect.x1);
  std::array<SampleEdge, 3> edges;
  if (HasAll(mask, rect, columns) || !set_up_sample_edges(t, extent, box, rect, edges)) return;

  const VI lane = hn::Iota(di, 0);
  const auto first = [&](const SampleEdge& edge) {
    const auto e = static_cast<std::int32_t>((edge.at_corner + edge.reach) >> kFractionBits);
    return hn::Set(di, e) + edge.a * lane;
  };
  VI e0 = first(edges[0]), e1 = first(edges[1]), e2 = first(edges[2]);
  const VI a0 = hn::Set(di, edges[0].a * kLanes), b0 = hn::Set(di, edges[0].b);
  const VI a1 = hn::Set(di, edges[1].a * kLanes), b1 = hn::Set(di, edges[1].b);
  const VI a2 = hn::Set(di, edges[2].a * kLanes), b2 = hn::Set(di, edges[2].b);

  for (std::int32_t y = rect.y0; y <= rect.y1; ++y) {
    VI f0 = e0, f1 = e1, f2 = e2;
    std::uint64_t bits = 0;
    for (std::int32_t x = rect.x0; x <= rect.x1; x += kLanes) {
      bits |= BitsNotNegative((f0 | f1) | f2) << x;
      f0 = f0 + a0, f1 = f1 + a1, f2 = f2 + a2;
    }
    mask.add_to_row(y, bits & columns);
    e0 = e0 + b0, e1 = e1 + b1, e2 = e2 + b2;
  }
}

void MarkTouched(const Pass::State& state, int tile, std::uint32_t first_primitive,
                 std::uint32_t end_primitive, PixelMask& mask) {
  const PixelBox box = tile_box(state.viewport, state.grid, tile);
  const SampleExtent extent = sample_extent(state.samples);
  for (std::size_t c = 0; c < state.chunk_count; ++c) {
    const Chunk& chunk = state.chunks[c];
    if (!holds_any(chunk, first_primitive, end_primitive)) continue;
    const std::uint32_t end = chunk.tile_begin[tile + 1];
    for (std::uint32_t m = chunk.tile_begin[tile]; m < end; ++m) {
      const SetupTriangle t = chunk.set_up(chunk.members[m], state.viewport);
      if (t.primitive < first_primitive || t.primitive >= end_primitive) continue;
      MarkTriangle(t, extent, box, mask);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::raster
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::raster {

HWY_EXPORT(MarkTouched);

void mark_touched(const Pass& pass, int tile, std::uint32_t first_primitive,
                  std::uint32_t end_primitive, PixelMask& mask) {
  const Pass::State& state = pass.state();
  SWELL_CHECK(state.samples != 0, "samples={}", state.samples);
  SWELL_CHECK(tile >= 0 && tile < state.grid.count(), "tile={} tiles={}", tile, state.grid.count());
  SWELL_CHECK(first_primitive <= end_primitive, "first_primitive={} end_primitive={}",
              first_primitive, end_primitive);
  HWY_DYNAMIC_DISPATCH(MarkTouched)(state, tile, first_primitive, end_primitive, mask);
}

}  // namespace swell::raster
#endif
