// Shading at the rate that the picture needs: some columns of a tile first, then those between
// whose neighbours differ; the others get the light between their neighbours'.
//
// Columns are shaded in three rounds, in blocks of 16 x 16 pixels that no tile size cuts, so that a
// pixel is the same whatever the tiles:
//   0 . . . 4 . . . 8 . . . 12 . . 15   first, of even rows
//   0 . 2 . . . 6 . . . 10 . . . 14 15  first, of odd rows
//   . . 2 . . . 6 . . . 10 . . . 14 .   second, between those
//   . . . . 4 . . . 8 . . . 12 . . . .
//   . 1 . 3 . 5 . 7 . 9 . 11 . 13 . .   third, between all of those
// A pixel is filled in if it and its two neighbours show one material and no edge, and if these are
// about as bright as each other. In the second round they may differ by kMostAlong, and what the
// pixel would get from the pixels above and below, which were shaded in the first, by kMostAcross.
// In the third their difference and half of the same of the columns two to the left and right may
// be kMostAround, here and in the rows above and below: among waves as fine as pixels neighbours
// may be alike by chance, but not all around. Waves lie across the picture, so that columns may be
// far apart, and rows may not. What is two pixels wide (a pole in the mirror, a mast's shadow)
// cannot hide between columns: every second row meets it, and the rows around it are held against
// that one. Bright means what BrightnessScaleOf() says.
#if defined(SWELL_RENDER_SHADE_ADAPTIVE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_SHADE_ADAPTIVE_INL_H_
#undef SWELL_RENDER_SHADE_ADAPTIVE_INL_H_
#else
#define SWELL_RENDER_SHADE_ADAPTIVE_INL_H_
#endif

#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>

#include "render/shade/pixel_lists-inl.h"
#include "render/tile/shading_result-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// A row of a tile, a bit a pixel.
using RowBits = std::uint64_t;
using TileBits = std::array<RowBits, 64>;

