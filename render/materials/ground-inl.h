// What the ground looks like at a point: slopes and colour, on the terrain's map and around it.
#if defined(SWELL_RENDER_MATERIALS_GROUND_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_GROUND_INL_H_
#undef SWELL_RENDER_MATERIALS_GROUND_INL_H_
#else
#define SWELL_RENDER_MATERIALS_GROUND_INL_H_
#endif

#include "render/materials/terrain.h"
#include "render/packets/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// How far p is from the nearest side of the terrain's square, inside, as part of the side.
HWY_INLINE V PartFromRim(const GroundAlbedo& ground, V3 p) {
  const LayerPlace place = PlaceIn(ground, p.x, p.y);
  const float side_fx8 = ground.side_fx8;
  const auto from_rim = [&](V x) HWY_ATTR { return Min(x, side_fx8 - x); };
  return Min(from_rim(place.x_fx8), from_rim(place.y_fx8)) * (1.0f / side_fx8);
}

// 1 on the map, falling to 0 over its last texels.
HWY_INLINE V OnMap(const GroundAlbedo& ground, V3 p) {
  constexpr float kInverseRim = 40.0f;  // 1 / part of the side
  return Clamp(PartFromRim(ground, p) * kInverseRim, 0.0f, 1.0f);
}

// What map() says, over the map's last texels that of its surroundings. join(map, around, blend)
// joins the two by blend(inner, outer).
template <class Map, class Around, class Join>
HWY_INLINE auto BlendOnMap(V on_map, const Map& map, const Around& around, const Join& join) {
  const D d;
  if (hn::AllTrue(d, on_map >= 1.0f)) return map();
  if (hn::AllFalse(d, on_map > 0.0f)) return around();
  // Whole weights keep the bits of packets that are all on the map or all around it.
  const V left = 1.0f - on_map;
  return join(map(), around(),
              [&](V inner, V outer) HWY_ATTR { return MulAdd(inner, on_map, outer * left); });
}

struct GroundSlopes {
  V x, y;
};

// kBlended: between mip levels; else the nearest.
template <bool kBlended>
HWY_INLINE GroundSlopes FindSlopes(const Terrain& terrain, V on_map, V3 p, V level_m) {
  const auto sample = [&](const SlopeLayer& layer) HWY_ATTR {
    const V zero = hn::Zero(D());
    GroundSlopes slopes{zero, zero};
    V unused = zero;
    if constexpr (kBlended) {
      AddSlopes(layer, p, level_m, {zero, zero}, slopes.x, slopes.y, unused);
    } else {
      NearestSlopes(layer, p, level_m, slopes.x, slopes.y);
    }
    return slopes;
  };
  return BlendOnMap(
      on_map, [&]() HWY_ATTR { return sample(terrain.slopes); },
      [&]() HWY_ATTR { return sample(terrain.slopes_around); },
      [&](const GroundSlopes& map, const GroundSlopes& around, auto blend) HWY_ATTR {
        return GroundSlopes{blend(map.x, around.x), blend(map.y, around.y)};
      });
}

HWY_INLINE V3 FindAlbedo(const GroundAlbedo& ground, V on_map, V3 p) {
  const auto sample = [&](const AlbedoLayer& layer) HWY_ATTR {
    const V per_m = Constant(layer.texels_per_m);
    const V x = MulAdd(p.x, per_m, layer.x_eye);
    const V y = MulAdd(p.y, per_m, layer.y_eye);
    const auto root = texture::HWY_NAMESPACE::SampleRgba(D(), *layer.texels, x, y);
    return V3{root.r * root.r, root.g * root.g, root.b * root.b};
  };
  return BlendOnMap(
      on_map, [&]() HWY_ATTR { return sample(ground.map); },
      [&]() HWY_ATTR { return sample(ground.around); },
      [&](V3 map, V3 around, auto blend) HWY_ATTR {
        return V3{blend(map.x, around.x), blend(map.y, around.y), blend(map.z, around.z)};
      });
}

// 1 over the map, falling to 0 where its apron ends, beyond which there is deep water.
HWY_INLINE V FloorShown(const Terrain& terrain, V3 p) {
  const SlopeLayer& square = terrain.slopes_around;
  const LayerPlace place = PlaceIn(square, p.x, p.y);
  // Aprons away from the map, which is half as wide as the square.
  const float per_apron = 4.0f / (256.0f * static_cast<float>(square.map->size));
  const auto outside = [&](V x_fx8) HWY_ATTR {
    const V from_middle = Abs(MulAdd(x_fx8, per_apron, -2.0f));
    return Max(from_middle - 1.0f, 0.0f);
  };
  const V x = outside(place.x_fx8), y = outside(place.y_fx8);
  const V away2 = MulAdd(x, x, y * y);
  return SmoothBlend(MulAdd(away2, -2.0f, 2.0f));
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
