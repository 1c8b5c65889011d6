// The land and the sea floor.
#if defined(SWELL_RENDER_MATERIALS_TERRAIN_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_TERRAIN_INL_H_
#undef SWELL_RENDER_MATERIALS_TERRAIN_INL_H_
#else
#define SWELL_RENDER_MATERIALS_TERRAIN_INL_H_
#endif

#include "render/materials/foam-inl.h"
#include "render/materials/fresnel-inl.h"
#include "render/materials/terrain.h"
#include "render/materials/water-inl.h"
#include "render/tile/surfel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

HWY_INLINE V GroundLevel(const ViewRays& rays, const Packet& packet) {
  return FootprintLevel(FootprintAcross(rays, packet), Clamp(hn::Abs(packet.to_eye.z), 0.3f, 1.0f));
}

// Ground, diffuse and lit by sun and sky.
struct Ground {
  V3 light, normal;
};
template <bool kDetail>
HWY_INLINE Ground LightGround(const Terrain& terrain, const Light& light, const Packet& packet,
                              V level_m) {
  const D d;
  const V zero = hn::Zero(d);
  V slope_x = zero, slope_y = zero, variance = zero;
  if constexpr (kDetail) {
    AddSlopes(terrain.slopes, packet.p, level_m, zero, zero, slope_x, slope_y, variance);
    AddSlopes(terrain.detail, packet.p, level_m, zero, zero, slope_x, slope_y, variance);
  } else {
    NearestSlopes(terrain.slopes, packet.p, level_m, slope_x, slope_y);
  }
  const V inv_length =
      InverseSqrt(hn::MulAdd(slope_x, slope_x, hn::MulAdd(slope_y, slope_y, Constant(1.0f))));
  const V3 normal = {hn::Neg(hn::Mul(slope_x, inv_length)), hn::Neg(hn::Mul(slope_y, inv_length)),
                     inv_length};

  const V cos_sun = hn::Max(Dot(normal, Constant(light.sun_direction)), zero);
  const V sky_seen = hn::MulAdd(normal.z, Constant(0.5f), Constant(0.5f));
  const V3 arriving =
      ScaleAdd(Constant(light.sun_irradiance), hn::Mul(cos_sun, Constant(0.318309886f)),
               Scale(Constant(light.ambient), sky_seen));
  const V x =
      hn::MulAdd(packet.p.x, Constant(terrain.albedo_texels_per_m), Constant(terrain.albedo_x_eye));
  const V y =
      hn::MulAdd(packet.p.y, Constant(terrain.albedo_texels_per_m), Constant(terrain.albedo_y_eye));
  V r, g, b, alpha;
  texture::HWY_NAMESPACE::SampleRgba(d, *terrain.albedo, x, y, r, g, b, alpha);
  return {Product(arriving, {hn::Mul(r, r), hn::Mul(g, g), hn::Mul(b, b)}), normal};
}

// Where the sea's edge is now, as a height on the beach from 0 to reach_m: it stays low
// longer than high, and is not everywhere alike at one time.
struct SwashEdge {
  V edge_m;
  V retreat;  // 0 while it comes, up to 1 as it goes
};

HWY_INLINE SwashEdge FindSwashEdge(const Swash& swash, V3 p) {
  const D d;
  V along_a, along_b, sine, cosine, unused;
  SinCosTurns(d,
              hn::MulAdd(p.x, Constant(swash.lag_a.x),
                         hn::MulAdd(p.y, Constant(swash.lag_a.y), Constant(swash.lag_a.z))),
              along_a, unused);
  SinCosTurns(d,
              hn::MulAdd(p.x, Constant(swash.lag_b.x),
                         hn::MulAdd(p.y, Constant(swash.lag_b.y), Constant(swash.lag_b.z))),
              along_b, unused);
  const V lag = hn::Mul(hn::Add(along_a, along_b), Constant(0.3f));
  const V turns = hn::Sub(Constant(swash.cycles), lag);
  SinCosTurns(d, turns, sine, cosine);
  // sin(phi - 0.35 cos phi) is high for a shorter time than low.
  const V leaning = hn::MulAdd(cosine, Constant(-0.056f), turns);
  SinCosTurns(d, leaning, sine, cosine);
  const V half = Constant(0.5f);
  const V reach = hn::MulAdd(along_b, Constant(0.15f), Constant(0.85f));
  const V edge = hn::Mul(hn::MulAdd(sine, half, half), hn::Mul(reach, Constant(swash.reach_m)));
  return {edge, hn::MulAdd(cosine, hn::Neg(half), half)};
}

// The sea's waves where they run out over the sand: `kept` of them is left, in [0, 1].
HWY_INLINE WaterSlopes SampleRunOut(const Shading& s, const Packet& packet, V kept) {
  const V zero = hn::Zero(D());
  const Water& water = s.material<Water>();
  const V flat = Constant(water.base_variance);
  if (hn::AllFalse(D(), hn::Gt(kept, zero))) return {zero, zero, flat, zero, flat};
  const WaterSlopes sea =
      SampleWater<true>(water, s.rays, std::array{packet}, std::make_index_sequence<1>())[0];
  return {hn::Mul(sea.slope_x, kept), hn::Mul(sea.slope_y, kept), Lerp(flat, sea.variance, kept),
          hn::Mul(sea.foam_cover, kept), Lerp(flat, sea.fine_variance, kept)};
}

