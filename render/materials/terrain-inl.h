// The land and the sea floor.
#if defined(SWELL_RENDER_MATERIALS_TERRAIN_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_TERRAIN_INL_H_
#undef SWELL_RENDER_MATERIALS_TERRAIN_INL_H_
#else
#define SWELL_RENDER_MATERIALS_TERRAIN_INL_H_
#endif

#include <algorithm>

#include "render/materials/canopy-inl.h"
#include "render/materials/checker-inl.h"
#include "render/materials/ground-inl.h"
#include "render/materials/land-inl.h"
#include "render/materials/river_bed-inl.h"
#include "render/materials/terrain.h"
#include "render/packets/fresnel-inl.h"
#include "render/sky/fog-inl.h"
#include "render/tile/caustics-inl.h"
#include "render/tile/shading_result-inl.h"
#include "render/tile/through_water-inl.h"
#include "render/water/foam-inl.h"
#include "render/water/topside-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// The sun on the ground by its map, and outside that by the light's own way.
HWY_INLINE V SunFromMap(const Shading& s, const SlopeLayer& map, V3 p, V level_m, const V3& p_lit) {
  const V zero = hn::Zero(D()), half = Constant(0.5f);
  const LayerPlace place = PlaceIn(map, p.x, p.y);
  V code, unused;
  SampleNearest(map, place, level_m, code, unused);
  const V visible = MulAdd(code, half, half);
  const V side = Constant(256.0f * static_cast<float>(map.map->size - 1));
  const auto inside = ((place.x_fx8 >= zero) & (place.y_fx8 >= zero)) &
                      ((place.x_fx8 < side) & (place.y_fx8 < side));
  if (hn::AllTrue(D(), inside) || !s.sun_shadow.land) return visible;
  return IfThenElse(inside, visible, SunOverLand(s.sun_shadow, p_lit, s.rays.eye_z));
}

// The part of the sun that the ground sees: over the sea floor, from where its light enters the
// water.
template <ViewKind kView>
HWY_INLINE V SunOnGround(const Shading& s, const Terrain& terrain, const TilePixels& tile,
                         const Packet& packet, V level_m) {
  LitPoint point = {packet.p, PixelSoftness(s, packet.depth), Constant(-1.0f)};
  if (ShowsWaterSide<kView>(s.media)) point.p = WhereLightEnters(s, packet.p);
  V visible = Constant(1.0f);
  if (terrain.sun.map) visible = SunFromMap(s, terrain.sun, packet.p, level_m, point.p);
  if (s.sun_shadow.clouds)
    visible = visible * SunUnderClouds(*s.sun_shadow.clouds, point.p, s.rays.eye_z);
  if (tile.casters.empty()) return visible;
  return visible * SunOverObjects(s.sun_shadow, tile.casters, SpanOf(packet), point);
}

// What ground is like for light. normal: as seen; inverse_length: that of a normal (-slope_x,
// -slope_y, 1), with the slopes that a pixel does not show.
struct GroundLook {
  V3 albedo, normal;
  V inverse_length, sky_seen;
};

// Seen in or through water, and the floor of the sea.
template <bool kDetail>
HWY_INLINE GroundLook FindPlainGround(const Terrain& terrain, const Packet& packet, V on_map,
                                      V level_m, GroundSlopes slopes) {
  if constexpr (kDetail) {
    const V zero = hn::Zero(D());
    V unused = zero;
    AddSlopes(terrain.detail, packet.p, level_m, {zero, zero}, slopes.x, slopes.y, unused);
  }
  const V3 normal = NormalOf(slopes.x, slopes.y);
  return {FindAlbedo(terrain.albedo, on_map, packet.p), normal, normal.z, Constant(1.0f)};
}

HWY_INLINE GroundLook FindDryGround(const Terrain& terrain, const ViewRays& rays,
                                    const Packet& packet, V on_map, GroundSlopes slopes) {
  const V cos_view = Clamp(Abs(Dot(NormalOf(slopes.x, slopes.y), packet.to_eye)), 0.3f, 1.0f);
  const V level_m = FootprintLevel(FootprintAcross(rays, packet), cos_view);
  const LandLook land = FindLand(terrain, rays, packet, on_map, level_m, slopes.x, slopes.y);
  const V slope2 = MulAdd(land.slope_x, land.slope_x, land.slope_y * land.slope_y);
  const V inverse_length = InverseSqrt(1.0f + (slope2 + land.variance));
  return {land.albedo, NormalOf(land.slope_x, land.slope_y), inverse_length, land.sky_seen};
}

