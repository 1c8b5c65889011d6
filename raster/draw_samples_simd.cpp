#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "math/check.h"
#include "raster/pass_state.h"
#include "raster/sample_edges.h"
#include "raster/samples.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/draw_samples_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "math/lanes-inl.h"
#include "raster/sample_small-inl.h"
#include "raster/sample_target-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::raster {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

// While samples are drawn, one without a triangle has this depth, so that depth 0 still wins.
constexpr float kEmptyDepth = -1.0f;

constexpr std::uint32_t kLanes = static_cast<std::uint32_t>(hn::MaxLanes(D()));
static_assert(kLanes % kMaxSamples == 0 || kMaxSamples % kLanes == 0,
              "a packet holds whole pixels, or whole packets a pixel");

// The packets that a pixel's samples take; 1 where a packet holds one or more pixels.
template <int kSamples>
constexpr std::uint32_t kParts = kSamples > kLanes ? kSamples / kLanes : 1;

// False if no marked pixel lies in the box of the triangle's pixel centres, one wider all round.
// Most triangles of a tile end here.
HWY_INLINE bool MayHoldMarked(const SetupTriangle& t, const SampleTarget& target) {
  const std::int32_t x0 = std::max(t.min_x - 1 - target.box.x0_px, 0);
  const std::int32_t x1 = std::min(t.max_x + 1 - target.box.x0_px, 63);
  const std::int32_t y0 = std::max(t.min_y - 1 - target.box.y0_px, 0);
  const std::int32_t y1 = std::min(t.max_y + 1 - target.box.y0_px, 63);
  if (x0 > x1 || y0 > y1) return false;
  return (target.columns & bits_between(x0, x1)) != 0 && (target.rows & bits_between(y0, y1)) != 0;
}

// Cuts rows without a marked pixel off the rectangle's top; false if none is left.
HWY_INLINE bool CutToMarked(const SampleTarget& target, std::uint64_t columns, PixelRect& rect) {
  std::uint64_t rows = target.rows & bits_between(rect.y0, rect.y1);
  while (rows != 0 && (target.mask.row(std::countr_zero(rows)) & columns) == 0) rows &= rows - 1;
  if (rows == 0) return false;
  rect.y0 = std::countr_zero(rows);
  rect.y1 = 63 - std::countl_zero(rows);
  return true;
}

// An edge at the samples of a rectangle's first pixel, and its steps of one pixel.
struct LaneEdge {
  VI first;
  std::int32_t step_x, step_y;
};

// E itself, where the triangle is small enough for 32 bits.
HWY_INLINE LaneEdge NarrowEdge(const Edge& edge, const SampleTarget& target, const PixelRect& rect,
                               std::uint32_t part) {
  const VI offset = edge.a * target.x_of(part) + edge.b * target.y_of(part);
  const auto at_corner = static_cast<std::int32_t>(
      edge.at((target.box.x0_px + rect.x0) * kPixelFx8, (target.box.y0_px + rect.y0) * kPixelFx8));
  return {at_corner + offset, edge.a * kPixelFx8, edge.b * kPixelFx8};
}

// A pixel's step in E is 256 a or 256 b exactly, and sample positions are multiples of 16 / 256 px,
// so a sample is inside an edge if
//   floor(E / 256) = e + a dx + b dy >= 0 with e = floor((E(corner) + a x_fx8 + b y_fx8) / 256),
// which fits 32 bits with E(corner) / 16 taken apart into whole pixels and the rest.
HWY_INLINE LaneEdge WideEdge(const SampleEdge& edge, const SampleTarget& target,
                             std::uint32_t part) {
  const VI x_step = hn::ShiftRight<4>(target.x_of(part));
  const VI y_step = hn::ShiftRight<4>(target.y_of(part));
  const auto whole = static_cast<std::int32_t>(edge.at_corner >> kFractionBits);
  const auto rest = static_cast<std::int32_t>(edge.at_corner >> 4) & 15;
  const VI offset = edge.a * x_step + edge.b * y_step;
  return {whole + hn::ShiftRight<4>(rest + offset), edge.a, edge.b};
}

// Edges whose sign says on which side the rectangle's samples lie. False if all are outside of one.
HWY_INLINE bool SetUpEdges(const SetupTriangle& t, const SampleTarget& target,
                           const PixelRect& rect, std::uint32_t part, LaneEdge (&out)[3]) {
  if (is_small(t)) {
    for (int i = 0; i < 3; ++i) out[i] = NarrowEdge(edge_of(t, i), target, rect, part);
    return true;
  }
  std::array<SampleEdge, 3> edges;
  if (!set_up_sample_edges(t, target.extent, target.box, rect, edges)) return false;
  for (int i = 0; i < 3; ++i) out[i] = WideEdge(edges[i], target, part);
  return true;
}

