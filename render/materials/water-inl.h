// The water material.
#if defined(SWELL_RENDER_MATERIALS_WATER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_WATER_INL_H_
#undef SWELL_RENDER_MATERIALS_WATER_INL_H_
#else
#define SWELL_RENDER_MATERIALS_WATER_INL_H_
#endif

// 1 in sanitizer builds: with their checks GCC takes ten minutes for three.
#ifndef SWELL_WATER_PACKETS_AT_ONCE
#define SWELL_WATER_PACKETS_AT_ONCE 3
#endif

#include <algorithm>
#include <array>

#include "render/labels/label_channels.h"
#include "render/materials/bump_light-inl.h"
#include "render/materials/foam-inl.h"
#include "render/materials/fresnel-inl.h"
#include "render/materials/glitter-inl.h"
#include "render/materials/hull-inl.h"
#include "render/materials/image_blur-inl.h"
#include "render/materials/near_shore-inl.h"
#include "render/materials/tiled_slopes-inl.h"
#include "render/materials/visible_slopes-inl.h"
#include "render/materials/wakes-inl.h"
#include "render/materials/water.h"
#include "render/materials/whitecaps-inl.h"
#include "render/tile/light_code-inl.h"
#include "render/tile/stars-inl.h"
#include "render/tile/sun_shadow-inl.h"
#include "render/tile/surfel-inl.h"
#include "render/view/wave_reach.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// The water's surface at a packet: mean slopes that the maps show, and the variance (of both axes
// together) of the slopes too fine for a pixel.
struct WaterSlopes {
  V slope_x, slope_y, variance;
  V foam_cover;     // part hidden by foam, in [0, 1]
  V fine_variance;  // of all slopes but the drawn ones of the long waves: triangles do not show
                    // them
  V long_cosine;    // to the eye, of those
  // Of foam: TornFoam.
  V foam_thickness, foam_bubbles;
  V wake;  // over 1 where one is seen
};

// Level water without foam or wakes.
HWY_INLINE WaterSlopes NoSlopes(V variance, V fine_variance, V long_cosine) {
  const V zero = hn::Zero(D());
  return {zero, zero, variance, zero, fine_variance, long_cosine, zero, zero, zero};
}

HWY_INLINE void SetFoam(const TornFoam& foam, WaterSlopes& s) {
  s.foam_cover = foam.cover;
  s.foam_thickness = foam.thickness;
  s.foam_bubbles = foam.bubbles;
}

// Foam of another origin, so far over its threshold.
HWY_INLINE void AddFoamOver(V over, WaterSlopes& s) {
  s.foam_cover = hn::Max(s.foam_cover, CoverOfOver(over));
  s.foam_thickness = hn::Max(s.foam_thickness, Clamp(over, 0.0f, 1.0f));
}

HWY_INLINE void AddSine(const SineLayer& sine, V3 p, V level_m, WaterSlopes& s) {
  const V cycles =
      hn::MulAdd(p.x, Constant(sine.kx), hn::MulAdd(p.y, Constant(sine.ky), Constant(sine.cycles)));
  V sin_unused, cosine;
  SinCosTurns(D(), cycles, sin_unused, cosine);
  // A wave shorter than two footprints turns into roughness.
  const float level_lost = sine.wavelength_log2 - 1.0f;
  const V seen = Clamp(hn::Sub(Constant(level_lost), level_m), 0.0f, 1.0f);
  const V amount = hn::Mul(cosine, seen);
  s.slope_x = hn::MulAdd(amount, Constant(sine.slope_x), s.slope_x);
  s.slope_y = hn::MulAdd(amount, Constant(sine.slope_y), s.slope_y);
  const float variance = 0.5f * (sine.slope_x * sine.slope_x + sine.slope_y * sine.slope_y);
  s.variance =
      hn::MulAdd(hn::NegMulAdd(seen, seen, Constant(1.0f)), Constant(variance), s.variance);
}

// The unit normal of slopes.
HWY_INLINE V3 NormalOf(V slope_x, V slope_y) {
  const V inv_length =
      InverseSqrt(hn::MulAdd(slope_x, slope_x, hn::MulAdd(slope_y, slope_y, Constant(1.0f))));
  return {hn::Neg(hn::Mul(slope_x, inv_length)), hn::Neg(hn::Mul(slope_y, inv_length)), inv_length};
}

