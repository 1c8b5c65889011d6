#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "math/check.h"
#include "raster/sample_pattern.h"
#include "raster/small_triangles.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/find_small_triangles_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::raster {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

using MI = hn::Mask<DI>;

// A corner of each triangle of a packet.
struct Corner {
  VI x, y, depth_bits, flags;
};

// The corners of a packet, fetched one after the other: gathers take longer.
struct alignas(64) FetchedCorners {
  std::array<std::array<WindowVertex, kLanes>, 3> vertex;

  HWY_INLINE Corner corner(std::size_t i) const {
    Corner c;
    hn::LoadInterleaved4(DI(), &vertex[i][0].x_fx8, c.x, c.y, c.depth_bits, c.flags);
    return c;
  }
};

struct Box {
  VI x0, y0, x1, y1;  // inclusive
};

HWY_INLINE MI IsEmpty(const Box& box) { return (box.x0 > box.x1) | (box.y0 > box.y1); }

// pixels_between() and limit_to().
HWY_INLINE Box PixelsBetween(const Box& bounds, SampleExtent extent, Viewport viewport) {
  const auto first = [&](VI v) HWY_ATTR {
    return Max(hn::ShiftRight<kFractionBits>(v + (kPixelFx8 - 1 - extent.high_fx8)), 0);
  };
  const auto last = [&](VI v, int size_px) HWY_ATTR {
    return Min(hn::ShiftRight<kFractionBits>(v - extent.low_fx8), size_px - 1);
  };
  return {first(bounds.x0), first(bounds.y0), last(bounds.x1, viewport.width_px),
          last(bounds.y1, viewport.height_px)};
}

// Whether boxes hold no position of a pattern by its lines.
HWY_INLINE MI LiesBetween(const Box& bounds, int samples) {
  const std::int32_t spacing_fx8 = sample_spacing_fx8(samples);
  const int shift = std::countr_zero(static_cast<unsigned>(spacing_fx8));
  const auto lines_below = [&](VI v) HWY_ATTR { return hn::ShiftRightSame(v, shift); };
  const auto none = [&](VI low, VI high) HWY_ATTR {
    return lines_below(low + (spacing_fx8 / 2 - 1)) == lines_below(high + spacing_fx8 / 2);
  };
  return none(bounds.x0, bounds.x1) | none(bounds.y0, bounds.y1);
}

HWY_INLINE Corner Choose(MI mask, const Corner& yes, const Corner& no) {
  return {IfThenElse(mask, yes.x, no.x), IfThenElse(mask, yes.y, no.y),
          IfThenElse(mask, yes.depth_bits, no.depth_bits), no.flags};
}

HWY_INLINE MI IsAbove(const Corner& a, const Corner& b) {
  return (a.y < b.y) | ((a.y == b.y) & (a.x < b.x));
}

// The order of SetupTriangle, of triangles that have an area.
HWY_INLINE void PutInOrder(MI is_negative, std::array<Corner, 3>& v) {
  const Corner second = Choose(is_negative, v[2], v[1]), third = Choose(is_negative, v[1], v[2]);
  const MI from_second = IsAbove(second, v[0]) & IsAbove(second, third);
  const MI from_third = hn::AndNot(from_second, IsAbove(third, v[0]));
  const Corner first = v[0];
  v[0] = Choose(from_second, second, Choose(from_third, third, first));
  v[1] = Choose(from_second, third, Choose(from_third, first, second));
  v[2] = Choose(from_second, first, Choose(from_third, second, third));
}

HWY_INLINE VI Offset(const Corner& from, const Corner& to) {
  return hn::ShiftLeft<16>(to.y - from.y) | ((to.x - from.x) & 0xFFFF);
}

HWY_INLINE Box BoundsOf(const std::array<Corner, 3>& v) {
  return {Min(Min(v[0].x, v[1].x), v[2].x), Min(Min(v[0].y, v[1].y), v[2].y),
          Max(Max(v[0].x, v[1].x), v[2].x), Max(Max(v[0].y, v[1].y), v[2].y)};
}