// Depth test and store of one packet.
HWY_INLINE void DrawPacket(M inside, V z, V primitive, float* HWY_RESTRICT depth,
                           float* HWY_RESTRICT id) {
  const D d;
  const V old = hn::LoadU(d, depth);
  const M wins = inside & (z > old);
  hn::StoreU(IfThenElse(wins, z, old), d, depth);
  hn::StoreU(IfThenElse(wins, primitive, hn::LoadU(d, id)), d, id);
}

// Draws a part of a triangle's samples, of the marked pixels in a rectangle.
template <int kSamples>
HWY_INLINE void SamplePart(const SetupTriangle& t, const SampleTarget& target,
                           const PixelRect& rect, std::uint64_t columns, std::uint32_t part) {
  const D d;
  const DI di;
  const DU du;
  const hn::Rebind<std::uint8_t, D> d8;
  LaneEdge edges[3];
  if (!SetUpEdges(t, target, rect, part, edges)) return;

  // Offsets from the depth plane's reference, exact: multiples of 1/256 below 2^15.
  const V to_px = hn::Set(d, 1.0f / kPixelFx8);
  const VI x_fx8 = target.x_of(part), y_fx8 = target.y_of(part);
  const std::int32_t corner_x = (target.box.x0_px + rect.x0) * kPixelFx8 - t.x_ref_fx8;
  const std::int32_t corner_y = (target.box.y0_px + rect.y0) * kPixelFx8 - t.y_ref_fx8;
  const V dx = hn::ConvertTo(d, corner_x + x_fx8) * to_px;
  V dy = hn::ConvertTo(d, corner_y + y_fx8) * to_px;
  const V dz_dx = hn::Set(d, t.dz_dx), dz_dy = hn::Set(d, t.dz_dy);
  const V z_min = hn::Set(d, t.z_min), z_max = hn::Set(d, t.z_max);
  const V primitive = hn::BitCast(d, hn::Set(du, t.primitive));
  const auto lane = hn::Iota(du, 0);
  const VI x0 = hn::Set(di, rect.x0);
  const VI a0 = hn::Set(di, edges[0].step_x), b0 = hn::Set(di, edges[0].step_y);
  const VI a1 = hn::Set(di, edges[1].step_x), b1 = hn::Set(di, edges[1].step_y);
  const VI a2 = hn::Set(di, edges[2].step_x), b2 = hn::Set(di, edges[2].step_y);
  VI e0 = edges[0].first, e1 = edges[1].first, e2 = edges[2].first;

  for (std::int32_t y = rect.y0; y <= rect.y1; ++y) {
    // The samples of the row's marked pixels in the rectangle lie side by side. A packet that would
    // pass the end of all samples begins earlier.
    const std::uint64_t marked = target.mask.row(y);
    const int before = std::popcount(marked & ~(~std::uint64_t{0} << rect.x0));
    const int inside = std::popcount(marked & columns);
    const std::uint32_t begin =
        (target.row_begin[y] + static_cast<std::uint32_t>(before)) * kSamples;
    const std::uint32_t count = static_cast<std::uint32_t>(inside) * kSamples;
    const V z_row = MulAdd(dz_dy, dy, z_min);
    for (std::uint32_t n = part * kLanes; n < count; n += kParts<kSamples> * kLanes) {
      const auto at = std::min<std::uint32_t>(begin + n, target.samples - kLanes);
      const auto in_row = lane + (at - begin) < count;
      const VI right = hn::PromoteTo(di, hn::LoadU(d8, target.column + at)) - x0;
      const VI f0 = a0 * right + e0, f1 = a1 * right + e1;
      const VI f2 = a2 * right + e2;
      const auto covered = ((f0 | f1) | f2) > -1;
      const V z = MulAdd(dz_dx, dx + hn::ConvertTo(d, right), z_row);
      DrawPacket(hn::RebindMask(d, covered) & hn::RebindMask(d, in_row), Min(Max(z, z_min), z_max),
                 primitive, target.depth + at, reinterpret_cast<float*>(target.primitive) + at);
    }
    e0 = e0 + b0, e1 = e1 + b1, e2 = e2 + b2;
    dy = dy + 1.0f;
  }
}

template <int kSamples>
HWY_INLINE void SampleTriangle(const SetupTriangle& t, const SampleTarget& target) {
  PixelRect rect = sample_rect_in_tile(t, target.extent, target.box);
  if (rect.empty()) return;
  const std::uint64_t columns = bits_between(rect.x0, rect.x1);
  if (!CutToMarked(target, columns, rect)) return;
  for (std::uint32_t part = 0; part < kParts<kSamples>; ++part)
    SamplePart<kSamples>(t, target, rect, columns, part);
}

// Turns empty depths to 0 and counts the covered samples.
int FinishSamples(std::span<float> depth, std::span<const std::uint32_t> primitive) {
  int covered = 0;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const bool empty = primitive[i] == kNoPrimitive;
    depth[i] = empty ? 0.0f : depth[i];
    covered += !empty;
  }
  return covered;
}

template <int kSamples>
struct SampleDrawer {
  const SampleTarget& target;
  SmallSampler<kSamples> sampler{target};

