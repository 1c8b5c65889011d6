// Slopes of the sea's patches, which cover it by tiles (ocean/patch_tiles.h).
#if defined(SWELL_RENDER_MATERIALS_TILED_SLOPES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_TILED_SLOPES_INL_H_
#undef SWELL_RENDER_MATERIALS_TILED_SLOPES_INL_H_
#else
#define SWELL_RENDER_MATERIALS_TILED_SLOPES_INL_H_
#endif

#include <bit>

#include "ocean/patch_tiles-inl.h"
#include "render/tile/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {
namespace tiles = swell::ocean::HWY_NAMESPACE;

// A place in a layer's map, in whole 1/256 texels of level 0, and the levels to blend.
struct MapPlace {
  VI x_fx8, y_fx8;
  MapLevel level;
};

struct MapSlopes {
  V x, y;
};

// Which period of the map a place in it, in 1/256 texels, lies in, and where.
HWY_INLINE tiles::SquarePlace<D> SquareOf(const SlopeLayer& layer, VI x_fx8, VI y_fx8) {
  const D d;
  const DI di;
  const int map_fx8 = 256 * layer.map->size;
  const int bits = std::countr_zero(static_cast<unsigned>(map_fx8));
  const VI in_map = hn::Set(di, map_fx8 - 1);
  const V unit = Constant(1.0f / static_cast<float>(map_fx8));
  const auto period = [&](VI fx8, int at_eye) HWY_ATTR {
    return hn::Add(hn::ShiftRightSame(fx8, bits), hn::Set(di, at_eye));
  };
  const auto inside = [&](VI fx8) HWY_ATTR {
    return hn::Mul(hn::ConvertTo(d, hn::And(fx8, in_map)), unit);
  };
  return {period(x_fx8, layer.eye_column), period(y_fx8, layer.eye_row), inside(x_fx8),
          inside(y_fx8)};
}

HWY_INLINE VI MovedBySamples(VI fx8, VI samples) { return hn::Add(fx8, hn::ShiftLeft<8>(samples)); }

// The blend of tiles for a packet of which some lanes lie near a tile's border; `own` are the
// slopes in the tiles that the lanes lie in. Not inlined: one packet in four comes here.
static HWY_NOINLINE MapSlopes BlendTiles(const SlopeLayer& layer, const MapPlace& at,
                                         const tiles::SquarePlace<D>& place, MapSlopes own) {
  const D d;
  MapSlopes sum = {hn::Zero(d), hn::Zero(d)};
  bool is_own = true;
  tiles::ForEachTile(d, layer.tiling, layer.map->size, place,
                     [&](tiles::TileOffset<VI> by, const tiles::TileWeight<V>& tile) HWY_ATTR {
                       MapSlopes found = own;
                       if (!is_own) {
                         found = {hn::Zero(d), hn::Zero(d)};
                         texture::HWY_NAMESPACE::AddBlended(
                             d, *layer.map, MovedBySamples(at.x_fx8, by.x),
                             MovedBySamples(at.y_fx8, by.y), at.level.base, at.level.t, layer.gain,
                             found.x, found.y);
                       }
                       is_own = false;
                       sum.x = hn::MulAdd(tile.weight, found.x, sum.x);
                       sum.y = hn::MulAdd(tile.weight, found.y, sum.y);
                     });
  return sum;
}

// AddSlopes() of a layer that may be tiled.
HWY_INLINE void AddTiledSlopes(const SlopeLayer& layer, V3 p, V level_m, V du, V dv, V& slope_x,
                               V& slope_y, V& variance) {
  const D d;
  const MapLevel level = LevelIn(layer, level_m, variance);
  if (level.all_lost) return;
  const LayerPlace place = PlaceBent(layer, p, du, dv);
  const MapPlace at = {RoundToInt(place.x_fx8), RoundToInt(place.y_fx8), level};

  // The tile that each lane lies in; without tiles the map as it is, once for both in the code.
  VI x_fx8 = at.x_fx8, y_fx8 = at.y_fx8;
  tiles::SquarePlace<D> square;
  tiles::RowPlace<D> in_row;
  MapSlopes found = {slope_x, slope_y};
  if (layer.tiling.on) {
    square = SquareOf(layer, at.x_fx8, at.y_fx8);
    in_row = tiles::PlaceInRow(d, square, square.row);
    const auto by =
        tiles::OffsetOfTile(DI(), layer.tiling.seed, in_row.column, square.row, layer.map->size);
    x_fx8 = MovedBySamples(x_fx8, by.x);
    y_fx8 = MovedBySamples(y_fx8, by.y);
    found = {hn::Zero(d), hn::Zero(d)};
  }
  texture::HWY_NAMESPACE::AddBlended(d, *layer.map, x_fx8, y_fx8, level.base, level.t, layer.gain,
                                     found.x, found.y);
  if (layer.tiling.on) {
    if (!tiles::AllInOneTile(d, in_row, square.y)) found = BlendTiles(layer, at, square, found);
    found = {hn::Add(slope_x, found.x), hn::Add(slope_y, found.y)};
  }
  slope_x = found.x;
  slope_y = found.y;
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
