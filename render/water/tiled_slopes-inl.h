// Slopes and foam of the sea's longest patch, which covers it by tiles
// (ocean/open_sea/patch_tiles.h).
#if defined(SWELL_RENDER_WATER_TILED_SLOPES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_WATER_TILED_SLOPES_INL_H_
#undef SWELL_RENDER_WATER_TILED_SLOPES_INL_H_
#else
#define SWELL_RENDER_WATER_TILED_SLOPES_INL_H_
#endif

#include <bit>

#include "ocean/open_sea/patch_tiles-inl.h"
#include "render/packets/packet-inl.h"
#include "render/water/foam_map-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {
namespace tiles = swell::ocean::HWY_NAMESPACE;

// A place in a layer's map, in whole 1/256 texels of level 0, and the levels to blend.
struct MapPlace {
  VI x_fx8, y_fx8;
  MapLevel level;
};

// Which period of the map a place in it, in 1/256 texels, lies in, and where.
HWY_INLINE tiles::SquarePlace<D> SquareOf(const SlopeLayer& layer, VI x_fx8, VI y_fx8) {
  const D d;
  const DI di;
  const int map_fx8 = 256 * layer.map->size;
  const int bits = std::countr_zero(static_cast<unsigned>(map_fx8));
  const VI in_map = hn::Set(di, map_fx8 - 1);
  const V unit = Constant(1.0f / static_cast<float>(map_fx8));
  const auto period = [&](VI fx8, int at_eye)
                          HWY_ATTR { return hn::ShiftRightSame(fx8, bits) + at_eye; };
  const auto inside = [&](VI fx8) HWY_ATTR { return hn::ConvertTo(d, fx8 & in_map) * unit; };
  return {period(x_fx8, layer.eye_column), period(y_fx8, layer.eye_row), inside(x_fx8),
          inside(y_fx8)};
}

// What the sea's longest patch shows: slopes, and the foam of its waves.
struct PatchSample {
  V slope_x, slope_y, foam;
};

// The patch and its foam at a packet; without foam the map of that is null.
struct PatchPlace {
  MapPlace slopes;
  const FoamMap* foam;
  VI foam_x_fx8, foam_y_fx8, foam_level;
};

HWY_INLINE PatchPlace PlaceInPatch(const SlopeLayer& layer, const MapLevel& level,
                                   const FoamMap* foam, V3 p, V level_m) {
  const VI zero = hn::Zero(DI());
  const LayerPlace place = PlaceIn(layer, p.x, p.y);
  PatchPlace at = {
      {RoundToInt(place.x_fx8), RoundToInt(place.y_fx8), level}, foam, zero, zero, zero};
  if (foam) {
    const LayerPlace foam_place = PlaceIn(*foam, p.x, p.y);
    at.foam_x_fx8 = RoundToInt(foam_place.x_fx8);
    at.foam_y_fx8 = RoundToInt(foam_place.y_fx8);
    at.foam_level = NearestFoamLevel(*foam, level_m);
  }
  return at;
}

// A sample of a tile that reads the patch at an offset.
HWY_INLINE PatchSample SampleTile(const SlopeLayer& layer, const PatchPlace& at,
                                  const tiles::TileOffset<VI>& by) {
  const D d;
  const DI di;
  PatchSample s = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  texture::HWY_NAMESPACE::AddBlended(
      d, *layer.map,
      {at.slopes.x_fx8 + hn::ShiftLeft<8>(by.x), at.slopes.y_fx8 + hn::ShiftLeft<8>(by.y),
       at.slopes.level.base, at.slopes.level.t},
      layer.gain, s.slope_x, s.slope_y);
  if (at.foam) {
    const VI per_sample = hn::Set(di, at.foam->fx8_per_sample);
    s.foam = FoamAt(*at.foam, by.x * per_sample + at.foam_x_fx8, by.y * per_sample + at.foam_y_fx8,
                    at.foam_level);
  }
  return s;
}

// The blend of tiles for a packet of which some lanes lie near a tile's border; `own` is what is in
// the tiles that the lanes lie in. In the mean foam is what it is without, since the squares of the
// weights add up to 1. Not inlined: one packet in four comes here.
static HWY_NOINLINE PatchSample BlendTiles(const SlopeLayer& layer, const PatchPlace& at,
                                           const tiles::SquarePlace<D>& square,
                                           const PatchSample& own) {
  const D d;
  PatchSample sum = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  bool is_own = true;
  tiles::ForEachTile(d, layer.tiling, layer.map->size, square,
                     [&](tiles::TileOffset<VI> by, const tiles::TileWeight<V>& tile) HWY_ATTR {
                       const PatchSample found = is_own ? own : SampleTile(layer, at, by);
                       is_own = false;
                       sum.slope_x = MulAdd(tile.weight, found.slope_x, sum.slope_x);
                       sum.slope_y = MulAdd(tile.weight, found.slope_y, sum.slope_y);
                       sum.foam = MulAdd(tile.weight * tile.weight, found.foam, sum.foam);
                     });
  return sum;
}

// Adds the slopes of the sea's longest patch at p, as AddSlopes(), and says how much of its foam
// (null: none) is there.
HWY_INLINE V AddLongestPatch(const SlopeLayer& layer, const FoamMap* foam, V3 p, V level_m,
                             V& slope_x, V& slope_y, V& variance) {
  const D d;
  const DI di;
  const MapLevel level = LevelIn(layer, level_m, variance);
  const V foam_lost = foam ? FoamLost(*foam, level_m) : Constant(1.0f);
  const bool some_foam = !hn::AllTrue(d, foam_lost >= 1.0f);
  PatchSample found = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  if (!level.all_lost || some_foam) {
    const PatchPlace at = PlaceInPatch(layer, level, some_foam ? foam : nullptr, p, level_m);
    tiles::SquarePlace<D> square;
    tiles::RowPlace<D> in_row;
    tiles::TileOffset<VI> by = {hn::Zero(di), hn::Zero(di)};
    if (layer.tiling.on) {
      square = SquareOf(layer, at.slopes.x_fx8, at.slopes.y_fx8);
      in_row = tiles::PlaceInRow(d, square, square.row);
      by = tiles::OffsetOfTile(di, layer.tiling.seed, in_row.column, square.row, layer.map->size);
    }
    found = SampleTile(layer, at, by);
    if (layer.tiling.on && !tiles::AllInOneTile(d, in_row, square.y))
      found = BlendTiles(layer, at, square, found);
    slope_x = slope_x + found.slope_x;
    slope_y = slope_y + found.slope_y;
  }
  return foam ? BlendFoam(*foam, found.foam, foam_lost) : found.foam;
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
