// Maps of one channel over a square of the land.
#if defined(SWELL_RENDER_PACKETS_SQUARE_MAP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_PACKETS_SQUARE_MAP_INL_H_
#undef SWELL_RENDER_PACKETS_SQUARE_MAP_INL_H_
#else
#define SWELL_RENDER_PACKETS_SQUARE_MAP_INL_H_
#endif

#include "render/packets/packet-inl.h"
#include "render/packets/square_map.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// What the map holds at p, in [0, 1]; `outside` beyond its square and where there is no map.
// level_m: log2 of what a pixel shows of the ground.
HWY_INLINE V SampleSquare(const SquareMap& square, const V3& p, V level_m, V outside) {
  const D d;
  if (!square.map) return outside;
  const V zero = hn::Zero(d), half = Constant(0.5f);
  const LayerPlace place = PlaceIn(square, p.x, p.y);
  const V side = Constant(256.0f * static_cast<float>(square.map->size - 1));
  const auto inside = ((place.x_fx8 >= zero) & (place.y_fx8 >= zero)) &
                      ((place.x_fx8 < side) & (place.y_fx8 < side));
  if (hn::AllFalse(d, inside)) return outside;
  const float coarsest = static_cast<float>(square.map->levels - 1);
  const V level = Clamp(level_m + (square.log2_texels_per_m + 0.5f), 0.0f, coarsest);
  const V code = texture::HWY_NAMESPACE::SampleLevel(
      d, *square.map, RoundToInt(IfThenElseZero(inside, place.x_fx8)),
      RoundToInt(IfThenElseZero(inside, place.y_fx8)), TruncateToInt(level));
  return IfThenElse(inside, MulAdd(code, half, half), outside);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
