#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "math/check.h"
#include "raster/pass_state.h"
#include "raster/sample_edges.h"
#include "raster/samples.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/draw_samples_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace swell::raster {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// While samples are drawn, one without a triangle has this depth, so that depth 0 still wins.
constexpr float kEmptyDepth = -1.0f;

// The marked pixels of a tile and their samples. Lanes are the samples of one pixel.
struct SampleTarget {
  const PixelMask& mask;
  PixelBox box;
  SampleExtent extent;
  std::uint64_t rows, columns;                               // that hold a marked pixel
  std::array<std::uint32_t, PixelMask::kMaxRows> row_begin;  // marked pixels in the rows above
  alignas(64) std::array<std::int32_t, kMaxSamples> x_fx8, y_fx8;
  float* HWY_RESTRICT depth;
  std::uint32_t* HWY_RESTRICT primitive;
};

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

// The rows of the rectangle that hold a marked pixel of it, from the first one on.
HWY_INLINE std::uint64_t RowsFromFirstMarked(const SampleTarget& target, const PixelRect& rect,
                                             std::uint64_t columns) {
  std::uint64_t rows = target.rows & bits_between(rect.y0, rect.y1);
  while (rows != 0 && (target.mask.row(std::countr_zero(rows)) & columns) == 0) rows &= rows - 1;
  return rows;
}

