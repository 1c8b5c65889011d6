// The water's surface from above.
#if defined(SWELL_RENDER_WATER_TOPSIDE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_WATER_TOPSIDE_INL_H_
#undef SWELL_RENDER_WATER_TOPSIDE_INL_H_
#else
#define SWELL_RENDER_WATER_TOPSIDE_INL_H_
#endif

#include <algorithm>
#include <span>

#include "render/labels/label_channels.h"
#include "render/packets/fresnel-inl.h"
#include "render/sky/mirrored_sky-inl.h"
#include "render/sky/sky_map-inl.h"
#include "render/sky/stars-inl.h"
#include "render/tile/light_code-inl.h"
#include "render/tile/shading_result-inl.h"
#include "render/tile/sun_shadow-inl.h"
#include "render/view/wave_reach.h"
#include "render/water/glitter-inl.h"
#include "render/water/hull-inl.h"
#include "render/water/image_blur-inl.h"
#include "render/water/own_colour-inl.h"
#include "render/water/visible_slopes-inl.h"
#include "render/water/water.h"
#include "render/water/water_slopes-inl.h"
#include "render/water/whitecaps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// What a planar map shows at a place, and what part of the place it fills.
struct Looked {
  V3 light;
  V alpha;
};

// Whether a planar map may show anything at any lane's window position.
HWY_INLINE bool MayShow(const PlanarMap& map, V x_px, V y_px) {
  if (!map.shown_rows) return true;
  const DI di;
  // Not a number is 0, as lookups have it.
  const auto whole = [&](V v, int size) HWY_ATTR {
    return TruncateToInt(IfThenElseZero(v > 0.0f, Min(v, static_cast<float>(size - 1))));
  };
  const VI column =
      hn::ShiftRight<PlanarMap::kColumnsLog2>(whole(x_px * map.scale_x, map.image->width));
  const VI row = whole(y_px * map.scale_y, map.image->height);
  const VI rows =
      hn::GatherIndex(di, reinterpret_cast<const std::int32_t*>(map.shown_rows), column);
  return !hn::AllFalse(di, hn::AndNot(row < (rows & 0xffff), row < hn::ShiftRight<16>(rows)));
}

// Looks a planar map up at a window position, on a level of it. Samples beside nothing are no
// darker: only their alpha is less.
HWY_INLINE Looked LookUpAt(const PlanarMap& map, V x_px, V y_px, const BlurLevel& level) {
  const D d;
  const V one = Constant(1.0f);
  const V x = x_px * map.scale_x, y = y_px * map.scale_y;
  const auto [r, g, b, alpha] = SampleBlurred(*map.image, x, y, level);
  V3 code = {r, g, b};
  const auto some = alpha > 0.0f;
  if (hn::AllFalse(d, some)) return {Constant(glm::vec3(0.0f)), alpha};
  // Codes that were blended with zeros.
  if (!hn::AllFalse(d, some & (alpha < one))) code = code * (one / Max(alpha, 1.0f / 512.0f));
  return {DecodeLight(code), alpha};
}

HWY_INLINE Looked ShowNothing() { return {Constant(glm::vec3(0.0f)), hn::Zero(D())}; }

// Looks a planar map up where slopes of this variance spread what it shows. Not inlined: few
// packets come here.
static HWY_NOINLINE Looked LookUpSoftly(const PlanarMap& map, V x_px, V y_px, V variance,
                                        V px2_per_slope2) {
  return LookUpAt(map, x_px, y_px, FindBlur(map, variance, px2_per_slope2));
}

// What `front` leaves of a place shows `behind`.
HWY_INLINE Looked LayOver(const Looked& front, const Looked& behind) {
  const V shown = (1.0f - front.alpha) * behind.alpha;
  const V alpha = front.alpha + shown;
  const V part = shown / Max(alpha, 1.0f / 512.0f);
  return {Lerp(front.light, behind.light, part), alpha};
}