// What a coast's maps say of a packet: what the sea's own waves cede to the trains that know its
// floor and what land takes of them, and the foam where waves break, both 0 outside the maps.
struct Surf {
  V ceded, foam;
  hn::Mask<D> has_trains;  // in the trains' map
  hn::Mask<D> inside;      // in any
  bool is_near;            // any lane inside
  bool all_ceded;          // no lane has anything of the sea's long waves
};

HWY_INLINE void SampleTrains(const Water& water, V3 p, V level_m, Surf& surf) {
  const SlopeLayer& layer = water.coast_surf;
  const LayerPlace place = PlaceIn(layer, p.x, p.y);
  surf.has_trains = surf.inside = IsInside(layer, place);
  if (hn::AllFalse(D(), surf.inside)) return;
  SampleNearest(layer, place, hn::Sub(level_m, Constant(0.5f)), surf.ceded, surf.foam);
  // All but half a step is all.
  surf.ceded = hn::IfThenElse(hn::Gt(surf.ceded, Constant(0.996f)), Constant(1.0f), surf.ceded);
  surf.ceded = hn::IfThenElseZero(surf.inside, surf.ceded);
  surf.foam = hn::IfThenElseZero(surf.inside, surf.foam);
}

HWY_INLINE Surf SampleSurf(const Water& water, V3 p, V level_m) {
  const D d;
  const V zero = hn::Zero(d), one = Constant(1.0f);
  const auto none = hn::MaskFromVec(zero);
  Surf surf = {zero, zero, none, none, false, false};
  if (water.has_coast) SampleTrains(water, p, level_m, surf);
  if (water.near_shore.map.map) {
    const NearShoreAt shore = SampleNearShore(water.near_shore, p, level_m);
    // What trains leave: they are the waves, where there are some.
    const V left = hn::Sub(one, surf.ceded);
    surf.foam = hn::MulAdd(shore.foam, left, surf.foam);
    surf.ceded = hn::MulAdd(shore.taken, left, surf.ceded);
    surf.inside = hn::Or(surf.inside, shore.inside);
  }
  surf.is_near = !hn::AllFalse(d, surf.inside);
  surf.all_ceded = surf.is_near && hn::AllTrue(d, hn::Ge(surf.ceded, one));
  return surf;
}

// Near a coast the longest waves make room for the trains that know its floor: their slopes keep
// 1 - ceded, their variance its square.
HWY_INLINE void BlendCoast(const Water& water, V3 p, V level_m, const Surf& surf, WaterSlopes& s) {
  const D d;
  const V kept = hn::Sub(Constant(1.0f), surf.ceded);
  const V long_variance = hn::Sub(s.variance, Constant(water.base_variance));
  s.slope_x = hn::NegMulAdd(s.slope_x, surf.ceded, s.slope_x);
  s.slope_y = hn::NegMulAdd(s.slope_y, surf.ceded, s.slope_y);
  const V blended = hn::MulAdd(long_variance, hn::Mul(kept, kept), Constant(water.base_variance));
  // Not rounded outside: a packet with no lane inside does not come by here.
  s.variance = hn::IfThenElse(surf.inside, blended, s.variance);
  if (hn::AllFalse(d, surf.has_trains)) return;
  V x = hn::Zero(d), y = hn::Zero(d), lost = hn::Zero(d);
  AddSlopes(water.coast_slopes, p, level_m, x, y, x, y, lost);
  s.slope_x = hn::Add(s.slope_x, hn::IfThenElseZero(surf.has_trains, x));
  s.slope_y = hn::Add(s.slope_y, hn::IfThenElseZero(surf.has_trains, y));
  s.variance = hn::Add(s.variance, hn::IfThenElseZero(surf.has_trains, lost));
}

constexpr float kMinCos = 0.02f;

// The area that waves of these slopes turn to the eye, over the level's.
HWY_INLINE V CosineOfSlopes(const Packet& packet, const WaterSlopes& s) {
  return hn::NegMulAdd(s.slope_x, packet.to_eye.x,
                       hn::NegMulAdd(s.slope_y, packet.to_eye.y, packet.to_eye.z));
}

// How Perlin noise bends the coordinates of the ripples.
template <bool kCoast>
HWY_INLINE void BendRipples(const Water& water, V3 p, V level_m, V& du, V& dv) {
  V unused = hn::Zero(D());
  // In scenes with surf nobody sees the step between two levels of the noise.
  if (kCoast && water.has_coast)
    NearestSlopes(water.uv_noise, p, level_m, du, dv);
  else
    AddSlopes(water.uv_noise, p, level_m, du, dv, du, dv, unused);
}