constexpr int kBlockSize = 16;
constexpr RowBits EachBlock(std::uint16_t columns) { return columns * 0x0001'0001'0001'0001u; }
using ByParity = std::array<RowBits, 2>;  // of even and of odd rows
constexpr ByParity kFirstColumns = {EachBlock(0x9111), EachBlock(0xc445)};
constexpr RowBits kColumn14 = EachBlock(0x4000);

// A round between columns `step` away, or 1 on the right of column 14.
struct Round {
  ByParity columns;
  int step;
};
constexpr Round kSecond = {{EachBlock(0x4444), EachBlock(0x1110)}, 2};
constexpr Round kThird = {{EachBlock(0x2aaa), EachBlock(0x2aaa)}, 1};
static_assert((kFirstColumns[0] | kSecond.columns[0] | kThird.columns[0]) == ~RowBits{0});
static_assert((kFirstColumns[1] | kSecond.columns[1] | kThird.columns[1]) == ~RowBits{0});
constexpr float kMostAlong = 8.0f, kMostAcross = 5.0f;  // differences in brightness, of 255
constexpr float kMostAround = 17.0f;                    // of a column and half of each beside it

HWY_INLINE RowBits BitsOf(M mask) {
  std::conditional_t<kLanes <= 8, std::uint8_t, std::uint16_t> bits = 0;
  hn::StoreMaskBits(D(), mask, reinterpret_cast<std::uint8_t*>(&bits));
  return bits;
}

HWY_INLINE M LanesOf(RowBits bits) {
  const auto lanes = static_cast<std::uint16_t>(bits & ~RowBits{0} >> (64 - kLanes));
  return hn::LoadMaskBits(D(), reinterpret_cast<const std::uint8_t*>(&lanes));
}

// The surfaces of a tile: whose pixels are where, and which are not to be filled in.
struct TileSurfaces {
  std::array<TileBits, kMaterialCount> of{};
  TileBits all{}, always{};
  std::array<std::size_t, kMaterialCount> materials;  // that there are any of
  std::size_t material_count = 0;

  auto present() const { return std::span(materials).first(material_count); }
};

// Finds material kMaterial in a tile.
template <std::size_t kMaterial>
HWY_INLINE void FindSurface(const Shading& s, const TilePixels& tile, TileSurfaces& surfaces) {
  constexpr SurfaceKind kKind = std::tuple_element_t<kMaterial, Materials>::kSurface;
  if (s.primitives.empty(kKind)) return;
  const DU du;
  const std::uint32_t begin = s.primitives.begin(kKind), size = s.primitives.end(kKind) - begin;
  const int side = s.grid.tile_size_px, width = tile.box.width_px;
  RowBits any = 0;
  for (int y = 0; y < tile.box.height_px; ++y) {
    RowBits row = 0;
    for (int x = 0; x < width; x += static_cast<int>(kLanes)) {
      const VU primitive = hn::LoadU(du, tile.primitive + y * side + x);
      row |= BitsOf(hn::RebindMask(D(), primitive - hn::Set(du, begin) < size)) << x;
    }
    row &= ~RowBits{0} >> (64 - width);
    surfaces.of[kMaterial][y] = row;
    surfaces.all[y] |= row;
    if (!kSurfaceTraits[kKind].varies_slowly) surfaces.always[y] |= row;
    any |= row;
  }
  if (any != 0) surfaces.materials[surfaces.material_count++] = kMaterial;
}

inline HWY_NOINLINE void FindSurfaces(const Shading& s, const TilePixels& tile,
                                      TileSurfaces& surfaces) {
  [&]<std::size_t... k>(std::index_sequence<k...>) HWY_ATTR {
    (FindSurface<k>(s, tile, surfaces), ...);
  }
  (std::make_index_sequence<kMaterialCount>());
  const int side = s.grid.tile_size_px;
  for (const EdgeFragment& fragment : tile.fragments)
    surfaces.always[fragment.pixel / side] |= RowBits{1} << fragment.pixel % side;
}

// Lists the first pixels of packets with any sky, as SortByMaterial() does.
inline PixelList ListSky(const Shading& s, const TilePixels& tile, const TileSurfaces& surfaces,
                         ShadeScratch& scratch) {
  PixelList list{scratch.lists[kSky].data()};
  constexpr RowBits kWhole = ~RowBits{0} >> (64 - kLanes);
  for (int y = 0; y < tile.box.height_px; ++y)
    for (int x = 0; x < tile.box.width_px; x += static_cast<int>(kLanes))
      if ((surfaces.all[y] >> x & kWhole) != kWhole)
        list.Append(static_cast<std::uint16_t>(y * s.grid.tile_size_px + x));
  return list;
}

// Lists by material the pixels of `rows`.
inline HWY_NOINLINE PixelLists ListRows(const Shading& s, const TileBits& rows, int height,
                                        const TileSurfaces& surfaces, ShadeScratch& scratch) {
  PixelLists lists;
  for (const std::size_t k : surfaces.present()) {
    std::uint16_t* const begin = scratch.lists[k].data();
    std::uint16_t* end = begin;
    for (int y = 0; y < height; ++y) {
      const int first = y * s.grid.tile_size_px;
      for (RowBits row = rows[y] & surfaces.of[k][y]; row != 0; row &= row - 1)
        *end++ = static_cast<std::uint16_t>(first + std::countr_zero(row));
    }
    lists[k] = {begin, static_cast<std::size_t>(end - begin)};
    PadToPackets(lists[k]);
  }
  return lists;
}

// The columns whose values in a and b differ by more than `most`.
HWY_INLINE RowBits Differ(const float* a, const float* b, int side, float most) {
  const D d;
  RowBits bits = 0;
  for (int x = 0; x < side; x += static_cast<int>(kLanes))
    bits |= BitsOf(hn::AbsDiff(hn::LoadU(d, a + x), hn::LoadU(d, b + x)) > most) << x;
  return bits;
}

// Every second of the numbers of `low` and `high`, from the first or the second on.
HWY_INLINE V Evens(V low, V high) { return hn::ConcatEven(D(), high, low); }
HWY_INLINE V Odds(V low, V high) { return hn::ConcatOdd(D(), high, low); }

// The k-th part of what kLanes pixels hold.
HWY_INLINE V PartOf(const PixelLight* pixels, std::size_t k) {
  return hn::Load(D(), &pixels->red + k * kLanes);
}

inline HWY_NOINLINE void FindBrightness(int side, int height, ShadeScratch& scratch) {
  const auto count = static_cast<std::size_t>(side * height);
  for (std::size_t at = 0; at < count; at += kLanes) {
    const PixelLight* const pixels = scratch.pixels.data() + at;
    const V low = Odds(PartOf(pixels, 0), PartOf(pixels, 1));
    const V high = Odds(PartOf(pixels, 2), PartOf(pixels, 3));
    hn::Store(Odds(low, high), D(), scratch.brightness.data() + at);
  }
}

// Puts the surfaces' light where the tile's is.
inline HWY_NOINLINE void WriteSurfaces(int side, int height, const TileBits& surfaces,
                                       ShadeScratch& scratch) {
  const D d;
  constexpr RowBits kWhole = ~RowBits{0} >> (64 - kLanes);
  const auto write = [&](RowBits shown, V values, float* to) HWY_ATTR {
    if (shown == kWhole)
      hn::Store(values, d, to);
    else
      hn::BlendedStore(values, LanesOf(shown), d, to);
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < side; x += static_cast<int>(kLanes)) {
      const RowBits shown = surfaces[y] >> x & kWhole;
      if (shown == 0) continue;
      const auto at = static_cast<std::size_t>(y * side + x);
      const PixelLight* const pixels = scratch.pixels.data() + at;
      const V a = PartOf(pixels, 0), b = PartOf(pixels, 1);
      const V c = PartOf(pixels, 2), e = PartOf(pixels, 3);
      const V low = Evens(a, b), high = Evens(c, e);
      write(shown, Evens(low, high), scratch.red.data() + at);
      write(shown, Evens(Odds(a, b), Odds(c, e)), scratch.green.data() + at);
      write(shown, Odds(low, high), scratch.blue.data() + at);
    }
}

// Puts the light between neighbours into the columns `row` of a round.
HWY_INLINE void FillBetween(const Round& round, RowBits row, PixelLight* pixels) {
  const hn::Full128<float> d;
  const auto fill = [&](RowBits columns, int left, int right, float from_left) HWY_ATTR {
    for (; columns != 0; columns &= columns - 1) {
      PixelLight* const here = pixels + std::countr_zero(columns);
      const auto beside = hn::Load(d, &here[right].red);
      const auto difference = hn::Sub(hn::Load(d, &here[-left].red), beside);
      hn::Store(hn::MulAdd(difference, hn::Set(d, from_left), beside), d, &here->red);
    }
  };
  const RowBits at_14 = round.step == 2 ? row & kColumn14 : 0;
  fill(row & ~at_14, round.step, round.step, 0.5f);
  fill(at_14, 2, 1, 1.0f / 3.0f);
}

// The right one of the two neighbours that a round's columns lie between.
HWY_INLINE RowBits NextToTheRight(const Round& round, RowBits neighbours) {
  if (round.step == 1) return neighbours >> 1;
  return (neighbours >> 2 & ~kColumn14) | (neighbours >> 1 & kColumn14);
}

// Fills in what a round need not shade, and leaves the rest in `rows`. is_alike(y): the columns of
// a row that may be filled in by how bright their neighbours are. Called row by row, downwards.
template <class Alike>
HWY_INLINE void FillRound(const Round& round, int side, int height, const TileSurfaces& surfaces,
                          ShadeScratch& scratch, const Alike& is_alike, TileBits& rows) {
  for (int y = 0; y < height; ++y) {
    RowBits alike = 0;
    for (const std::size_t k : surfaces.present()) {
      const RowBits of = surfaces.of[k][y];
      alike |= of & of << round.step & NextToTheRight(round, of);
    }
    const RowBits always = surfaces.always[y];
    alike &= is_alike(y) & ~(always << round.step | NextToTheRight(round, always));
    const RowBits wanted = surfaces.all[y] & round.columns[y % 2] & ~always;
    FillBetween(round, wanted & alike, scratch.pixels.data() + y * side);
    rows[y] = wanted & ~alike;
  }
}

// The second round: what a row would get is held against the rows around.
inline HWY_NOINLINE void FillSecondRound(int side, int height, const TileSurfaces& surfaces,
                                         ShadeScratch& scratch, TileBits& rows) {
  const D d;
  HWY_ALIGN std::array<float, 2 + 64 + kLanes> between;
  // The columns between those that are as bright as each other, 4 apart, or 12 and 15.
  const auto find_between = [&](const float* row) HWY_ATTR {
    RowBits alike = ~Differ(row, row + 4, side, kMostAlong) << 2 & ~kColumn14;
    for (int x = 0; x < side; x += static_cast<int>(kLanes))
      hn::StoreU((hn::LoadU(d, row + x) + hn::LoadU(d, row + x + 4)) * 0.5f, d,
                 between.data() + x + 2);
    for (int x = 0; x < side; x += kBlockSize) {
      const float by = row[x + 12] - row[x + 15];
      if (std::abs(by) <= kMostAlong) alike |= RowBits{1} << (x + 14);
      between[x + 14] = row[x + 15] + by * (1.0f / 3.0f);
    }
    return alike;
  };
  const auto unlike_across = [&](int y, int other) HWY_ATTR {
    RowBits alike = 0;
    for (const std::size_t k : surfaces.present())
      alike |= surfaces.of[k][y] & surfaces.of[k][other];
    return ~alike |
           Differ(between.data(), scratch.brightness.data() + other * side, side, kMostAcross);
  };
  const auto alike = [&](int y) HWY_ATTR {
    RowBits bits = find_between(scratch.brightness.data() + y * side);
    if (y % kBlockSize != 0) bits &= ~unlike_across(y, y - 1);
    if (y % kBlockSize != kBlockSize - 1 && y + 1 < height) bits &= ~unlike_across(y, y + 1);
    return bits;
  };
  FillRound(kSecond, side, height, surfaces, scratch, alike, rows);
}

// The columns around which neighbours differ too much for the third round: by the sum of their own
// difference and half of those of the columns two to the left and right. Those that are not among
// `columns` count as the column itself.
HWY_INLINE RowBits UnlikeAround(const float* row, RowBits columns, int side) {
  const D d;
  HWY_ALIGN std::array<float, 4 + 64 + kLanes> beside;          // of column x at 2 + x
  beside[0] = beside[1] = beside[2] = beside[3 + side] = 0.0f;  // of none
  for (int x = 0; x < side; x += static_cast<int>(kLanes))
    hn::StoreU(hn::AbsDiff(hn::LoadU(d, row + x), hn::LoadU(d, row + x + 2)), d,
               beside.data() + 3 + x);
  RowBits bits = 0;
  for (int x = 0; x < side; x += static_cast<int>(kLanes)) {
    const float* const at = beside.data() + x;
    const V own = hn::LoadU(d, at + 2);
    const V left = IfThenElse(LanesOf(columns << 2 >> x), hn::LoadU(d, at), own);
    const V right = IfThenElse(LanesOf(columns >> 2 >> x), hn::LoadU(d, at + 4), own);
    bits |= BitsOf(MulAdd(left + right, 0.5f, own) > kMostAround) << x;
  }
  return bits;
}

// The third round, between columns that are known in all rows.
inline HWY_NOINLINE void FillThirdRound(int side, int height, const TileSurfaces& surfaces,
                                        ShadeScratch& scratch, TileBits& rows) {
  // The columns whose neighbours show two materials, or differ.
  const auto unlike_beside = [&](int y) HWY_ATTR {
    if (y >= height) return RowBits{0};
    RowBits alike = 0;
    for (const std::size_t k : surfaces.present())
      alike |= surfaces.of[k][y] << 1 & surfaces.of[k][y] >> 1;
    const float* const row = scratch.brightness.data() + y * side;
    return ~alike | UnlikeAround(row, alike & kThird.columns[y % 2], side);
  };
  RowBits above = 0, here = 0, below = unlike_beside(0);
  const auto alike = [&](int y) HWY_ATTR {
    above = y % kBlockSize == 0 ? 0 : here;
    here = below;
    below = unlike_beside(y + 1);
    return ~(above | here | (y % kBlockSize == kBlockSize - 1 ? 0 : below));
  };
  FillRound(kThird, side, height, surfaces, scratch, alike, rows);
}

// Shades the surfaces' pixels by shade(lists, is_first) where they cannot be filled in, and returns
// how many.
template <class Shade>
std::size_t ShadeWhereNeeded(const Shading& s, const TilePixels& tile, const TileSurfaces& surfaces,
                             ShadeScratch& scratch, const Shade& shade) {
  const int height = tile.box.height_px;
  std::size_t shaded = 0;
  const auto shade_rows = [&](const TileBits& rows, bool is_first) HWY_ATTR {
    const PixelLists lists = ListRows(s, rows, height, surfaces, scratch);
    shaded += CountSurfaces(lists);
    shade(lists, is_first);
  };
  const int side = s.grid.tile_size_px;
  TileBits rows;
  for (int y = 0; y < height; ++y)
    rows[y] = surfaces.all[y] & (kFirstColumns[y % 2] | surfaces.always[y]);
  shade_rows(rows, true);
  FindBrightness(side, height, scratch);
  FillSecondRound(side, height, surfaces, scratch, rows);
  shade_rows(rows, false);
  FindBrightness(side, height, scratch);
  FillThirdRound(side, height, surfaces, scratch, rows);
  shade_rows(rows, false);
  WriteSurfaces(side, height, surfaces.all, scratch);
  return shaded;
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