// Looks a planar map up at the pixel's own window position, moved by the slopes (spec: distortion
// tied to the bump, fading where the surface is seen edge-on so that far, small things hold
// together). Where kBacked, what is not found there is looked up at the pixel's own position.
template <bool kBacked>
HWY_INLINE Looked LookUpDistorted(const Water& water, const PlanarMap& map, const Packet& packet,
                                  const WaterSlopes& s, float sign) {
  const D d;
  const V right =
      MulAdd(s.slope_x, water.images.view_right.x, s.slope_y * water.images.view_right.y);
  const V ahead =
      MulAdd(s.slope_x, water.images.view_ahead.x, s.slope_y * water.images.view_ahead.y);
  const Distortion& distortion = water.images.distortion;
  const V gain = sign * distortion.px_per_slope *
                 Clamp(packet.to_eye.z * distortion.by_sine, distortion.least, 1.0f);
  const float bound = water.images.max_distortion_px;
  const V dx = Clamp(right * (gain * -distortion.across), -bound, bound);
  const V dy = Clamp(ahead * gain, -bound, bound);
  const V half = Constant(0.5f);
  const V x = packet.x_px + half, y = packet.y_px + half;
  if constexpr (!kBacked) {
    return MayShow(map, x + dx, y + dy) ? LookUpSoftly(map, x + dx, y + dy, s.variance, gain * gain)
                                        : ShowNothing();
  } else {
    // What lies under water is near the surface: slopes too fine to see move it by less than they
    // spread it.
    if (!MayShow(map, x + dx, y + dy) && !MayShow(map, x, y)) return ShowNothing();
    const Looked moved = LookUpAt(map, x + dx, y + dy, Sharp());
    const bool found = hn::AllTrue(d, moved.alpha >= 1.0f);
    return found ? moved : LayOver(moved, LookUpAt(map, x, y, Sharp()));
  }
}

// The part of the facets seen that mirror the sea again, not the sky. The mean slopes send the ray
// to r_z, and slopes that a pixel cannot resolve spread it by 2 sigma, sigma^2 = variance / 2; the
// blend is 1.4 times as wide as that normal distribution, or dark lines would show on fine waves.
// The lower the eye is, the fewer of the facets that throw rays down are turned to it: that part
// grows with to_eye_z^2 / (8 sigma^2), and on back sides also with r_z^2. Root mean square error
// against the facets themselves 0.06; in the mean over waves at most 0.06 too much.
HWY_INLINE V PartOfSeaMirrored(V r_z, V to_eye_z, V inv_variance) {
  const V zero = hn::Zero(D()), one = Constant(1.0f);
  const V scale = inv_variance * 0.125f;
  const V r_z2 = r_z * Abs(r_z);
  const V turn = Clamp(r_z2 * scale, -1.0f, 1.0f);
  const V up = turn * (2.0f - Abs(turn));  // in [-1, 1]
  const V down = NegMulAdd(up, 0.5f, 0.5f);
  const V low2 = MulAdd(Min(r_z2, zero), -0.125f, to_eye_z * to_eye_z);
  const V hidden = Max(NegMulAdd(low2, scale, one), zero);
  return down * NegMulAdd(hidden, hidden, one);
}

// How the water's surface meets the eye.
struct Facing {
  V3 normal;
  V cos_eye;     // of the slopes drawn here; negative on back sides that the mesh does not hide
  V cos_mirror;  // of facets that mirror the mean of what those seen do
  V area;        // that all facets turn to the eye, over the level's
  V reflectance;
};

HWY_INLINE Facing FaceEye(const Media& media, const Water& water, const Packet& packet,
                          const WaterSlopes& s) {
  const D d;
  Facing f;
  f.normal = NormalOf(s.slope_x, s.slope_y);
  if (water.least_cos > 0.0f) {
    f.cos_eye = f.cos_mirror = TiltToEye(packet.to_eye, water.least_cos, f.normal);
  } else {
    f.cos_eye = f.cos_mirror = Dot(f.normal, packet.to_eye);
    if (water.visible_slopes > 0.0f) {
      const V drawn = Max(1.0f - s.variance / s.fine_variance, 0.0f);
      f.cos_eye = UnhiddenCosine(f.cos_eye, s.long_cosine, s.fine_variance, drawn);
      f.cos_mirror = MirroringCosine(f.cos_eye, s.variance);
    }
  }
  f.area = SeenArea(s.long_cosine, s.fine_variance);
  f.reflectance =
      FresnelReflectance(d, ReflectingCosine(f.cos_eye, s.variance), media.refraction_index);
  return f;
}