template <bool kDetail>
HWY_INLINE GroundLook FindGround(const Terrain& terrain, const Shading& s, const Packet& packet,
                                 V level_m) {
  const D d;
  const ViewRays& rays = s.rays;
  const V on_map = OnMap(terrain.albedo, packet.p);
  const GroundSlopes slopes = FindSlopes<kDetail>(terrain, on_map, packet.p, level_m);
  // In a river or a lake.
  if (s.media.water_level_m != 0.0f && s.kind != ViewKind::kRefraction) {
    GroundLook bed = FindPlainGround<kDetail>(terrain, packet, on_map, level_m, slopes);
    bed.albedo = FindBed(s.material<River>(), packet.p, Constant(s.media.water_level_m), level_m);
    return bed;
  }
  if constexpr (kDetail) {
    if (terrain.land.on) {
      const auto dry = packet.p.z > s.level_rel_m;
      if (hn::AllTrue(d, dry)) return FindDryGround(terrain, rays, packet, on_map, slopes);
      const GroundLook floor = FindPlainGround<kDetail>(terrain, packet, on_map, level_m, slopes);
      if (hn::AllFalse(d, dry)) return floor;
      const GroundLook land = FindDryGround(terrain, rays, packet, on_map, slopes);
      return {IfThenElse(dry, land.albedo, floor.albedo),
              IfThenElse(dry, land.normal, floor.normal),
              IfThenElse(dry, land.inverse_length, floor.inverse_length),
              IfThenElse(dry, land.sky_seen, floor.sky_seen)};
    }
  }
  return FindPlainGround<kDetail>(terrain, packet, on_map, level_m, slopes);
}

// Ground, diffuse and lit by sun and sky.
struct Ground {
  V3 light, normal;
};
template <bool kDetail>
HWY_INLINE Ground LightGround(const Terrain& terrain, const Shading& s, const Packet& packet,
                              V level_m, V sun_visible) {
  const Light& light = s.light;
  const V zero = hn::Zero(D());
  GroundLook look = FindGround<kDetail>(terrain, s, packet, level_m);
  if (terrain.checker.per_m > 0.0f) {
    const V grey = CheckeredGround(terrain.checker, s.rays, packet);
    look.albedo = {grey, grey, grey};
  }
  const UnderTrees under =
      FindUnderTrees(terrain.canopy, s.sun_shadow.under_trees, s.rays, packet, level_m);
  look.albedo = ColourUnderTrees(terrain.canopy, under, look.albedo);
  sun_visible = sun_visible * under.sun;

  // Slopes that are not shown make the mean cosine less.
  const V rough = look.inverse_length / look.normal.z;
  const V cos_mean = Dot(look.normal, Constant(light.sun_direction)) * rough;
  const V cos_sun = Max(cos_mean, zero) * sun_visible;
  const V open = look.sky_seen * under.sky * AmbientUnderClouds(s, packet.p);
  const V sky_seen = MulAdd(look.inverse_length, 0.5f, 0.5f) * open;
  const V3 arriving = MulAdd(Constant(light.sun_irradiance), cos_sun * 0.318309886f,
                             Constant(light.ambient) * sky_seen);
  return {arriving * look.albedo, look.normal};
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
  SinCosTurns(d, MulAdd(p.x, swash.lag_a.x, MulAdd(p.y, swash.lag_a.y, swash.lag_a.z)), along_a,
              unused);
  SinCosTurns(d, MulAdd(p.x, swash.lag_b.x, MulAdd(p.y, swash.lag_b.y, swash.lag_b.z)), along_b,
              unused);
  const V lag = (along_a + along_b) * 0.3f;
  const V turns = swash.cycles - lag;
  SinCosTurns(d, turns, sine, cosine);
  // sin(phi - 0.35 cos phi) is high for a shorter time than low.
  const V leaning = MulAdd(cosine, -0.056f, turns);
  SinCosTurns(d, leaning, sine, cosine);
  const V half = Constant(0.5f);
  // Scallops: the edge is a row of lobes.
  V lobes;
  SinCosTurns(
      d,
      MulAdd(p.x, swash.lag_c.x, MulAdd(p.y, swash.lag_c.y, MulAdd(along_b, 0.7f, swash.lag_c.z))),
      lobes, unused);
  const V reach = MulAdd(along_b, 0.09f, MulAdd(lobes, 0.06f, 0.85f));
  const V edge = MulAdd(sine, half, half) * (reach * swash.reach_m);
  return {edge, MulAdd(cosine, -half, half)};
}

