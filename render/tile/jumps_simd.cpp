#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "render/tile/jumps.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/tile/jumps_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using DU = hn::RebindToUnsigned<D>;
using V = hn::Vec<D>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(D()));
constexpr int kStride = JumpScratch::kStride, kRim = JumpScratch::kRim;

template <class Tag, class Mask>
HWY_INLINE std::uint64_t BitsOf(Tag d, Mask mask) {
  static_assert(kLanes <= 16);
  std::uint16_t bits = 0;
  hn::StoreMaskBits(d, mask, reinterpret_cast<std::uint8_t*>(&bits));
  return bits;
}

// Depth is linear in the window along a plane. A jump is more than this part of the depth itself
// and this much of the change next to it on either side. (More of that, twice with an eighth of the
// depth, marks more and finds less: behind a crest the far side is steep.)
constexpr float kTimesSlope = 0.25f;

// Where depth jumps between pixels p[0] and p[step], for pixels side by side: one bit a lane.
HWY_INLINE std::uint64_t Jumps(const float* p, int step) {
  const D d;
  const V b = hn::LoadU(d, p), c = hn::LoadU(d, p + step);
  const V jump = hn::Abs(hn::Sub(b, c));
  const V part = hn::Mul(hn::Max(b, c), hn::Set(d, kPartOfJump));
  if (hn::AllFalse(d, hn::Gt(jump, part))) return 0;
  const V before = hn::Abs(hn::Sub(hn::LoadU(d, p - step), b));
  const V after = hn::Abs(hn::Sub(c, hn::LoadU(d, p + 2 * step)));
  const V allowed = hn::MulAdd(hn::Max(before, after), hn::Set(d, kTimesSlope), part);
  return BitsOf(d, hn::Gt(jump, allowed));
}

// Pixels 0 to width - 1 of a row of depths that jump to the pixel `step` farther on.
HWY_INLINE std::uint64_t JumpsInRow(const float* row, int width, int step) {
  std::uint64_t jumps = 0;
  for (int x = 0; x < width; x += kLanes) jumps |= Jumps(row + x, step) << x;
  return jumps;
}

void MarkDepthJumps(const JumpScratch& scratch, int side, raster::PixelMask& mask) {
  const std::uint64_t inside = ~std::uint64_t{0} >> (64 - side);
  const float* above = scratch.depth.data() + (kRim - 1) * kStride + kRim;
  std::uint64_t from_above = JumpsInRow(above, side, kStride);
  for (int y = 0; y < side; ++y) {
    const float* row = scratch.depth.data() + (y + kRim) * kStride + kRim;
    const std::uint64_t right = JumpsInRow(row, side, 1);
    const std::uint64_t below = JumpsInRow(row, side, kStride);
    const std::uint64_t from_left = Jumps(row - 1, 1) & 1;
    mask.add_to_row(y, (right | right << 1 | from_left | below | from_above) & inside);
    from_above = below;
  }
}

// Which pixels of each row, from the one above the tile to the one below, show nothing nearer than
// depth z.
void PixelsBehind(const JumpScratch& scratch, int side, float z, std::uint64_t* bits) {
  const D d;
  const V nearest = hn::Set(d, z);
  for (int y = -1; y <= side; ++y) {
    const float* row = scratch.depth.data() + (y + kRim) * kStride + kRim;
    bits[y + 1] = 0;
    for (int x = 0; x < side; x += kLanes)
      bits[y + 1] |= BitsOf(d, hn::Le(hn::LoadU(d, row + x), nearest)) << x;
  }
}