// Slopes that a pixel does not show turn a mirrored ray by twice as much, and draw its spot wider:
// by the root of 8 variances of one axis.
HWY_INLINE V3 MirroredStars(const Stars& stars, V3 r, V length, V variance) {
  const float least = std::min(1.5f * stars.pixel_angle, 0.9f * kWidestStar);
  const V radius = Sqrt(MulAdd(Max(variance, 0.0f), 16.0f, least * least));
  return StarLight(stars, r * (1.0f / length), radius);
}

// What the surface mirrors: the sky in the reflected direction, the sea where that points below the
// horizon that waves make, brighter by what its floor adds here, and in front of both whatever the
// reflection image shows there; `alpha` is the image's part.
HWY_INLINE Looked ReflectedLight(const Shading& shading, const Packet& packet, const WaterSlopes& s,
                                 const Facing& f, V inv_variance, V3 floor, bool use_image) {
  const Light& light = shading.light;
  const Water& water = shading.material<Water>();
  const V horizon = Constant(water.optics.wave_horizon);
  const V r_z = MulSub(f.cos_eye + f.cos_eye, f.normal.z, packet.to_eye.z);
  const V sea = PartOfSeaMirrored(r_z - horizon, packet.to_eye.z + horizon, inv_variance);
  V3 r = MulAdd(f.normal, f.cos_mirror + f.cos_mirror, -packet.to_eye);
  // Outside its circle the map goes on as at the horizon.
  r.z = Max(r.z, -0.25f);
  const V length = Sqrt(Dot(r, r));
  V3 mirrored = SoftSkyRadiance(*light.sky_soft, r, length);
  if (light.calm.sky) mirrored = MirrorSky(light.calm, packet, r, length, s.variance, mirrored);
  if (light.stars.on)
    mirrored = mirrored + MirroredStars(light.stars, r, length, s.variance - water.base_variance);
  const V3 mirrored_sea = MulAdd(floor, Constant(water.optics.mirrored_floor_part),
                                 Constant(water.optics.mirrored_sea));
  mirrored = Lerp(mirrored, mirrored_sea, sea);
  if (!use_image) return {mirrored, hn::Zero(D())};
  const Looked image = LookUpDistorted<false>(water, water.images.reflection, packet, s, 1.0f);
  return {Lerp(mirrored, image.light, image.alpha), image.alpha};
}

struct Refracted {
  V3 light;
  V image_alpha;   // the part of it that the refraction image shows
  V3 floor_added;  // what that changes
};

// What comes up through the surface: scattered light of the water body, brighter in thin crests
// against the sun, and the floor where the refraction image shows one.
HWY_INLINE Refracted RefractedLight(const Shading& shading, const Water& water,
                                    const Packet& packet, const WaterSlopes& s, V sun_visible,
                                    bool use_image) {
  // Far triangles cut off some of the earth's curve: that is no trough.
  const V share = Clamp(
      NegMulAdd(packet.distance, kWaveShareFall * water.optics.inv_wave_reach, kWaveShareAtEye),
      0.0f, 1.0f);
  const V height = share * (packet.p.z + shading.rays.eye_z);
  const V crest = Clamp(MulAdd(height, water.optics.inv_crest_height, 0.4f), 0.0f, 1.5f);
  const V towards_sun = Max(-MulAdd(packet.to_eye.x, shading.light.sun_direction.x,
                                    packet.to_eye.y * shading.light.sun_direction.y),
                            0.0f);
  const V glow = crest * crest * MulAdd(towards_sun, sun_visible, 0.35f);
  const V3 crest_light = Constant(water.optics.crest_glow) * glow;
  V3 deep = crest_light + DeepWater(shading, packet.p, sun_visible);
  if (water.bump_detail.on() || water.texture.on())
    deep = deep * OwnColour(shading, water, packet, NormalOf(s.slope_x, s.slope_y), sun_visible);
  if (!use_image) return {deep, hn::Zero(D()), Constant(glm::vec3(0.0f))};
  const Looked floor =
      LookUpDistorted<true>(water, water.images.refraction, packet, s, kRefractedDistortion);
  // The image's water has no crests: over a floor too deep to be seen it must be as without one.
  const V weight = floor.alpha * water.optics.refraction_weight;
  const V3 floor_added = (floor.light + crest_light - deep) * weight;
  return {deep + floor_added, weight, floor_added};
}