// Short sides, and nothing to clip.
HWY_INLINE MI IsSmall(const std::array<Corner, 3>& v, const Box& bounds) {
  const VI flags = v[0].flags | v[1].flags | v[2].flags;
  return ((flags & static_cast<int>(kClipFlags | kNotFinite)) == hn::Zero(DI())) &
         (bounds.x1 - bounds.x0 < kSmallSide_fx8 + 1) &
         (bounds.y1 - bounds.y0 < kSmallSide_fx8 + 1);
}

// Which of the small ones are left out, in the order and for the reasons of set_up_triangle().
HWY_INLINE MI CullSmall(const std::array<Corner, 3>& v, const Box& bounds, VI area, MI is_small,
                        MI is_between, const Box& samples, const SetupRules& rules,
                        PassStatistics& statistics) {
  const DI di;
  const VI flags = v[0].flags & v[1].flags & v[2].flags;
  // The sign of an area that is not drawn.
  const int culled_sign = rules.cull == Cull::kNone ? 0 : rules.cull == Cull::kClockwise ? 1 : -1;
  const MI misses = (bounds.x1 < 1) | (bounds.y1 < 1) |
                    (bounds.x0 > rules.viewport.width_px * kPixelFx8 - 1) |
                    (bounds.y0 > rules.viewport.height_px * kPixelFx8 - 1);
  const MI is_rejected = is_small & ((flags & static_cast<int>(kRejectFlags)) != hn::Zero(di));
  MI left = hn::AndNot(is_rejected, is_small);
  const MI is_degenerate = left & (area == hn::Zero(di));
  left = hn::AndNot(is_degenerate, left);
  const MI is_facing = left & (area * culled_sign > 0);
  left = hn::AndNot(is_facing, left) & is_between;
  const MI is_outside = left & misses;
  const MI is_nowhere = hn::AndNot(is_outside, left) & IsEmpty(samples);
  const MI is_culled = is_rejected | is_degenerate | is_facing | is_outside | is_nowhere;
  if (hn::AllFalse(di, is_culled)) return is_culled;
  statistics.culled_outside += hn::CountTrue(di, is_rejected | is_outside);
  statistics.culled_degenerate += hn::CountTrue(di, is_degenerate);
  statistics.culled_facing += hn::CountTrue(di, is_facing);
  statistics.culled_between_pixels += hn::CountTrue(di, is_nowhere);
  return is_culled;
}

HWY_INLINE VI PlacesOf(const std::array<Corner, 3>& v, const Box& bounds, VI area, MI is_small,
                       const SetupRules& rules, const TileGrid& grid, PassStatistics& statistics) {
  const DI di;
  const Box centres = PixelsBetween(bounds, sample_extent(0), rules.viewport);
  const Box samples = PixelsBetween(bounds, sample_extent(rules.samples), rules.viewport);
  const MI is_between = IsEmpty(centres);
  const MI is_culled = CullSmall(v, bounds, area, is_small, is_between, samples, rules, statistics);
  const VI pixels = (centres.x1 - centres.x0 + 1) * (centres.y1 - centres.y0 + 1);
  const MI is_kept =
      hn::AndNot(is_culled, is_small) & (is_between | (pixels < kMostSmallPixels + 1));
  statistics.set_up += hn::CountTrue(di, is_kept);
  statistics.set_up_for_samples += hn::CountTrue(di, is_kept & is_between);

  const auto tile_of = [&](VI px) HWY_ATTR { return hn::ShiftRightSame(px, grid.tile_log2()); };
  const VI tile_x = tile_of(samples.x0), tile_y = tile_of(samples.y0);
  const auto flag_if = [&](MI mask, std::int32_t flag)
                           HWY_ATTR { return IfThenElseZero(mask, hn::Set(di, flag)); };
  const VI place = (tile_y * grid.tiles_x + tile_x) | flag_if(is_between, kBetweenCentres) |
                   flag_if(LiesBetween(bounds, rules.samples), kBetweenSamples) |
                   flag_if(tile_of(samples.x1) > tile_x, kTwoColumns) |
                   flag_if(tile_of(samples.y1) > tile_y, kTwoRows);
  return IfThenElse(is_kept, place,
                    IfThenElse(is_culled, hn::Set(di, kLeftOut), hn::Set(di, kOfAnySize)));
}

