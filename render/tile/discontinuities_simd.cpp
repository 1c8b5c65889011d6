#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>

#include "render/tile/discontinuities.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/tile/discontinuities_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "math/lanes-inl.h"
#include "render/view/render_view.h"
#include "render/view/visibility.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

constexpr int kLanes = static_cast<int>(hn::MaxLanes(D()));
constexpr int kStride = DiscontinuityScratch::kStride, kRim = DiscontinuityScratch::kRim;

template <class Tag, class Mask>
HWY_INLINE std::uint64_t BitsOf(Tag d, Mask mask) {
  static_assert(kLanes <= 16);
  std::uint16_t bits = 0;
  hn::StoreMaskBits(d, mask, reinterpret_cast<std::uint8_t*>(&bits));
  return bits;
}

// Depth is linear in the window along a plane. A discontinuity is more than this part of the depth
// itself and this much of the change next to it on either side. (More of that, twice with an eighth
// of the depth, marks more and finds less: behind a crest the far side is steep.)
constexpr float kTimesSlope = 0.25f;

// Where depth has a discontinuity between pixels p[0] and p[step], for pixels side by side: one bit
// a lane.
HWY_INLINE std::uint64_t Discontinuities(const float* p, int step) {
  const D d;
  const V b = hn::LoadU(d, p), c = hn::LoadU(d, p + step);
  const V difference = Abs(b - c);
  const V part = Max(b, c) * kPartOfDiscontinuity;
  if (hn::AllFalse(d, difference > part)) return 0;
  const V before = Abs(hn::LoadU(d, p - step) - b);
  const V after = Abs(c - hn::LoadU(d, p + 2 * step));
  const V allowed = MulAdd(Max(before, after), kTimesSlope, part);
  return BitsOf(d, difference > allowed);
}

// Pixels 0 to width - 1 of a row of depths with a discontinuity towards the pixel `step` farther
// on.
HWY_INLINE std::uint64_t DiscontinuitiesInRow(const float* row, int width, int step) {
  std::uint64_t found = 0;
  for (int x = 0; x < width; x += kLanes) found |= Discontinuities(row + x, step) << x;
  return found;
}

void MarkDepthDiscontinuities(const DiscontinuityScratch& scratch, int side,
                              raster::PixelMask& mask) {
  const std::uint64_t inside = ~std::uint64_t{0} >> (64 - side);
  const float* above = scratch.depth.data() + (kRim - 1) * kStride + kRim;
  std::uint64_t from_above = DiscontinuitiesInRow(above, side, kStride);
  for (int y = 0; y < side; ++y) {
    const float* row = scratch.depth.data() + (y + kRim) * kStride + kRim;
    const std::uint64_t right = DiscontinuitiesInRow(row, side, 1);
    const std::uint64_t below = DiscontinuitiesInRow(row, side, kStride);
    const std::uint64_t from_left = Discontinuities(row - 1, 1) & 1;
    mask.add_to_row(y, (right | right << 1 | from_left | below | from_above) & inside);
    from_above = below;
  }
}