// How much higher or lower the ground is one pixel farther up [m]: seen from near the ground by
// decimetres. `normal`: the ground's.
HWY_INLINE V RiseOverPixel(const ViewRays& rays, const Packet& packet, V3 normal) {
  const V along = Abs(MulAdd(packet.to_eye.x, normal.x, packet.to_eye.y * normal.y));
  const V facing = Max(Dot(packet.to_eye, normal), 0.004f);
  return packet.depth * rays.pixel_angle * (along / facing);
}

// From 0 to 1 while x goes from 0 to `ramp`, as pixels show it that span so much of x.
HWY_INLINE V RampOverPixel(V x, float ramp, V span) {
  const V width = Sqrt(MulAdd(span * span, 2.25f, ramp * ramp));
  return (x - 0.5f * ramp) / width + 0.5f;
}

// The sea's waves where they run out over the sand: `kept` of them is left, in [0, 1].
HWY_INLINE WaterSlopes SampleRunOut(const Shading& s, const Packet& packet, V kept) {
  const V zero = hn::Zero(D());
  const Water& water = s.material<Water>();
  const V flat = Constant(water.base_variance);
  if (hn::AllFalse(D(), kept > zero)) return NoSlopes(flat, flat, packet.to_eye.z);
  const WaterSlopes sea = SampleWater<true>(water, s.rays, packet);
  WaterSlopes left = NoSlopes(Lerp(flat, sea.variance, kept), Lerp(flat, sea.fine_variance, kept),
                              Lerp(packet.to_eye.z, sea.long_cosine, kept));
  left.slope_x = sea.slope_x * kept;
  left.slope_y = sea.slope_y * kept;
  left.foam.cover = sea.foam.cover * kept;
  return left;
}

// Foam of a sheet whose rim is `below` [m of height] above: a bright rim, then lace that thins out.
// None where the sea begins, which brings its own. Pixels span so much height.
HWY_INLINE V SheetFoam(float reach_m, const SwashEdge& swash, V below, V span_m, V calm) {
  const V from_rim = below * (1.0f / reach_m);
  const V span = span_m * (1.0f / reach_m);
  // A rim narrower than a pixel shows in part.
  const V shown = InverseSqrt(MulAdd(span * span, 81.0f, 1.0f));
  const V rim = shown * Clamp(NegMulAdd(from_rim, 9.0f, 1.0f), 0.0f, 1.0f);
  const V lace = Clamp(NegMulAdd(from_rim, 0.9f, 0.6f), 0.0f, 1.0f);
  const V front = Clamp(RampOverPixel(from_rim, 0.025f, span), 0.0f, 1.0f);
  const V fresh = NegMulAdd(swash.retreat, 0.6f, 1.0f);
  const V begun = Min(calm * 2.0f, 1.0f);
  return Max(rim, lace) * front * (fresh * begun);
}

constexpr FoamOpacity kSheetFoam = {0.92f, 0.0f, 0.0f};

