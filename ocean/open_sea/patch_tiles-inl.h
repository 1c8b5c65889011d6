// The tiles of ocean/open_sea/patch_tiles.h on Highway vectors: which tiles a packet of places
// reads, where in the patch, and with which weights. The same bits on every target.
#if defined(SWELL_OCEAN_PATCH_TILES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_OCEAN_PATCH_TILES_INL_H_
#undef SWELL_OCEAN_PATCH_TILES_INL_H_
#else
#define SWELL_OCEAN_PATCH_TILES_INL_H_
#endif

#include <hwy/highway.h>

#include "math/lanes-inl.h"
#include "ocean/open_sea/patch_tiles.h"

HWY_BEFORE_NAMESPACE();
namespace swell::ocean {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

// A place in the periodic plane: which square of a period's size it lies in, and where in it, x and
// y in [0, 1].
template <class D>
struct SquarePlace {
  hn::Vec<hn::RebindToSigned<D>> column, row;
  hn::Vec<D> x, y;
};

// Its place among the tiles of a row: odd rows are moved by half a tile.
template <class D>
struct RowPlace {
  hn::Vec<hn::RebindToSigned<D>> column;
  hn::Vec<D> x;
};

template <class D>
HWY_INLINE RowPlace<D> PlaceInRow(D d, const SquarePlace<D>& place,
                                  hn::Vec<hn::RebindToSigned<D>> row) {
  const hn::RebindToSigned<D> di;
  const auto one = hn::Set(d, 1.0f);
  const auto is_odd = hn::RebindMask(d, hn::TestBit(row, hn::Set(di, 1)));
  const auto moved = place.x + IfThenElseZero(is_odd, hn::Set(d, 0.5f));
  const auto is_next = moved >= one;
  return {place.column - hn::VecFromMask(di, hn::RebindMask(di, is_next)),
          moved - IfThenElseZero(is_next, one)};
}

// Whether no lane is where tiles are blended; `in_row` is its place in the row that it lies in.
template <class D>
HWY_INLINE bool AllInOneTile(D d, const RowPlace<D>& in_row, hn::Vec<D> y) {
  const auto half = hn::Set(d, 0.5f);
  const auto from_middle = Max(Abs(in_row.x - half), Abs(y - half));
  return hn::AllTrue(d, from_middle <= 0.5f * (1.0f - kTileBorder));
}

// How many whole samples on a tile reads the patch, a power of two along each side.
template <class VI>
struct TileOffset {
  VI x, y;
};

// Source: Wellons, Hash Function Prospector, 2018 (lowbias32).
template <class DI, class VI = hn::Vec<DI>>
HWY_INLINE TileOffset<VI> OffsetOfTile(DI di, std::uint32_t seed, VI column, VI row, int samples) {
  const hn::RebindToUnsigned<DI> du;
  const VI key = hn::ShiftLeft<16>(row) | (column & 0xffff);
  auto bits = hn::Xor(hn::BitCast(du, key), hn::Set(du, seed));
  bits = hn::Xor(bits, hn::ShiftRight<16>(bits)) * 0x7feb352du;
  bits = hn::Xor(bits, hn::ShiftRight<15>(bits)) * 0x846ca68bu;
  bits = hn::Xor(bits, hn::ShiftRight<16>(bits));
  const VI mask = hn::Set(di, samples - 1);
  return {hn::BitCast(di, bits) & mask, hn::BitCast(di, hn::ShiftRight<16>(bits)) & mask};
}

// cos(pi s / 2) for s in [0, 1] within 0.002, exact at both ends, and its slope.
template <Vector V>
HWY_INLINE V QuarterCosine(V s) {
  const V s2 = s * s;
  const V sum = MulAdd(s2, 0.22265625f, -1.22265625f);
  return MulAdd(sum, s2, 1.0f);
}

template <Vector V>
HWY_INLINE V QuarterCosineSlope(V s) {
  return s * MulAdd(s * s, 0.890625f, -2.4453125f);
}

// Across one axis: the weights of the tile that a place lies in and of the one behind the nearer
// border, their slopes [1 / tiles], and which tile that is. The squares of the weights add up to 1.
template <class D>
struct AxisBlend {
  hn::Vec<D> weight[2], slope[2];
  hn::Vec<hn::RebindToSigned<D>> tile[2];
};

template <class D, class V = hn::Vec<D>, class VI = hn::Vec<hn::RebindToSigned<D>>>
HWY_INLINE AxisBlend<D> BlendAlong(D d, VI tile, V place) {
  const hn::RebindToSigned<D> di;
  const V one = hn::Set(d, 1.0f), half = hn::Set(d, 0.5f);
  const auto is_low = place < half;
  const V to_border = IfThenElse(is_low, place, one - place);
  // The other's share: from 1/2 on the border to 0 where the blend ends, as smooth_blend() falls.
  const V t = Max(NegMulAdd(to_border, 1.0f / kTileBorder, half), 0.0f);
  const V share = t * t * NegMulAdd(t, 2.0f, 3.0f);
  const V rest = one - share;
  const V rise = t * (one - t) * (6.0f / kTileBorder);
  const V turn = IfThenElse(is_low, -rise, rise);
  const VI step = IfThenElse(hn::RebindMask(di, is_low), hn::Set(di, -1), hn::Set(di, 1));
  return {{QuarterCosine(share), QuarterCosine(rest)},
          {QuarterCosineSlope(share) * turn, -(QuarterCosineSlope(rest) * turn)},
          {tile, tile + step}};
}

// What a tile counts at a packet of places, and the slopes of that [1 / tiles].
template <class V>
struct TileWeight {
  V weight, slope_x, slope_y;
};

// Calls read(offset, weight) for the tiles that have a weight in any lane: the tile that each lane
// lies in first, four tiles at most.
template <class D, class Read>
HWY_INLINE void ForEachTile(D d, const PatchTiling& tiling, int samples,
                            const SquarePlace<D>& place, const Read& read) {
  using V = hn::Vec<D>;
  const hn::RebindToSigned<D> di;
  const V zero = hn::Zero(d);
  const AxisBlend<D> rows = BlendAlong(d, place.row, place.y);
  for (int r = 0; r < 2; ++r) {
    if (hn::AllTrue(d, rows.weight[r] == zero)) continue;
    const RowPlace<D> in_row = PlaceInRow(d, place, rows.tile[r]);
    const AxisBlend<D> columns = BlendAlong(d, in_row.column, in_row.x);
    for (int c = 0; c < 2; ++c) {
      if (hn::AllTrue(d, columns.weight[c] == zero)) continue;
      read(OffsetOfTile(di, tiling.seed, columns.tile[c], rows.tile[r], samples),
           TileWeight<V>{rows.weight[r] * columns.weight[c], rows.weight[r] * columns.slope[c],
                         rows.slope[r] * columns.weight[c]});
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::ocean
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