// A pixel's step in E is 256 a or 256 b exactly, and sample positions are multiples of 16 / 256 px,
// so a sample is inside an edge if
//   floor(E / 256) = e + a dx + b dy >= 0 with e = floor((E(corner) + a x_fx8 + b y_fx8) / 256),
// which fits 32 bits with E(corner) / 16 taken apart into whole pixels and the rest.
template <int kSamples>
HWY_INLINE void SampleTriangle(const SetupTriangle& t, const SampleTarget& target) {
  const hn::CappedTag<float, kSamples> d;
  const hn::RebindToSigned<decltype(d)> di;
  static_assert(hn::MaxLanes(d) == kSamples, "a pixel's samples are one vector");

  // Is there anything to do?
  const PixelRect rect = sample_rect_in_tile(t, target.extent, target.box);
  if (rect.empty()) return;
  const std::uint64_t columns = bits_between(rect.x0, rect.x1);
  std::uint64_t rows = RowsFromFirstMarked(target, rect, columns);
  if (rows == 0) return;
  std::array<SampleEdge, 3> edges;
  if (!set_up_sample_edges(t, target.extent, target.box, rect, edges)) return;

  // Edges at the samples of the rectangle's first pixel.
  const auto x_fx8 = hn::Load(di, target.x_fx8.data()), y_fx8 = hn::Load(di, target.y_fx8.data());
  const auto x_step = hn::ShiftRight<4>(x_fx8), y_step = hn::ShiftRight<4>(y_fx8);
  const auto first = [&](const SampleEdge& edge) {
    const auto whole = static_cast<std::int32_t>(edge.at_corner >> kFractionBits);
    const auto rest = static_cast<std::int32_t>(edge.at_corner >> 4) & 15;
    const auto offset =
        hn::Add(hn::Mul(hn::Set(di, edge.a), x_step), hn::Mul(hn::Set(di, edge.b), y_step));
    return hn::Add(hn::Set(di, whole), hn::ShiftRight<4>(hn::Add(hn::Set(di, rest), offset)));
  };
  const auto e0 = first(edges[0]), e1 = first(edges[1]), e2 = first(edges[2]);

  // Offsets from the depth plane's reference, exact: multiples of 1/256 below 2^15.
  const auto to_px = hn::Set(d, 1.0f / kPixelFx8);
  const std::int32_t corner_x = (target.box.x0_px + rect.x0) * kPixelFx8 - t.x_ref_fx8;
  const std::int32_t corner_y = (target.box.y0_px + rect.y0) * kPixelFx8 - t.y_ref_fx8;
  const auto dx = hn::Mul(hn::ConvertTo(d, hn::Add(hn::Set(di, corner_x), x_fx8)), to_px);
  const auto dy = hn::Mul(hn::ConvertTo(d, hn::Add(hn::Set(di, corner_y), y_fx8)), to_px);
  const auto dz_dx = hn::Set(d, t.dz_dx), dz_dy = hn::Set(d, t.dz_dy);
  const auto z_min = hn::Set(d, t.z_min), z_max = hn::Set(d, t.z_max);
  const auto primitive = hn::BitCast(d, hn::Set(di, static_cast<std::int32_t>(t.primitive)));

  for (; rows != 0; rows &= rows - 1) {
    const std::int32_t y = std::countr_zero(rows);
    const std::uint64_t marked = target.mask.row(y);
    const std::int32_t down = y - rect.y0;
    const auto f0 = hn::Add(e0, hn::Set(di, edges[0].b * down));
    const auto f1 = hn::Add(e1, hn::Set(di, edges[1].b * down));
    const auto f2 = hn::Add(e2, hn::Set(di, edges[2].b * down));
    const auto z_row = hn::MulAdd(dz_dy, hn::Add(dy, hn::Set(d, static_cast<float>(down))), z_min);
    const int before = std::popcount(marked & ~(~std::uint64_t{0} << rect.x0));
    const std::size_t n = (target.row_begin[y] + static_cast<std::uint32_t>(before)) * kSamples;
    float* HWY_RESTRICT depth = target.depth + n;
    float* HWY_RESTRICT id = reinterpret_cast<float*>(target.primitive) + n;
    for (std::uint64_t left = marked & columns; left != 0; left &= left - 1) {
      const std::int32_t right = std::countr_zero(left) - rect.x0;
      // Covered?
      const auto g0 = hn::Add(f0, hn::Set(di, edges[0].a * right));
      const auto g1 = hn::Add(f1, hn::Set(di, edges[1].a * right));
      const auto g2 = hn::Add(f2, hn::Set(di, edges[2].a * right));
      const auto inside = hn::RebindMask(d, hn::Gt(hn::Or(hn::Or(g0, g1), g2), hn::Set(di, -1)));
      // Nearest?
      const auto x_offset = hn::Add(dx, hn::Set(d, static_cast<float>(right)));
      const auto z = hn::Min(hn::Max(hn::MulAdd(dz_dx, x_offset, z_row), z_min), z_max);
      const auto old = hn::LoadU(d, depth);
      const auto wins = hn::And(inside, hn::Gt(z, old));
      hn::StoreU(hn::IfThenElse(wins, z, old), d, depth);
      hn::StoreU(hn::IfThenElse(wins, primitive, hn::LoadU(d, id)), d, id);
      depth += kSamples, id += kSamples;
    }
  }
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
void DrawTriangles(const Pass::State& state, int tile, const SampleTarget& target) {
  for (std::size_t c = 0; c < state.chunk_count; ++c) {
    const Chunk& chunk = state.chunks[c];
    const std::uint32_t end = chunk.tile_begin[tile + 1];
    for (std::uint32_t m = chunk.tile_begin[tile]; m < end; ++m) {
      const SetupTriangle& t = chunk.triangles[chunk.members[m]];
      if (MayHoldMarked(t, target)) SampleTriangle<kSamples>(t, target);
    }
  }
}

int DrawSamples(const Pass::State& state, int tile, const PixelMask& mask, std::span<float> depth,
                std::span<std::uint32_t> primitive) {
  std::fill(depth.begin(), depth.end(), kEmptyDepth);
  std::fill(primitive.begin(), primitive.end(), kNoPrimitive);

  // Where the marked pixels are.
  SampleTarget target{mask,
                      tile_box(state.viewport, state.grid, tile),
                      sample_extent(state.samples),
                      0,
                      0,
                      {},
                      {},
                      {},
                      depth.data(),
                      primitive.data()};
  std::uint32_t pixels = 0;
  for (int y = 0; y < state.grid.tile_size_px; ++y) {
    const std::uint64_t bits = mask.row(y);
    target.row_begin[y] = pixels;
    pixels += static_cast<std::uint32_t>(std::popcount(bits));
    target.rows |= std::uint64_t{bits != 0} << y;
    target.columns |= bits;
  }
  const std::span<const SamplePosition> positions = sample_positions(state.samples);
  for (std::size_t s = 0; s < positions.size(); ++s) {
    target.x_fx8[s] = positions[s].x_fx8;
    target.y_fx8[s] = positions[s].y_fx8;
  }

  if (state.samples == 8) {
    DrawTriangles<8>(state, tile, target);
  } else {
    DrawTriangles<4>(state, tile, target);
  }
  return FinishSamples(depth, primitive);
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