// What disturbs the water: slopes on those that there are, and foam, torn as whitecaps are.
HWY_INLINE void AddWakes(const Water& water, V3 p, V level_m, WaterSlopes& s) {
  const WakesAt at = SampleWakes(water.wakes, p, level_m);
  if (!at.is_near) return;
  s.slope_x = hn::Add(s.slope_x, at.slope_x);
  s.slope_y = hn::Add(s.slope_y, at.slope_y);
  s.variance = hn::Add(s.variance, at.variance);
  s.fine_variance = hn::Add(s.fine_variance, at.variance);
  const V slope2 = hn::MulAdd(at.slope_x, at.slope_x, hn::Mul(at.slope_y, at.slope_y));
  s.wake =
      hn::Max(hn::Mul(slope2, Constant(1.0f / (0.02f * 0.02f))), hn::Mul(at.foam, Constant(10.0f)));
  const TornFoam foam = TearWhitecaps(water.wakes.foam, p, level_m, at.foam);
  s.foam_cover = hn::Max(s.foam_cover, foam.cover);
  s.foam_thickness = hn::Max(s.foam_thickness, foam.thickness);
  s.foam_bubbles = hn::Max(s.foam_bubbles, foam.bubbles);
}

// Slopes from the sines, the wave patches and the scrolling bump layers, whose coordinates noise
// bends where the longest of them are seen. How steeply the eye meets the long waves decides how
// long a pixel's footprint is on the shorter ones. A layer waits for the longer ones: packets side
// by side hide that.
template <bool kCoast, std::size_t kCount>
HWY_INLINE std::array<WaterSlopes, kCount> SampleWater(const Water& water, const ViewRays& rays,
                                                       const std::array<Packet, kCount>& packets) {
  const D d;
  const V zero = hn::Zero(d);
  std::array<V, kCount> across, level_flat_m, level_m, du, dv;
  std::array<Surf, kCount> surf;
  std::array<WaterSlopes, kCount> s;
  for (std::size_t k = 0; k < kCount; ++k) {
    across[k] = FootprintAcross(rays, packets[k]);
    level_flat_m[k] = FootprintLevel(across[k], Clamp(packets[k].to_eye.z, kMinCos, 1.0f));
    level_m[k] = level_flat_m[k];
    surf[k] = {zero, zero, hn::MaskFromVec(zero), hn::MaskFromVec(zero), false, false};
    if constexpr (kCoast) surf[k] = SampleSurf(water, packets[k].p, level_flat_m[k]);
    s[k] = NoSlopes(Constant(water.base_variance), zero, packets[k].to_eye.z);
    du[k] = dv[k] = zero;
  }
  for (int i = 0; i < water.sine_count; ++i)
    for (std::size_t k = 0; k < kCount; ++k)
      AddSine(water.sines[static_cast<std::size_t>(i)], packets[k].p, level_m[k], s[k]);
  bool all_ceded = kCoast;
  if constexpr (kCoast)
    for (std::size_t k = 0; k < kCount; ++k) all_ceded = all_ceded && surf[k].all_ceded;
  const bool has_patch = water.first_ripples > 0;
  if (has_patch && !all_ceded) {
    const FoamMap* const long_foam = water.whitecaps.count > 0 ? &water.whitecaps.foam[0] : nullptr;
    std::array<V, kCount> foam;
    for (std::size_t k = 0; k < kCount; ++k)
      foam[k] = AddLongestPatch(water.layers[0], long_foam, packets[k].p, level_flat_m[k],
                                s[k].slope_x, s[k].slope_y, s[k].variance);
    for (std::size_t k = 0; k < kCount; ++k)
      foam[k] = WhitecapsAt(water.whitecaps, foam[k], packets[k].p,
                            hn::Add(packets[k].p.z, Constant(rays.eye_z)), level_flat_m[k],
                            surf[k].ceded);
    for (std::size_t k = 0; k < kCount; ++k)
      SetFoam(TearWhitecaps(water.whitecaps, packets[k].p, level_flat_m[k], foam[k]), s[k]);
  }
  if constexpr (kCoast)
    for (std::size_t k = 0; k < kCount; ++k)
      AddFoamOver(FoamOver(water.foam, packets[k].p, level_flat_m[k], surf[k].foam), s[k]);
  // Without patches the sines alone are the long waves: the loop then begins before the first
  // layer. (One loop with AddSlopes in it once: two take 4 % longer.)
  const int last_long = water.long_layer_count - 1;
  for (int i = std::min(last_long, 0); i < water.layer_count; ++i) {
    const bool is_long = i <= last_long;
    if (i == water.first_ripples) {
      bool shows = false;
      for (std::size_t k = 0; k < kCount; ++k)
        shows = shows || ShowsDetail(water.layers[i], level_m[k]);
      if (shows)
        for (std::size_t k = 0; k < kCount; ++k)
          BendRipples<kCoast>(water, packets[k].p, level_m[k], du[k], dv[k]);
    }
    if (i >= (has_patch ? 1 : 0) && !(is_long && all_ceded)) {
      const SlopeLayer& layer = water.layers[static_cast<std::size_t>(i)];
      for (std::size_t k = 0; k < kCount; ++k)
        AddSlopes(layer, packets[k].p, level_m[k], du[k], dv[k], s[k].slope_x, s[k].slope_y,
                  s[k].variance);
    }
    if (!is_long) continue;
    for (std::size_t k = 0; k < kCount; ++k) {
      if (kCoast && surf[k].is_near && i == last_long)
        BlendCoast(water, packets[k].p, level_flat_m[k], surf[k], s[k]);
      s[k].long_cosine = CosineOfSlopes(packets[k], s[k]);
      // The normal's length is left out: it is near 1, and a level needs no better.
      level_m[k] = FootprintLevel(across[k], Clamp(s[k].long_cosine, kMinCos, 1.0f));
      s[k].fine_variance = hn::Add(s[k].variance, Constant(water.short_variance));
    }
  }
  if (water.wakes.count > 0)
    for (std::size_t k = 0; k < kCount; ++k) AddWakes(water, packets[k].p, level_flat_m[k], s[k]);
  return s;
}