  HWY_INLINE bool MayCover(Member member) const { return member.may_cover_samples(); }
  HWY_INLINE bool MayDraw(const SetupTriangle& t) const { return MayHoldMarked(t, target); }
  HWY_INLINE void DrawSmall(const SmallCorners* corners, const SmallDepths* depths,
                            std::size_t count) {
    sampler.Add(corners, depths, count);
  }
  HWY_INLINE void Draw(const SetupTriangle& t) {
    sampler.Draw();
    SampleTriangle<kSamples>(t, target);
  }
};

template <int kSamples>
void DrawTriangles(const Pass::State& state, int tile, const SampleTarget& target) {
  SampleDrawer<kSamples> drawer{target};
  DrawInOrder(state, tile, drawer);
  drawer.sampler.Draw();
}

// Fills in where the marked pixels are; `column` has room for the samples of a whole tile.
template <int kSamples>
void FindMarked(const Pass::State& state, SampleTarget& target, std::uint8_t* column) {
  std::uint32_t pixels = 0;
  for (int y = 0; y < state.grid.tile_size_px; ++y) {
    const std::uint64_t bits = target.mask.row(y);
    target.row_begin[y] = pixels;
    target.rows |= std::uint64_t{bits != 0} << y;
    target.columns |= bits;
    for (std::uint64_t left = bits; left != 0; left &= left - 1, ++pixels)
      std::memset(column + pixels * kSamples, std::countr_zero(left), kSamples);
  }
  const std::span<const SamplePosition> positions = sample_positions(kSamples);
  for (std::uint32_t lane = 0; lane < target.x_fx8.size(); ++lane) {
    target.x_fx8[lane] = positions[lane % kSamples].x_fx8;
    target.y_fx8[lane] = positions[lane % kSamples].y_fx8;
  }
}

template <int kSamples>
int DrawMarked(const Pass::State& state, int tile, const PixelMask& mask, std::span<float> depth,
               std::span<std::uint32_t> primitive) {
  std::array<std::uint8_t, kSamples * PixelMask::kMaxRows * PixelMask::kMaxRows> column;
  SampleTarget target{mask,
                      tile_box(state.viewport, state.grid, tile),
                      sample_extent(kSamples),
                      static_cast<std::uint32_t>(depth.size()),
                      0,
                      0,
                      {},
                      {},
                      {},
                      column.data(),
                      depth.data(),
                      primitive.data()};
  // Fewer samples than a packet are drawn in a packet of their own.
  std::array<float, kLanes> few_depths;
  std::array<std::uint32_t, kLanes> few_primitives;
  const bool few = depth.size() < kLanes;
  if (few) {
    std::fill_n(column.begin(), kLanes, std::uint8_t{0});
    target.samples = kLanes;
    target.depth = few_depths.data();
    target.primitive = few_primitives.data();
  }
  std::fill_n(target.depth, target.samples, kEmptyDepth);
  std::fill_n(target.primitive, target.samples, kNoPrimitive);
  FindMarked<kSamples>(state, target, column.data());
  DrawTriangles<kSamples>(state, tile, target);
  if (few) {
    std::copy_n(few_depths.begin(), depth.size(), depth.begin());
    std::copy_n(few_primitives.begin(), depth.size(), primitive.begin());
  }
  return FinishSamples(depth, primitive);
}

int DrawSamples(const Pass::State& state, int tile, const PixelMask& mask, std::span<float> depth,
                std::span<std::uint32_t> primitive) {
  if (state.samples == 8) return DrawMarked<8>(state, tile, mask, depth, primitive);
  return DrawMarked<4>(state, tile, mask, depth, primitive);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::raster
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::raster {
namespace {

bool lies_in_tile(const PixelMask& mask, int tile_size_px) {
  std::uint64_t outside = 0;
  for (int y = 0; y < PixelMask::kMaxRows; ++y) {
    outside |= y < tile_size_px ? mask.row(y) & ~bits_between(0, tile_size_px - 1) : mask.row(y);
  }
  return outside == 0;
}

}  // namespace

HWY_EXPORT(DrawSamples);

int draw_samples(const Pass& pass, int tile, const PixelMask& mask, std::span<float> depth,
                 std::span<std::uint32_t> primitive) {
  const Pass::State& state = pass.state();
  SWELL_CHECK(state.samples != 0, "samples={}", state.samples);
  SWELL_CHECK(tile >= 0 && tile < state.grid.count(), "tile={} tiles={}", tile, state.grid.count());
  SWELL_CHECK(lies_in_tile(mask, state.grid.tile_size_px), "tile_size_px={}",
              state.grid.tile_size_px);
  const std::size_t samples = static_cast<std::size_t>(mask.count()) * state.samples;
  SWELL_CHECK(depth.size() == samples && primitive.size() == samples, "depth={} primitive={} of {}",
              depth.size(), primitive.size(), samples);
  if (samples == 0) return 0;
  return HWY_DYNAMIC_DISPATCH(DrawSamples)(state, tile, mask, depth, primitive);
}

}  // namespace swell::raster
#endif