// What a facet that mirrors the sun to the eye reflects; `half` is the sum of their directions.
struct GlintReflectance {
  const Media& media;
  HWY_INLINE V operator()(V3 half) const {
    return FresnelReflectance(D(), Sqrt(Dot(half, half)) * 0.5f, media.refraction_index);
  }
};

// The sun's mirror image in the slopes that a pixel cannot resolve: a Gaussian slope distribution
// of facets of an area that is seen, over the level's. `inv_variance` becomes 1 / s.variance.
// Source: Ross, Dion, Potvin, Detailed analytical approach to the Gaussian surface bidirectional
// reflectance distribution function, 2005, without what waves hide of the sun. Beside the sun's
// path its light is far below what a float beside the water's own light holds, and 0 here.
template <class Reflectance>
HWY_INLINE V SunGlint(glm::vec3 sun_direction, const Packet& packet, const WaterSlopes& s,
                      const Reflectance& reflectance, V area, V& inv_variance) {
  const V3 half = packet.to_eye + Constant(sun_direction);
  // The three quotients' denominators share one division.
  const V z = Max(half.z, 1e-3f);
  const V cos4 = 4.0f * Max(area, kMinCos);
  const V z_cos4 = z * cos4;
  const V inverse = 1.0f / (z_cos4 * s.variance);
  inv_variance = inverse * z_cos4;  // = 1 / (2 sigma^2) per axis
  const V inverse_z_cos4 = inverse * s.variance;
  const V inv_z = inverse_z_cos4 * cos4, inv_cos4 = inverse_z_cos4 * z;

  const V dx = MulAdd(half.x, inv_z, s.slope_x);  // half-way slope is -half.xy / half.z
  const V dy = MulAdd(half.y, inv_z, s.slope_y);
  const V exponent = MulAdd(dx, dx, dy * dy) * -inv_variance;
  const auto on_path = exponent > -50.0f;
  if (hn::AllFalse(D(), on_path)) return hn::Zero(D());
  const V density = IfThenElseZero(on_path, Exp(D(), exponent) * (inv_variance * 0.318309886f));
  const V inv_cos2 = Dot(half, half) * (inv_z * inv_z);
  const V scale = inv_cos2 * inv_cos2 * inv_cos4;
  return reflectance(half) * density * scale;
}

// Bits of Label::kFlags, as a number: images that hide more than half of what else is seen, wakes.
HWY_INLINE V FlagsOf(V mirrored_alpha, V refracted_alpha, V wake) {
  const auto bit = [](V alpha, std::uint32_t value) HWY_ATTR {
    return IfThenElseZero(alpha > 0.5f, Constant(static_cast<float>(value)));
  };
  return bit(mirrored_alpha, kShowsMirrored) + bit(refracted_alpha, kShowsRefracted) +
         bit(wake * 0.5f, kShowsWake);
}

// What hulls do to the water around them: they keep the sky's light off it and whiten it.
HWY_INLINE void AddHulls(const Shading& shading, const TilePixels& tile, const Packet& packet,
                         V3& refracted, FoamLayer& foam) {
  if (tile.casters.empty()) return;
  const V level_m =
      FootprintLevel(FootprintAcross(shading.rays, packet), Clamp(packet.to_eye.z, kMinCos, 1.0f));
  const AtHulls hulls = SampleHulls(shading.sun_shadow, shading.material<Water>().hull_foam_lace,
                                    tile.casters, SpanOf(packet), packet.p, level_m);
  refracted = refracted * (1.0f - hulls.sky_hidden);
  foam = Join(foam, hulls.foam);
}