// What a lookup image shows at a place, and what part of the place it fills.
struct Looked {
  V3 light;
  V alpha;
};

// Looks a lookup image up at a window position, on a level of it. Samples beside nothing are no
// darker: only their alpha is less.
HWY_INLINE Looked LookUpAt(const LookupImage& lookup, V x_px, V y_px, const BlurLevel& level) {
  const D d;
  const V one = Constant(1.0f);
  const V x = hn::Mul(x_px, Constant(lookup.scale_x)), y = hn::Mul(y_px, Constant(lookup.scale_y));
  V3 code;
  V alpha;
  SampleBlurred(*lookup.image, x, y, level, code, alpha);
  const auto some = hn::Gt(alpha, hn::Zero(d));
  if (hn::AllFalse(d, some)) return {Constant(glm::vec3(0.0f)), alpha};
  // Codes that were blended with zeros.
  if (!hn::AllFalse(d, hn::And(some, hn::Lt(alpha, one))))
    code = Scale(code, hn::Div(one, hn::Max(alpha, Constant(1.0f / 512.0f))));
  return {DecodeLight(code), alpha};
}

// What `front` leaves of a place shows `behind`.
HWY_INLINE Looked LayOver(const Looked& front, const Looked& behind) {
  const V shown = hn::Mul(hn::Sub(Constant(1.0f), front.alpha), behind.alpha);
  const V alpha = hn::Add(front.alpha, shown);
  const V part = hn::Div(shown, hn::Max(alpha, Constant(1.0f / 512.0f)));
  return {Lerp(front.light, behind.light, part), alpha};
}

