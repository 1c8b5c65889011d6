// What the ground looks like at a point: slopes and colour, on the terrain's map and around it.
#if defined(SWELL_RENDER_MATERIALS_GROUND_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_GROUND_INL_H_
#undef SWELL_RENDER_MATERIALS_GROUND_INL_H_
#else
#define SWELL_RENDER_MATERIALS_GROUND_INL_H_
#endif

#include "render/materials/terrain.h"
#include "render/tile/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

struct GroundLook {
  V slope_x, slope_y;
  V3 albedo;
};

// How far p is from the nearest side of a layer's square, inside, as part of the side.
HWY_INLINE V PartFromRim(const SlopeLayer& square, V3 p) {
  const LayerPlace place = PlaceIn(square, p.x, p.y);
  const float side_fx8 = 256.0f * static_cast<float>(square.map->size);
  const auto from_rim = [&](V x) HWY_ATTR { return hn::Min(x, hn::Sub(Constant(side_fx8), x)); };
  return hn::Mul(hn::Min(from_rim(place.x_fx8), from_rim(place.y_fx8)), Constant(1.0f / side_fx8));
}

// kBlended: between mip levels; else the nearest.
template <bool kBlended>
HWY_INLINE GroundLook SampleGround(const GroundLayer& layer, V3 p, V level_m) {
  const D d;
  const V zero = hn::Zero(d);
  GroundLook look{zero, zero, {zero, zero, zero}};
  if constexpr (kBlended) {
    V unused = zero;
    AddSlopes(layer.slopes, p, level_m, zero, zero, look.slope_x, look.slope_y, unused);
  } else {
    NearestSlopes(layer.slopes, p, level_m, look.slope_x, look.slope_y);
  }
  const V per_m = Constant(layer.albedo_texels_per_m);
  const V x = hn::MulAdd(p.x, per_m, Constant(layer.albedo_x_eye));
  const V y = hn::MulAdd(p.y, per_m, Constant(layer.albedo_y_eye));
  V r, g, b, alpha;
  texture::HWY_NAMESPACE::SampleRgba(d, *layer.albedo, x, y, r, g, b, alpha);
  look.albedo = {hn::Mul(r, r), hn::Mul(g, g), hn::Mul(b, b)};
  return look;
}

// The map's look, over its last texels that of its surroundings.
template <bool kBlended>
HWY_INLINE GroundLook FindGround(const Terrain& terrain, V3 p, V level_m) {
  const D d;
  constexpr float kInverseRim = 40.0f;  // 1 / part of the side
  const V on_map =
      Clamp(hn::Mul(PartFromRim(terrain.map.slopes, p), Constant(kInverseRim)), 0.0f, 1.0f);
  if (hn::AllTrue(d, hn::Ge(on_map, Constant(1.0f))))
    return SampleGround<kBlended>(terrain.map, p, level_m);
  const GroundLook around = SampleGround<kBlended>(terrain.around, p, level_m);
  if (hn::AllFalse(d, hn::Gt(on_map, hn::Zero(d)))) return around;
  const GroundLook map = SampleGround<kBlended>(terrain.map, p, level_m);
  // Whole weights keep the bits of packets that are all on the map or all around it.
  const V left = hn::Sub(Constant(1.0f), on_map);
  const auto blend = [&](V inner, V outer)
                         HWY_ATTR { return hn::MulAdd(inner, on_map, hn::Mul(outer, left)); };
  return {blend(map.slope_x, around.slope_x),
          blend(map.slope_y, around.slope_y),
          {blend(map.albedo.x, around.albedo.x), blend(map.albedo.y, around.albedo.y),
           blend(map.albedo.z, around.albedo.z)}};
}

// 1 over the map, falling to 0 where its apron ends, beyond which there is deep water.
HWY_INLINE V FloorShown(const Terrain& terrain, V3 p) {
  const SlopeLayer& square = terrain.around.slopes;
  const LayerPlace place = PlaceIn(square, p.x, p.y);
  // Aprons away from the map, which is half as wide as the square.
  const float per_apron = 4.0f / (256.0f * static_cast<float>(square.map->size));
  const auto outside = [&](V x_fx8) HWY_ATTR {
    const V from_middle = hn::Abs(hn::MulAdd(x_fx8, Constant(per_apron), Constant(-2.0f)));
    return hn::Max(hn::Sub(from_middle, Constant(1.0f)), hn::Zero(D()));
  };
  const V x = outside(place.x_fx8), y = outside(place.y_fx8);
  const V away2 = hn::MulAdd(x, x, hn::Mul(y, y));
  return SmoothBlend(hn::MulAdd(away2, Constant(-2.0f), Constant(2.0f)));
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