// The light of a surface from above, of slopes that a body of water has there. The body says what
// is its own, each for a packet:
//   V SunVisible();
//   Refracted Below(V sun_visible);                            what comes up through the surface
//   Looked Mirrored(const Facing&, V inv_variance, V3 floor);  floor: Refracted::floor_added
//   V Weight(const Facing&);                                   of what it mirrors
//   V SunPath(const Facing&, V glint);
//   V SunOnFoam(const Facing&);                                the cosine
//   FoamOpacity kFoam;
template <class Body>
HWY_INLINE ShadingResult ShadeFromAbove(const Shading& shading, const TilePixels& tile,
                                        const Packet& packet, const WaterSlopes& s,
                                        const Body& body) {
  const Water& water = shading.material<Water>();
  const Facing f = FaceEye(shading.media, water, packet, s);
  const V sun_visible = body.SunVisible();
  V inv_variance;
  const V glint = SunGlint(shading.light.sun_direction, packet, s, GlintReflectance{shading.media},
                           f.area, inv_variance);
  Refracted refracted = body.Below(sun_visible);
  const Looked mirrored = body.Mirrored(f, inv_variance, refracted.floor_added);
  FoamLayer foam = s.foam;
  AddHulls(shading, tile, packet, refracted.light, foam);
  const V3 arriving = Lerp(refracted.light, mirrored.light, body.Weight(f));
  const V sun_path = body.SunPath(f, glint);
  V3 seen = MulAdd(Constant(water.optics.glitter_light), sun_path * sun_visible, arriving);
  seen = AddFoam(water.foam_light, Body::kFoam, foam, body.SunOnFoam(f),
                 {sun_visible, AmbientUnderClouds(shading, packet.p)}, seen);
  return {seen, f.normal, foam.cover, FlagsOf(mirrored.alpha, refracted.image_alpha, s.wake)};
}

struct SeaBody {
  static constexpr FoamOpacity kFoam = {0.55f, 0.42f, 0.4f};

  const Shading& shading;
  const TilePixels& tile;
  const Water& water;
  const Packet& packet;
  const WaterSlopes& s;

  HWY_INLINE V SunVisible() const { return SunOnSea(shading, tile, packet); }
  HWY_INLINE Refracted Below(V sun_visible) const {
    return RefractedLight(shading, water, packet, s, sun_visible, tile.planar_maps.refraction);
  }
  HWY_INLINE Looked Mirrored(const Facing& f, V inv_variance, V3 floor) const {
    return ReflectedLight(shading, packet, s, f, inv_variance, floor, tile.planar_maps.reflection);
  }
  HWY_INLINE V Weight(const Facing& f) const {
    return water.optics.reflection_weight < 0.0f ? f.reflectance
                                                 : Constant(water.optics.reflection_weight);
  }
  HWY_INLINE V SunPath(const Facing& f, V glint) const {
    if (!water.glitter.sun_texture) return glint;
    return f.reflectance * ProjectedGlitter(water.glitter, packet.to_eye, f.normal, s.variance);
  }
  HWY_INLINE V SunOnFoam(const Facing& f) const {
    return Max(Dot(f.normal, Constant(shading.light.sun_direction)), 0.0f);
  }
};

// kCoast: water.knows_land().
template <bool kCoast>
struct WaterShader {
  using Found = WaterSlopes;
  const Water& water;

  HWY_INLINE void LookUp(const Shading& shading, std::span<const Packet> packets,
                         WaterSlopes* found) const {
    SampleWater<kCoast>(water, shading.rays, packets, found);
  }

  HWY_INLINE ShadingResult operator()(const Shading& shading, const TilePixels& tile, const Lanes&,
                                      const Packet& packet, const WaterSlopes& s) const {
    return ShadeFromAbove(shading, tile, packet, s, SeaBody{shading, tile, water, packet, s});
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