// Looks a lookup image up at the pixel's own window position, moved by the slopes (spec: distortion
// tied to the bump, fading where the surface is seen edge-on so that far, small things hold
// together). Where kBacked, what is not found there is looked up at the pixel's own position.
template <bool kBacked>
HWY_INLINE Looked LookUpDistorted(const Water& water, const LookupImage& lookup,
                                  const Packet& packet, const WaterSlopes& s, float sign) {
  const D d;
  const V right = hn::MulAdd(s.slope_x, Constant(water.view_right.x),
                             hn::Mul(s.slope_y, Constant(water.view_right.y)));
  const V ahead = hn::MulAdd(s.slope_x, Constant(water.view_ahead.x),
                             hn::Mul(s.slope_y, Constant(water.view_ahead.y)));
  const V gain = hn::Mul(Constant(sign * water.distortion_px),
                         Clamp(hn::Mul(packet.to_eye.z, Constant(water.distortion_by_sine)),
                               water.least_distortion, 1.0f));
  // What lies under water is near the surface: slopes too fine to see move it by less than they
  // spread it.
  const BlurLevel level = kBacked ? Sharp() : FindBlur(lookup, s.variance, hn::Mul(gain, gain));
  const float bound = water.max_distortion_px;
  const V dx = Clamp(hn::Mul(right, hn::Mul(gain, Constant(-0.5f))), -bound, bound);
  const V dy = Clamp(hn::Mul(ahead, gain), -bound, bound);
  const V half = Constant(0.5f);
  const V x = hn::Add(packet.x_px, half), y = hn::Add(packet.y_px, half);
  const Looked moved = LookUpAt(lookup, hn::Add(x, dx), hn::Add(y, dy), level);
  const bool found = hn::AllTrue(d, hn::Ge(moved.alpha, Constant(1.0f)));
  return !kBacked || found ? moved : LayOver(moved, LookUpAt(lookup, x, y, level));
}