void FindSmallTriangles(std::span<const WindowVertex> vertices,
                        std::span<const std::uint32_t> indices, const SetupRules& rules,
                        const TileGrid& grid, std::uint32_t first_primitive,
                        const SmallOutputs& out, PassStatistics& statistics) {
  const DI di;
  const std::size_t count = indices.size() / 3;
  FetchedCorners fetched{};
  for (std::size_t n = 0; n < count; n += kLanes) {
    const std::size_t used = std::min(kLanes, count - n);
    for (std::size_t lane = 0; lane < used; ++lane)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t index = indices[3 * (n + lane) + i];
        SWELL_CHECK(index < vertices.size(), "triangle={} index={} vertices={}", n + lane, index,
                    vertices.size());
        fetched.vertex[i][lane] = vertices[index];
      }
    std::array<Corner, 3> v = {fetched.corner(0), fetched.corner(1), fetched.corner(2)};
    const Box bounds = BoundsOf(v);
    const MI is_small = IsSmall(v, bounds) & (CountFrom(0) < static_cast<int>(used));
    if (hn::AllFalse(di, is_small)) {
      hn::StoreU(hn::Set(di, kOfAnySize), di, &out.place[n]);
      continue;
    }
    const VI area = (v[1].x - v[0].x) * (v[2].y - v[0].y) - (v[2].x - v[0].x) * (v[1].y - v[0].y);
    hn::StoreU(PlacesOf(v, bounds, area, is_small, rules, grid, statistics), di, &out.place[n]);
    PutInOrder(area < 0, v);
    hn::StoreInterleaved4(v[0].x, v[0].y, Offset(v[0], v[1]), Offset(v[0], v[2]), di,
                          &out.corners[n].x_fx8);
    const VI primitive = CountFrom(static_cast<int>(first_primitive + n));
    hn::StoreInterleaved4(v[0].depth_bits, v[1].depth_bits, v[2].depth_bits, primitive, di,
                          reinterpret_cast<std::int32_t*>(&out.depths[n]));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::raster
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::raster {

HWY_EXPORT(FindSmallTriangles);

void find_small_triangles(std::span<const WindowVertex> vertices,
                          std::span<const std::uint32_t> indices, const SetupRules& rules,
                          const TileGrid& grid, std::uint32_t first_primitive,
                          const SmallOutputs& out, PassStatistics& statistics) {
  const std::size_t size = small_size(indices.size() / 3);
  SWELL_CHECK(out.place.size() >= size && out.corners.size() >= size && out.depths.size() >= size,
              "place={} corners={} depths={} of {}", out.place.size(), out.corners.size(),
              out.depths.size(), size);
  HWY_DYNAMIC_DISPATCH(FindSmallTriangles)
  (vertices, indices, rules, grid, first_primitive, out, statistics);
}

SetupTriangle set_up_small(const SmallCorners& corners, const SmallDepths& depths,
                           Viewport viewport) {
  const std::int32_t x = corners.x_fx8, y = corners.y_fx8;
  const WindowVertex v0{x, y, depths.depth[0], 0};
  const WindowVertex v1{x + corners.dx1_fx8, y + corners.dy1_fx8, depths.depth[1], 0};
  const WindowVertex v2{x + corners.dx2_fx8, y + corners.dy2_fx8, depths.depth[2], 0};
  SetupTriangle out;
  // What it has passed already.
  set_up_triangle(v0, v1, v2, {Cull::kNone, viewport, kMaxSamples}, depths.primitive, out);
  return out;
}

}  // namespace swell::raster
#endif