// Which pixels of `rows` rows have primitives in [begin, end), one bit a pixel.
void PixelsOf(const std::uint32_t* primitive, int side, int rows, std::uint32_t begin,
              std::uint32_t end, std::uint64_t* bits) {
  const DU d;
  const auto first = hn::Set(d, begin), count = hn::Set(d, end - begin);
  for (int y = 0; y < rows; ++y) {
    bits[y] = 0;
    for (int x = 0; x < side; x += kLanes)
      bits[y] |= BitsOf(d, hn::Lt(hn::Sub(hn::LoadU(d, primitive + y * side + x), first), count))
                 << x;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(MarkDepthJumps);
HWY_EXPORT(PixelsBehind);
HWY_EXPORT(PixelsOf);

namespace {

constexpr int kRim = JumpScratch::kRim, kStride = JumpScratch::kStride;

std::uint64_t lowest_bits(int count) { return ~std::uint64_t{0} >> (64 - count); }

// A tile and its neighbours in the visibility buffer. Null pointers are open sky.
struct TileAround {
  struct Buffers {
    bool exists = false;  // inside the picture
    const float* depth = nullptr;
    const std::uint32_t* primitive = nullptr;
  };
  raster::PixelBox box;
  int side, right_px, below_px;  // pixels of the picture right of the tile and below
  Buffers here, left, right, above, below;
};

TileAround look_around(const VisibilityBuffer& visibility, raster::Viewport viewport, int tile) {
  const raster::TileGrid& grid = visibility.grid;
  const int tx = tile % grid.tiles_x, ty = tile / grid.tiles_x;
  const auto at = [&](int x, int y) {
    TileAround::Buffers buffers;
    if (x < 0 || y < 0 || x >= grid.tiles_x || y >= grid.tiles_y) return buffers;
    const int index = y * grid.tiles_x + x;
    buffers.exists = true;
    if (visibility.covered[static_cast<std::size_t>(index)] < 0) return buffers;
    buffers.depth = visibility.depth_of(index).data();
    buffers.primitive = visibility.primitive_of(index).data();
    return buffers;
  };
  const raster::PixelBox box = raster::tile_box(viewport, grid, tile);
  return {box,
          grid.tile_size_px,
          viewport.width_px - box.x0_px - box.width_px,
          viewport.height_px - box.y0_px - box.height_px,
          at(tx, ty),
          at(tx - 1, ty),
          at(tx + 1, ty),
          at(tx, ty - 1),
          at(tx, ty + 1)};
}

float depth_at(const TileAround::Buffers& tile, int i) { return tile.depth ? tile.depth[i] : 0.0f; }

// Row y of the tile, from -kRim to below its last one, goes to `out`.
void copy_row(const TileAround& t, int y, float* out) {
  const TileAround::Buffers* from = &t.here;
  int row = std::clamp(y, 0, t.box.height_px - 1);
  if (y < 0 && t.above.exists) from = &t.above, row = t.side + y;
  if (y >= t.box.height_px && t.below.exists)
    from = &t.below, row = std::min(y - t.box.height_px, t.below_px - 1);
  if (from->depth)
    std::copy_n(from->depth + row * t.side, t.box.width_px, out);
  else
    std::fill_n(out, t.box.width_px, 0.0f);
}

// The pixels left and right of row y of the tile.
void copy_rim(const TileAround& t, int y, float* out) {
  const int width = t.box.width_px, row = y * t.side;
  for (int k = 1; k <= kRim; ++k) {
    out[-k] = t.left.exists ? depth_at(t.left, row + t.side - k) : out[0];
    out[width + k - 1] =
        t.right.exists ? depth_at(t.right, row + std::min(k, t.right_px) - 1) : out[width - 1];
  }
}

void copy_depth(const TileAround& t, JumpScratch& scratch) {
  for (int y = -kRim; y < t.box.height_px + kRim; ++y) {
    float* out = scratch.depth.data() + (y + kRim) * kStride + kRim;
    copy_row(t, y, out);
    if (y >= 0 && y < t.box.height_px) copy_rim(t, y, out);
  }
}

// The tile's rows with the one above and the one below: which pixels show primitives in
// [begin, end). Row y of the tile is bits[y + 1].
using RowBits = std::array<std::uint64_t, JumpScratch::kSide + 2>;

RowBits rows_of(const TileAround& t, std::uint32_t begin, std::uint32_t end) {
  RowBits bits{};
  const int height = t.box.height_px;
  const auto fill = [&](const TileAround::Buffers& tile, int row, int rows, int to) {
    if (tile.primitive) HWY_DYNAMIC_DISPATCH(PixelsOf)
    (tile.primitive + row * t.side, t.side, rows, begin, end, bits.data() + to);
  };
  fill(t.here, 0, height, 1);
  bits[0] = bits[1];
  bits[height + 1] = bits[height];
  if (t.above.exists) bits[0] = 0, fill(t.above, t.side - 1, 1, 0);
  if (t.below.exists) bits[height + 1] = 0, fill(t.below, 0, 1, height + 1);
  return bits;
}

// Calls visit(y, row, differs) for the tile's rows: which pixels show primitives in [begin, end),
// and for which a neighbour does not what they do.
template <class Visit>
void for_each_row(const TileAround& t, std::uint32_t begin, std::uint32_t end, const Visit& visit) {
  const int width = t.box.width_px;
  const RowBits bits = rows_of(t, begin, end);
  const auto pixel_of = [&](const TileAround::Buffers& tile, int i) {
    return std::uint64_t{tile.primitive && tile.primitive[i] - begin < end - begin};
  };
  for (int y = 0; y < t.box.height_px; ++y) {
    const std::uint64_t row = bits[y + 1] & lowest_bits(width);
    const std::uint64_t left = t.left.exists ? pixel_of(t.left, y * t.side + t.side - 1) : row & 1;
    const std::uint64_t right =
        t.right.exists ? pixel_of(t.right, y * t.side) : row >> (width - 1) & 1;
    const std::uint64_t differs = (row ^ bits[y]) | (row ^ bits[y + 2]) |
                                  (row ^ (row << 1 | left)) |
                                  (row ^ (row >> 1 | right << (width - 1)));
    visit(y, row, differs & lowest_bits(width));
  }
}

// Whether all that the tile and its neighbours show is the water, as most tiles do.
bool is_open_water(const VisibilityBuffer& visibility, const TileAround& t, int tile) {
  const int full = t.side * t.side;
  const raster::TileGrid& grid = visibility.grid;
  const auto is_water = [&](const TileAround::Buffers& buffers, int index) {
    return !buffers.exists || visibility.water_pixels[static_cast<std::size_t>(index)] == full;
  };
  return is_water(t.here, tile) && is_water(t.left, tile - 1) && is_water(t.right, tile + 1) &&
         is_water(t.above, tile - grid.tiles_x) && is_water(t.below, tile + grid.tiles_x);
}

}  // namespace

void mark_jumps(const VisibilityBuffer& visibility, const PrimitiveRanges& primitives,
                raster::Viewport viewport, int tile, JumpScratch& scratch,
                raster::PixelMask& mask) {
  const TileAround around = look_around(visibility, viewport, tile);
  copy_depth(around, scratch);
  raster::PixelMask jumps;
  HWY_DYNAMIC_DISPATCH(MarkDepthJumps)(scratch, around.side, jumps);
  for (int y = 0; y < around.box.height_px; ++y)
    mask.add_to_row(y, jumps.row(y) & lowest_bits(around.box.width_px));
  if (is_open_water(visibility, around, tile)) return;
  for (const SurfaceKind kind : kAllSurfaces)
    if (!primitives.empty(kind))
      for_each_row(
          around, primitives.begin(kind), primitives.end(kind),
          [&](int y, std::uint64_t, std::uint64_t differs) { mask.add_to_row(y, differs); });
}

raster::PixelMask find_behind(const JumpScratch& scratch, int side, float z) {
  RowBits bits{};
  HWY_DYNAMIC_DISPATCH(PixelsBehind)(scratch, side, z, bits.data());
  raster::PixelMask behind;
  for (int y = 0; y < side; ++y) {
    const float* row = scratch.depth.data() + (y + kRim) * kStride + kRim;
    const std::uint64_t here = bits[y + 1], left = row[-1] <= z, right = row[side] <= z;
    behind.set_row(
        y, (here | bits[y] | bits[y + 2] | here << 1 | left | here >> 1 | right << (side - 1)) &
               lowest_bits(side));
  }
  return behind;
}

raster::PixelMask find_interior(const VisibilityBuffer& visibility, raster::Viewport viewport,
                                int tile, std::uint32_t begin, std::uint32_t end) {
  raster::PixelMask interior;
  for_each_row(look_around(visibility, viewport, tile), begin, end,
               [&](int y, std::uint64_t row, std::uint64_t differs) {
                 interior.set_row(y, row & ~differs);
               });
  return interior;
}

}  // namespace swell::render
#endif  // HWY_ONCE