// The part of the facets seen that mirror the sea again, not the sky. The mean slopes send the ray
// to r_z, and slopes that a pixel cannot resolve spread it by 2 sigma, sigma^2 = variance / 2; the
// blend is 1.4 times as wide as that normal distribution, or dark lines would show on fine waves.
// Of the facets that throw rays down, the fewer are turned to the eye the lower it is: a part that
// grows with to_eye_z^2 / (8 sigma^2), and on back sides with r_z^2. Root mean square error against
// the facets themselves 0.06; in the mean over waves at most 0.06 too much.
HWY_INLINE V PartOfSeaMirrored(V r_z, V to_eye_z, V inv_variance) {
  const V zero = hn::Zero(D()), one = Constant(1.0f);
  const V scale = hn::Mul(inv_variance, Constant(0.125f));
  const V r_z2 = hn::Mul(r_z, hn::Abs(r_z));
  const V turn = Clamp(hn::Mul(r_z2, scale), -1.0f, 1.0f);
  const V up = hn::Mul(turn, hn::Sub(Constant(2.0f), hn::Abs(turn)));  // in [-1, 1]
  const V down = hn::NegMulAdd(up, Constant(0.5f), Constant(0.5f));
  const V low2 = hn::MulAdd(hn::Min(r_z2, zero), Constant(-0.125f), hn::Mul(to_eye_z, to_eye_z));
  const V hidden = hn::Max(hn::NegMulAdd(low2, scale, one), zero);
  return hn::Mul(down, hn::NegMulAdd(hidden, hidden, one));
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
    if (water.seen_slopes > 0.0f) {
      const V drawn =
          hn::Max(hn::Sub(Constant(1.0f), hn::Div(s.variance, s.fine_variance)), hn::Zero(d));
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
  const V radius = hn::Sqrt(
      hn::MulAdd(hn::Max(variance, hn::Zero(D())), Constant(16.0f), Constant(least * least)));
  return StarLight(stars, Scale(r, hn::Div(Constant(1.0f), length)), radius);
}

// What the surface mirrors: the sky in the reflected direction, the sea where that points below the
// horizon that waves make, brighter by what its floor adds here, and in front of both whatever the
// reflection image shows there, whose part is `image_alpha`.
HWY_INLINE V3 ReflectedLight(const Light& light, const Water& water, const Packet& packet,
                             const WaterSlopes& s, const Facing& f, V inv_variance, V3 floor,
                             bool use_image, V& image_alpha) {
  const V horizon = Constant(water.wave_horizon);
  const V r_z = hn::MulSub(hn::Add(f.cos_eye, f.cos_eye), f.normal.z, packet.to_eye.z);
  const V sea =
      PartOfSeaMirrored(hn::Sub(r_z, horizon), hn::Add(packet.to_eye.z, horizon), inv_variance);
  V3 r = ScaleAdd(f.normal, hn::Add(f.cos_mirror, f.cos_mirror),
                  Scale(packet.to_eye, Constant(-1.0f)));
  // Outside its circle the map goes on as at the horizon.
  r.z = hn::Max(r.z, Constant(-0.25f));
  const V length = hn::Sqrt(Dot(r, r));
  V3 mirrored = SoftSkyRadiance(*light.sky_soft, r, length);
  if (light.stars.on)
    mirrored = Sum(mirrored, MirroredStars(light.stars, r, length,
                                           hn::Sub(s.variance, Constant(water.base_variance))));
  const V3 mirrored_sea =
      ScaleAdd(floor, Constant(water.mirrored_floor_part), Constant(water.mirrored_sea));
  mirrored = Lerp(mirrored, mirrored_sea, sea);
  image_alpha = hn::Zero(D());
  if (use_image) {
    const Looked image = LookUpDistorted<false>(water, water.reflection, packet, s, 1.0f);
    image_alpha = image.alpha;
    mirrored = Lerp(mirrored, image.light, image_alpha);
  }
  return mirrored;
}

// What comes up through the surface: scattered light of the water body, which comes in from around
// and so is never quite in the shade, brighter in thin crests against the sun, and the floor where
// the refraction image shows one, whose part is `image_alpha`; `floor_added` is what that changes.
HWY_INLINE V3 RefractedLight(const Shading& shading, const Water& water, const Packet& packet,
                             const WaterSlopes& s, V sun_visible, bool use_image, V& image_alpha,
                             V3& floor_added) {
  // Far triangles cut off some of the earth's curve: that is no trough.
  const V share =
      Clamp(hn::NegMulAdd(packet.distance, Constant(kWaveShareFall * water.inv_wave_reach),
                          Constant(kWaveShareAtEye)),
            0.0f, 1.0f);
  const V height = hn::Mul(share, hn::Add(packet.p.z, Constant(shading.rays.eye_z)));
  const V crest =
      Clamp(hn::MulAdd(height, Constant(water.inv_crest_height), Constant(0.4f)), 0.0f, 1.5f);
  const V towards_sun = hn::Max(
      hn::Neg(hn::MulAdd(packet.to_eye.x, Constant(shading.light.sun_direction.x),
                         hn::Mul(packet.to_eye.y, Constant(shading.light.sun_direction.y)))),
      hn::Zero(D()));
  const V glow =
      hn::Mul(hn::Mul(crest, crest), hn::MulAdd(towards_sun, sun_visible, Constant(0.35f)));
  const V shade = hn::MulSub(sun_visible, Constant(0.6f), Constant(0.6f));
  const V3 crest_light = Scale(Constant(water.crest_glow), glow);
  V3 deep = Sum(crest_light,
                ScaleAdd(Constant(shading.media.body_sun), shade, Constant(shading.media.body)));
  if (water.bump_detail.map)
    deep = Scale(deep, BumpLight(shading, water.bump_detail, packet, NormalOf(s.slope_x, s.slope_y),
                                 sun_visible));
  image_alpha = hn::Zero(D());
  floor_added = Constant(glm::vec3(0.0f));
  if (!use_image) return deep;
  const Looked floor = LookUpDistorted<true>(water, water.refraction, packet, s, -0.5f);
  image_alpha = floor.alpha;
  // The image's water has no crests: over a floor too deep to be seen it must be as without one.
  floor_added = Scale(Difference(Sum(floor.light, crest_light), deep), image_alpha);
  return Sum(deep, floor_added);
}

// What a facet that mirrors the sun to the eye reflects; `half` is the sum of their directions.
struct GlintReflectance {
  const Media& media;
  HWY_INLINE V operator()(V3 half) const {
    return FresnelReflectance(D(), hn::Mul(hn::Sqrt(Dot(half, half)), Constant(0.5f)),
                              media.refraction_index);
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
  const V3 half = Sum(packet.to_eye, Constant(sun_direction));
  // The three quotients' denominators share one division.
  const V z = hn::Max(half.z, Constant(1e-3f));
  const V cos4 = hn::Mul(Constant(4.0f), hn::Max(area, Constant(kMinCos)));
  const V z_cos4 = hn::Mul(z, cos4);
  const V inverse = hn::Div(Constant(1.0f), hn::Mul(z_cos4, s.variance));
  inv_variance = hn::Mul(inverse, z_cos4);  // = 1 / (2 sigma^2) per axis
  const V inverse_z_cos4 = hn::Mul(inverse, s.variance);
  const V inv_z = hn::Mul(inverse_z_cos4, cos4), inv_cos4 = hn::Mul(inverse_z_cos4, z);

  const V dx = hn::MulAdd(half.x, inv_z, s.slope_x);  // half-way slope is -half.xy / half.z
  const V dy = hn::MulAdd(half.y, inv_z, s.slope_y);
  const V exponent = hn::Mul(hn::MulAdd(dx, dx, hn::Mul(dy, dy)), hn::Neg(inv_variance));
  const auto on_path = hn::Gt(exponent, Constant(-50.0f));
  if (hn::AllFalse(D(), on_path)) return hn::Zero(D());
  const V density = hn::IfThenElseZero(
      on_path, hn::Mul(Exp(D(), exponent), hn::Mul(inv_variance, Constant(0.318309886f))));
  const V inv_cos2 = hn::Mul(Dot(half, half), hn::Mul(inv_z, inv_z));
  const V scale = hn::Mul(hn::Mul(inv_cos2, inv_cos2), inv_cos4);
  return hn::Mul(hn::Mul(reflectance(half), density), scale);
}

// Bits of Label::kFlags, as a number: images that hide more than half of what else is seen, wakes.
HWY_INLINE V FlagsOf(V mirrored_alpha, V refracted_alpha, V wake) {
  const auto bit = [](V alpha, std::uint32_t value) HWY_ATTR {
    return hn::IfThenElseZero(hn::Gt(alpha, Constant(0.5f)), Constant(static_cast<float>(value)));
  };
  return hn::Add(
      hn::Add(bit(mirrored_alpha, kShowsMirrored), bit(refracted_alpha, kShowsRefracted)),
      bit(hn::Mul(wake, Constant(0.5f)), kShowsWake));
}

// kCoast: water.knows_land().
template <bool kCoast>
struct WaterShader {
  static constexpr std::size_t kPacketsAtOnce = SWELL_WATER_PACKETS_AT_ONCE;
  const Water& water;

  template <std::size_t kCount>
  HWY_INLINE std::array<WaterSlopes, kCount> LookUp(
      const Shading& shading, const std::array<Packet, kCount>& packets) const {
    return SampleWater<kCoast>(water, shading.rays, packets);
  }

  HWY_INLINE Surfel operator()(const Shading& shading, const TilePixels& tile, const Lanes&,
                               const Packet& packet, const WaterSlopes& s) const {
    const Light& light = shading.light;
    const Facing f = FaceEye(shading.media, water, packet, s);

    const V sun_visible = SunOnSea(shading, tile, packet);
    V inv_variance, mirrored_alpha, refracted_alpha;
    V sun_path = SunGlint(light.sun_direction, packet, s, GlintReflectance{shading.media}, f.area,
                          inv_variance);
    V3 floor;
    V3 refracted = RefractedLight(shading, water, packet, s, sun_visible, tile.lookups.refraction,
                                  refracted_alpha, floor);
    const V3 mirrored = ReflectedLight(light, water, packet, s, f, inv_variance, floor,
                                       tile.lookups.reflection, mirrored_alpha);
    TornFoam foam = {s.foam_cover, s.foam_thickness, s.foam_bubbles};
    if (!tile.casters.empty()) {
      const V level_m = FootprintLevel(FootprintAcross(shading.rays, packet),
                                       Clamp(packet.to_eye.z, kMinCos, 1.0f));
      const AtHulls hulls = SampleHulls(shading.sun_shadow, water.hull_foam, tile.casters,
                                        SpanOf(packet), packet.p, level_m);
      refracted = Scale(refracted, hn::Sub(Constant(1.0f), hulls.sky_hidden));
      foam.cover = hn::Max(foam.cover, hulls.foam_cover);
      // Fresh, and so thick.
      const auto splashed = hn::Gt(hulls.foam_cover, hn::Zero(D()));
      foam.thickness = hn::IfThenElse(splashed, Constant(1.0f), foam.thickness);
    }
    const V weight =
        water.reflection_weight < 0.0f ? f.reflectance : Constant(water.reflection_weight);
    const V3 arriving = Lerp(refracted, mirrored, weight);
    if (water.glitter.slide)
      sun_path =
          hn::Mul(f.reflectance, ThrownGlitter(water.glitter, packet.to_eye, f.normal, s.variance));
    V3 seen = ScaleAdd(Constant(water.glitter_light), hn::Mul(sun_path, sun_visible), arriving);
    seen = AddWhitecaps(water.whitecaps, foam, light.sun_direction, sun_visible, f.normal, seen);
    return {seen, f.normal, foam.cover, FlagsOf(mirrored_alpha, refracted_alpha, s.wake)};
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