// Which pixels of each row, from the one above the tile to the one below, show nothing nearer than
// depth z.
void PixelsBehind(const DiscontinuityScratch& scratch, int side, float z, std::uint64_t* bits) {
  const D d;
  const V nearest = hn::Set(d, z);
  for (int y = -1; y <= side; ++y) {
    const float* row = scratch.depth.data() + (y + kRim) * kStride + kRim;
    bits[y + 1] = 0;
    for (int x = 0; x < side; x += kLanes)
      bits[y + 1] |= BitsOf(d, hn::LoadU(d, row + x) <= nearest) << x;
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
      bits[y] |= BitsOf(d, hn::LoadU(d, primitive + y * side + x) - first < count) << x;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(MarkDepthDiscontinuities);
HWY_EXPORT(PixelsBehind);
HWY_EXPORT(PixelsOf);

namespace {

constexpr int kRim = DiscontinuityScratch::kRim, kStride = DiscontinuityScratch::kStride;

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

void copy_depth(const TileAround& t, DiscontinuityScratch& scratch) {
  for (int y = -kRim; y < t.box.height_px + kRim; ++y) {
    float* out = scratch.depth.data() + (y + kRim) * kStride + kRim;
    copy_row(t, y, out);
    if (y >= 0 && y < t.box.height_px) copy_rim(t, y, out);
  }
}

// Primitives in [begin, end), but for those that have a 1 in `except`, unless that is empty.
struct PrimitiveSet {
  std::uint32_t begin, end;
  std::span<const std::uint8_t> except = {};

  bool holds(std::uint32_t primitive) const {
    const std::uint32_t n = primitive - begin;
    return n < end - begin && (except.empty() || except[n] == 0);
  }
};

// Which pixels of `rows` rows of a tile show the set, one bit a pixel.
void pixels_of(const std::uint32_t* primitive, int side, int rows, const PrimitiveSet& set,
               std::uint64_t* bits) {
  HWY_DYNAMIC_DISPATCH(PixelsOf)(primitive, side, rows, set.begin, set.end, bits);
  if (set.except.empty()) return;
  for (int y = 0; y < rows; ++y) {
    std::uint64_t excepted = 0;
    for (std::uint64_t left = bits[y]; left != 0; left &= left - 1) {
      const int x = std::countr_zero(left);
      excepted |= std::uint64_t{set.except[primitive[y * side + x] - set.begin]} << x;
    }
    bits[y] ^= excepted;
  }
}

// Which pixels of a tile and around it show a set, one bit each: the tile's rows with the one above
// and the one below, row y of the tile in rows[y + 1], and the pixels beside them, bit y.
using RowBits = std::array<std::uint64_t, DiscontinuityScratch::kSide + 2>;
struct PixelBits {
  RowBits rows{};
  std::uint64_t left = 0, right = 0;

  PixelBits operator|(PixelBits other) const {
    other.left |= left, other.right |= right;
    for (std::size_t y = 0; y < rows.size(); ++y) other.rows[y] |= rows[y];
    return other;
  }
};

PixelBits bits_of(const TileAround& t, const PrimitiveSet& set) {
  PixelBits bits;
  RowBits& rows = bits.rows;
  const int height = t.box.height_px, width = t.box.width_px;
  const auto fill = [&](const TileAround::Buffers& tile, int row, int count, int to) {
    if (tile.primitive)
      pixels_of(tile.primitive + row * t.side, t.side, count, set, rows.data() + to);
  };
  fill(t.here, 0, height, 1);
  rows[0] = rows[1];
  rows[height + 1] = rows[height];
  if (t.above.exists) rows[0] = 0, fill(t.above, t.side - 1, 1, 0);
  if (t.below.exists) rows[height + 1] = 0, fill(t.below, 0, 1, height + 1);
  const auto has = [&](const TileAround::Buffers& tile, int at, std::uint64_t else_bit) {
    if (!tile.exists) return else_bit & 1;
    return std::uint64_t{tile.primitive && set.holds(tile.primitive[at])};
  };
  for (int y = 0; y < height; ++y) {
    bits.left |= has(t.left, y * t.side + t.side - 1, rows[y + 1]) << y;
    bits.right |= has(t.right, y * t.side, rows[y + 1] >> (width - 1)) << y;
  }
  return bits;
}

// Pixels of row y of the tile whose left neighbours have a bit, and whose right ones.
struct Beside {
  std::uint64_t left, right;
};

Beside pixels_beside(const PixelBits& bits, int y, int width) {
  const std::uint64_t row = bits.rows[y + 1] & lowest_bits(width);
  const std::uint64_t left = bits.left >> y & 1, right = bits.right >> y & 1;
  return {row << 1 | left, row >> 1 | right << (width - 1)};
}

// Calls visit(y, row, differs) for the tile's rows: which pixels have a bit, and for which a
// neighbour has not what they have.
template <class Visit>
void for_each_row(const TileAround& t, const PixelBits& bits, const Visit& visit) {
  const int width = t.box.width_px;
  for (int y = 0; y < t.box.height_px; ++y) {
    const std::uint64_t row = bits.rows[y + 1] & lowest_bits(width);
    const Beside beside = pixels_beside(bits, y, width);
    const std::uint64_t differs = (row ^ bits.rows[y]) | (row ^ bits.rows[y + 2]) |
                                  (row ^ beside.left) | (row ^ beside.right);
    visit(y, row, differs & lowest_bits(width));
  }
}

void mark_borders(const TileAround& t, const PixelBits& bits, raster::PixelMask& mask) {
  for_each_row(t, bits,
               [&](int y, std::uint64_t, std::uint64_t differs) { mask.add_to_row(y, differs); });
}

// Marks the pixels of each set that have a neighbour of the other.
void mark_contacts(const TileAround& t, const PixelBits& a, const PixelBits& b,
                   raster::PixelMask& mask) {
  const int width = t.box.width_px;
  const auto neighbours = [&](const PixelBits& bits, int y) {
    const Beside beside = pixels_beside(bits, y, width);
    return bits.rows[y] | bits.rows[y + 2] | beside.left | beside.right;
  };
  for (int y = 0; y < t.box.height_px; ++y) {
    const std::uint64_t of_a = a.rows[y + 1] & neighbours(b, y);
    const std::uint64_t of_b = b.rows[y + 1] & neighbours(a, y);
    mask.add_to_row(y, (of_a | of_b) & lowest_bits(width));
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

void mark_discontinuities(const VisibilityBuffer& visibility, const RenderView& window, int tile,
                          DiscontinuityScratch& scratch, raster::PixelMask& mask) {
  const TileAround around = look_around(visibility, window.viewport(), tile);
  copy_depth(around, scratch);
  raster::PixelMask found;
  HWY_DYNAMIC_DISPATCH(MarkDepthDiscontinuities)(scratch, around.side, found);
  for (int y = 0; y < around.box.height_px; ++y)
    mask.add_to_row(y, found.row(y) & lowest_bits(around.box.width_px));
  if (is_open_water(visibility, around, tile)) return;
  const PrimitiveRanges& primitives = window.primitives;
  EnumTable<SurfaceKind, std::optional<PixelBits>> of_kind;  // by SurfaceTraits::edges_as
  for (const SurfaceKind surface : kAllSurfaces) {
    if (primitives.empty(surface)) continue;
    const PixelBits bits = bits_of(around, {primitives.begin(surface), primitives.end(surface)});
    std::optional<PixelBits>& all = of_kind[kSurfaceTraits[surface].edges_as];
    all = all ? *all | bits : bits;
  }
  for (const std::optional<PixelBits>& bits : of_kind)
    if (bits) mark_borders(around, *bits, mask);
  // Between what is of one kind where it stands out against the other.
  for (const SurfaceKind surface : kAllSurfaces) {
    const std::span<const std::uint8_t> like_land = window.draws[surface].like_land;
    if (like_land.empty()) continue;
    const std::uint32_t begin = primitives.begin(surface), end = primitives.end(surface);
    const SurfaceKind land = kSurfaceTraits[surface].edges_as;
    mark_contacts(around, bits_of(around, {primitives.begin(land), primitives.end(land)}),
                  bits_of(around, {begin, end, like_land}), mask);
  }
}

raster::PixelMask find_behind(const DiscontinuityScratch& scratch, int side, float z) {
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
  const TileAround around = look_around(visibility, viewport, tile);
  for_each_row(around, bits_of(around, {begin, end}),
               [&](int y, std::uint64_t row, std::uint64_t differs) {
                 interior.set_row(y, row & ~differs);
               });
  return interior;
}

}  // namespace swell::render
#endif  // HWY_ONCE