// Foam of a sheet whose rim is `below` [m of height] above: a bright rim, then lace that thins out.
// None where the sea begins, which brings its own.
HWY_INLINE V SheetFoam(float reach_m, const SwashEdge& swash, V below, V calm) {
  const V from_rim = hn::Mul(below, Constant(1.0f / reach_m));
  const V rim = Clamp(hn::NegMulAdd(from_rim, Constant(9.0f), Constant(1.0f)), 0.0f, 1.0f);
  const V lace = Clamp(hn::NegMulAdd(from_rim, Constant(0.9f), Constant(0.6f)), 0.0f, 1.0f);
  const V fresh = hn::NegMulAdd(swash.retreat, Constant(0.6f), Constant(1.0f));
  const V begun = hn::Min(hn::Mul(calm, Constant(2.0f)), Constant(1.0f));
  const V foam = hn::Mul(hn::Max(rim, lace), hn::Mul(fresh, begun));
  return hn::IfThenElseZero(hn::Gt(below, hn::Zero(D())), foam);
}

// Wet sand mirrors the sky; a sheet of water with foam at its rim runs over it, and at the sea's
// level both are what the sea is where it has no depth. `ground` is the ground's light at p, whose
// height is height_m.
HWY_INLINE V3 AddSwash(const Shading& s, const Terrain& terrain, const Packet& packet, V level_m,
                       V height_m, V3 ground) {
  const D d;
  const float reach_m = terrain.swash.reach_m;
  const auto reached = hn::Lt(height_m, Constant(1.6f * reach_m));
  if (reach_m <= 0.0f || hn::AllFalse(d, reached)) return ground;
  const SwashEdge swash = FindSwashEdge(terrain.swash, packet.p);
  // Sand stays wet for a while up to where the sheets come.
  const V dry = Clamp(hn::Mul(height_m, Constant(1.0f / (1.6f * reach_m))), 0.0f, 1.0f);
  const V wet = hn::NegMulAdd(hn::Mul(dry, dry), dry, Constant(1.0f));
  const V calm = Clamp(hn::Mul(height_m, Constant(4.0f / reach_m)), 0.0f, 1.0f);
  const V below = hn::Sub(swash.edge_m, height_m);  // of the sheet's rim [m of height]
  const V sheet = Clamp(hn::Mul(below, Constant(40.0f)), 0.0f, 1.0f);
  // The sea thins out over a little of the sand, also where no sheet comes in.
  const V film =
      hn::Max(sheet, Clamp(hn::NegMulAdd(calm, Constant(1.5f), Constant(1.0f)), 0.0f, 1.0f));

  const WaterSlopes waves = SampleRunOut(s, packet, hn::NegMulAdd(calm, film, film));
  const Facing f = FaceEye(s.media, s.material<Water>(), packet, waves);
  V inv_variance, unused;
  const V glint =
      SunGlint(s.light.sun_direction, packet, waves, f.reflectance, f.cos_rough, inv_variance);
  const V3 mirrored =
      ReflectedLight(s.light, s.material<Water>(), packet, waves, f, inv_variance, false, unused);
  const V half = Constant(0.5f);
  const V shine = hn::Mul(f.reflectance, hn::MulAdd(film, half, hn::Mul(wet, half)));
  const V bare = hn::NegMulAdd(wet, film, wet);
  const V darkened = hn::NegMulAdd(bare, Constant(0.15f), Constant(1.0f));
  V3 light = Lerp(Scale(ground, darkened), mirrored, shine);
  light = ScaleAdd(Constant(s.light.sun_irradiance), hn::Mul(glint, film), light);
  const V foam = SheetFoam(reach_m, swash, below, calm);
  const V cover = FoamCover(terrain.foam, packet.p, level_m, foam);
  light = AddFoam(terrain.foam, hn::Max(cover, waves.foam_cover), light);
  return {hn::IfThenElse(reached, light.x, ground.x), hn::IfThenElse(reached, light.y, ground.y),
          hn::IfThenElse(reached, light.z, ground.z)};
}

// 1 over the land's square, falling to 0 at its rim, beyond which there is deep water.
HWY_INLINE V InsideLand(const Terrain& terrain, V3 p) {
  constexpr float kRim = 1.0f / 30.0f;  // of the side
  const SlopeLayer& square = terrain.slopes;
  const LayerPlace place = PlaceIn(square, p.x, p.y);
  const float side_fx8 = 256.0f * static_cast<float>(square.map->size);
  const auto from_rim = [&](V x) HWY_ATTR { return hn::Min(x, hn::Sub(Constant(side_fx8), x)); };
  const V nearest = hn::Min(from_rim(place.x_fx8), from_rim(place.y_fx8));
  return Clamp(hn::Mul(nearest, Constant(1.0f / (kRim * side_fx8))), 0.0f, 1.0f);
}

// Ground as the eye sees it, with the sea's last sheets on it; without detail for what is seen
// through or in water.
template <ViewKind kView>
struct Shader<Terrain, kView> {
  const Terrain& terrain;

  HWY_INLINE auto operator()(const Shading& s, const TilePixels&, const Lanes&,
                             const Packet& packet) const {
    const V level_m = GroundLevel(s.rays, packet);
    constexpr bool kDetail = kView == ViewKind::kWindow;
    const Ground ground = LightGround<kDetail>(terrain, s.light, packet, level_m);
    if constexpr (kView == ViewKind::kWindow) {
      const V height_m = hn::Add(packet.p.z, Constant(s.rays.eye_z));
      return Surfel{AddSwash(s, terrain, packet, level_m, height_m, ground.light), ground.normal};
    } else if constexpr (kView == ViewKind::kRefraction) {
      return FadingSurfel{{ground.light, ground.normal}, InsideLand(terrain, packet.p)};
    } else {
      return Surfel{ground.light, ground.normal};
    }
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