// Wet sand mirrors the sky; a sheet of water with foam at its rim runs over it, and at the sea's
// level both are what the sea is where it has no depth. `ground` is the ground's light at p, whose
// height is height_m and which sees the part sun_visible of the sun.
HWY_INLINE V3 AddSwash(const Shading& s, const Terrain& terrain, const Packet& packet, V level_m,
                       V height_m, V sun_visible, const Ground& dry) {
  const D d;
  const float reach_m = terrain.swash.reach_m;
  const V3 ground = dry.light;
  if (reach_m <= 0.0f || hn::AllFalse(d, height_m < 1.6f * reach_m)) return ground;
  // In a lee sheets run less high: the beach is as if it were higher.
  const Water& water = s.material<Water>();
  const V kept = KeptBeside(water.near_shore, packet.p, level_m);
  height_m = height_m / kept;
  const auto reached = height_m < 1.6f * reach_m;
  if (hn::AllFalse(d, reached)) return ground;
  const SwashEdge swash = FindSwashEdge(terrain.swash, packet.p);
  // Sand stays wet for a while up to where the sheets come.
  const V height = height_m * (1.0f / reach_m);
  const V wet = SmoothBlend(MulAdd(height, -1.0f / 1.1f, 1.6f / 1.1f));
  const V calm = Clamp(height * 4.0f, 0.0f, 1.0f);
  const V below = swash.edge_m - height_m;  // of the sheet's rim [m of height]
  const V span_m = Min(RiseOverPixel(s.rays, packet, dry.normal) / kept,
                       0.6f * reach_m);  // so that sheets end before `reached` does
  const V sheet = SmoothBlend(RampOverPixel(below, 0.125f * reach_m, span_m));
  // The sea thins out over a little of the sand, also where no sheet comes in.
  const V film = Max(sheet, SmoothBlend(NegMulAdd(calm, 1.2f, 1.0f)));

  const WaterSlopes waves = SampleRunOut(s, packet, NegMulAdd(calm, film, film));
  const Facing f = FaceEye(s.media, water, packet, waves);
  V inv_variance;
  const V glint = SunGlint(s.light.sun_direction, packet, waves, GlintReflectance{s.media}, f.area,
                           inv_variance);
  const V3 floor = ground - Constant(s.media.body);
  const V3 mirrored = ReflectedLight(s, packet, waves, f, inv_variance, floor, false).light;
  const V half = Constant(0.5f);
  const V shine = f.reflectance * MulAdd(film, half, wet * half);
  const V bare = NegMulAdd(wet, film, wet);
  const V darkened = NegMulAdd(bare, 0.15f, 1.0f);
  V3 light = Lerp(ground * darkened, mirrored, shine);
  light = MulAdd(Constant(s.light.sun_irradiance), glint * (film * sun_visible), light);
  const V foam = SheetFoam(reach_m, swash, below, span_m, calm);
  FoamLayer layer = waves.foam;
  layer.cover = Max(layer.cover, FoamCover(water.foam_lace, packet.p, level_m, foam));
  light = AddFoam(water.foam_light, kSheetFoam, layer,
                  Constant(std::max(s.light.sun_direction.z, 0.0f)),
                  {sun_visible, AmbientUnderClouds(s, packet.p)}, light);
  return IfThenElse(reached, light, ground);
}

// Ground as the eye sees it, with the sea's last sheets on it; without detail for what is seen
// through or in water.
template <ViewKind kView>
struct Shader<Terrain, kView> {
  const Terrain& terrain;

  HWY_INLINE auto operator()(const Shading& s, const TilePixels& tile, const Lanes&,
                             const Packet& packet) const {
    const V level_m = GroundLevel(s.rays, packet);
    constexpr bool kDetail = kView == ViewKind::kWindow;
    V sun_visible = SunOnGround<kView>(s, terrain, tile, packet, level_m);
    if (s.media.fog.on) sun_visible = sun_visible * SunOverFog(s.media.fog, packet.p.z);
    if (ShowsWaterSide<kView>(s.media))
      sun_visible = sun_visible *
                    GatheredSun(s, packet.p, PatternLevel<kView>(s.caustics.blur, packet, level_m));
    const Ground ground = LightGround<kDetail>(terrain, s, packet, level_m, sun_visible);
    if constexpr (kView == ViewKind::kWindow) {
      if (s.media.submerged) return ShadingResult{ground.light, ground.normal};
      const V height_m = packet.p.z + s.rays.eye_z;
      return ShadingResult{AddSwash(s, terrain, packet, level_m, height_m, sun_visible, ground),
                           ground.normal};
    } else if constexpr (kView == ViewKind::kRefraction) {
      return FadingResult{{ground.light, ground.normal}, FloorShown(terrain, packet.p)};
    } else {
      return ShadingResult{ground.light, ground.normal};
    }
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
