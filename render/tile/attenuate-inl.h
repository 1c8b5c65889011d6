// What the medium between a surface and the eye does to light: once for all materials.
#if defined(SWELL_RENDER_TILE_ATTENUATE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_ATTENUATE_INL_H_
#undef SWELL_RENDER_TILE_ATTENUATE_INL_H_
#else
#define SWELL_RENDER_TILE_ATTENUATE_INL_H_
#endif

#include <algorithm>

#include "render/tile/fog-inl.h"
#include "render/tile/packet-inl.h"
#include "render/tile/sky_map-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// The mean density of haze on the way to what a packet shows, against that at sea level, for one
// over the height H. At the height h over the sea it is 1 / (1 + h / H)^2, much like exp(-h / H)
// and of the same amount in all, because between places of heights a H and b H on a straight line
// the mean of that is 1 / ((1 + a) (1 + b)): no exponential, and no difference of almost equal
// ones. The way is taken as two such lines, which meet where its middle lies over a round earth.
HWY_INLINE V MeanHaze(const Shading& s, const Packet& shown, float per_m) {
  const float eye_z = s.rays.eye_z;
  const V one = Constant(1.0f);
  const V eye = Constant(1.0f + std::max(eye_z, 0.0f) * per_m);
  // Mirrored things lie below the level.
  const V height = Abs(shown.p.z + eye_z);
  const V place = MulAdd(height, per_m, one);
  const V both = eye + place;
  const V r2 = MulAdd(shown.p.x, shown.p.x, shown.p.y * shown.p.y);
  const V sagging = r2 * (0.25f * s.rays.drop_per_m2 * per_m);
  const V middle = Max(MulSub(both, 0.5f, sagging), one);
  return both * 0.5f / (eye * place * middle);
}

// Molecules thin with height as exp(-h / 8 km) does, which 10 km in MeanHaze()'s law are closest
// to.
constexpr float kPerMoleculesHeight_m = 1e-4f;

// What of the air below an eye far over the sea depends on the direction alone.
struct AirAhead {
  V3 below;  // AirBelow()
  V steep;   // how much of haze's colour is the horizon's mean
};

// In a direction of length 1 as the eye has it.
HWY_INLINE AirAhead FindAirAhead(const Light& light, V3 direction) {
  const V down = PartDown(light, direction.z);
  const V level2 = NegMulAdd(down, down, 1.0f), level4 = level2 * level2;
  const V level8 = level4 * level4;
  return {AirBelow(light, direction, down), NegMulAdd(level8, level8, 1.0f)};
}

// The air below an eye far over the sea: haze, and the molecules beyond those that the haze stands
// for. Near the horizon both have the sky's colour there; further down the molecules have that of
// the air below, and haze the mean of the horizon, as under an overcast sky all air has. Of the
// packet, place and distance count. ahead(): asked for where there is any.
template <class Ahead>
HWY_INLINE V3 ThroughAerialPerspective(const Shading& s, const Packet& packet, V3 colour, V length,
                                       const Ahead& ahead) {
  const D d;
  const V zero = hn::Zero(d);
  const V mean_haze = MeanHaze(s, packet, s.media.inv_haze_height_m);
  const V mean_air = MeanHaze(s, packet, kPerMoleculesHeight_m);
  const V haze = length * mean_haze * s.media.inv_haze_m;
  const V air = length * Max(mean_air - mean_haze, zero);
  const glm::vec3 molecules = s.media.molecules_per_m;
  const auto amount = [&](float per_m) HWY_ATTR {
    const V clear = Exp(d, -MulAdd(air, per_m, haze));
    return Max(1.0f - 1.0f / 512.0f - clear, zero);
  };
  const V blue = amount(molecules.z);
  if (hn::AllFalse(d, blue > zero)) return colour;

  const AirAhead seen = ahead();
  const V all = MulAdd(air, molecules.y, Max(haze, 1e-6f));
  const V white = Max(seen.steep * (haze / all), s.media.cloudy);
  const V3 light = Lerp(seen.below, Constant(s.light.horizon), white);
  return {Lerp(colour.x, light.x, amount(molecules.x)),
          Lerp(colour.y, light.y, amount(molecules.y)), Lerp(colour.z, light.z, blue)};
}

// `packet` is a copy: by reference a call would keep all packets in memory.
static HWY_NOINLINE V3 AerialPerspective(const Shading& s, Packet packet, V3 colour, V length) {
  // The direction as the eye has it; to_eye is the place's.
  const V3 p = packet.p;
  const V r2 = MulAdd(p.x, p.x, p.y * p.y);
  const V z = NegMulAdd(r2, s.rays.drop_per_m2, p.z) / packet.distance;
  const V3 direction = {-packet.to_eye.x, -packet.to_eye.y, z};
  return ThroughAerialPerspective(s, packet, colour, length,
                                  [&]() HWY_ATTR { return FindAirAhead(s.light, direction); });
}

// Blends towards the horizon's colour with distance, so that no edge of the sea shows. Haze of less
// than half a step of the picture is left out: near packets then need no lookup. Straight down
// there is no azimuth to look up: the steeper the view, the more the mean of the horizon takes
// over. The haze is that of `length` of the way.
HWY_INLINE V3 Haze(const Shading& s, const Packet& packet, V3 colour, V length) {
  const D d;
  if (s.media.molecules_per_m.z > 0.0f) return AerialPerspective(s, packet, colour, length);
  const V depth = length * -s.media.inv_haze_m * MeanHaze(s, packet, s.media.inv_haze_height_m);
  const V clear = Exp(d, depth);
  const V amount = Max(1.0f - 1.0f / 512.0f - clear, 0.0f);
  if (hn::AllFalse(d, amount > 0.0f)) return colour;
  const V x = -packet.to_eye.x, y = -packet.to_eye.y;
  const V horizontal2 = Max(MulAdd(x, x, y * y), 1e-12f);
  const V3 ahead = SoftSkyRadiance(*s.light.haze_sky, {x, y, hn::Zero(d)}, Sqrt(horizontal2));
  const V level4 = horizontal2 * horizontal2, level8 = level4 * level4;
  const V steep = NegMulAdd(level8, level8, 1.0f);
  return Lerp(colour, Lerp(ahead, Constant(s.light.horizon), steep), amount);
}

HWY_INLINE V3 Haze(const Shading& s, const Packet& packet, V3 colour) {
  return Haze(s, packet, colour, packet.distance);
}

// Haze, and fog in front of it, where an eye over the fog has more haze before both. In a slab fog
// takes haze's place. packet_of(): what the ray ends at, asked for where there is haze.
// haze_before(colour, length): lays the haze before the fog.
template <class PacketOf, class HazeBefore>
HWY_INLINE V3 HazeAndFog(const Shading& s, const FogRay& ray, V phase, V3 colour,
                         const PacketOf& packet_of, const HazeBefore& haze_before) {
  const D d;
  const V zero = hn::Zero(d);
  const Fog& fog = s.media.fog;
  const FogPath path = PathTo(fog, ray);
  const FogView view = SeeFog(fog, ray, path, phase);
  V behind = ray.distance - path.before;
  if (!fog.is_exponential) behind = NegMulAdd(path.amount, fog.takes_haze, behind);
  // What fog hides has no haze.
  const V seen = Max(view.passes.x, Max(view.passes.y, view.passes.z));
  behind = IfThenElseZero(seen >= 1.0f / 512.0f, behind);
  if (!hn::AllFalse(d, behind > zero)) colour = Haze(s, packet_of(), colour, behind);
  colour = ThroughFog(view, colour);
  return hn::AllTrue(d, path.before == zero) ? colour : haze_before(colour, path.before);
}

template <class PacketOf>
HWY_INLINE V3 HazeAndFog(const Shading& s, const FogRay& ray, V phase, V3 colour,
                         const PacketOf& packet_of) {
  return HazeAndFog(s, ray, phase, colour, packet_of, [&](V3 light, V length) HWY_ATTR {
    return Haze(s, packet_of(), light, length);
  });
}

// Whether rays of this view may meet air before they meet fog, and what this air shows depends on
// the direction alone.
HWY_INLINE bool IsFogSeenFromAbove(const Shading& s) {
  const Fog& fog = s.media.fog;
  const float reaches_m = fog.is_exponential ? 2.0f * fog.top_m : fog.top_m;
  return fog.on && s.media.molecules_per_m.z > 0.0f && fog.at_eye.height_m > reaches_m;
}

// All of the air between the eye and what a packet shows. A function of its own: few call it.
static HWY_NOINLINE V3 ThroughAirAndFog(const Shading& s, Packet packet, V3 colour) {
  const Fog& fog = s.media.fog;
  const V3 p = packet.p;
  const V r2 = MulAdd(p.x, p.x, p.y * p.y);
  const V length = Max(packet.distance, 1e-3f);
  const V rise = NegMulAdd(r2, s.rays.drop_per_m2, p.z) / length;
  const FogRay ray = {
      fog.at_eye, {-packet.to_eye.x, -packet.to_eye.y, rise}, packet.distance, p.z + s.rays.eye_z};
  return HazeAndFog(s, ray, FogPhase(fog, ray.direction), colour,
                    [&]() HWY_ATTR -> const Packet& { return packet; });
}

HWY_INLINE V3 ThroughAir(const Shading& s, const Packet& packet, V3 colour) {
  return s.media.fog.on ? ThroughAirAndFog(s, packet, colour) : Haze(s, packet, colour);
}

HWY_INLINE V3 Where(hn::Mask<D> mask, V3 yes, V3 no) {
  return {IfThenElse(mask, yes.x, no.x), IfThenElse(mask, yes.y, no.y),
          IfThenElse(mask, yes.z, no.z)};
}

// The sky through fog. An eye over the fog sees it under the sky through as much haze as the sea
// there.
[[maybe_unused]] static HWY_NOINLINE V3 SkyThroughAir(const Shading& s, V3 direction, V3 light) {
  const Fog& fog = s.media.fog;
  if (fog.is_exponential || fog.at_eye.above_m > 0.0f)
    return ThroughFog(SkyFog(fog, fog.at_eye, direction, kPlacesBeforeSky), light);
  const FogRay ray = {fog.at_eye, direction, Constant(kEndless_m), Constant(kEndless_m)};
  const FogPath path = PathInSlab(fog, ray);
  const auto meets = path.amount > 0.0f;
  if (hn::AllFalse(D(), meets)) return light;
  const V3 p = direction * path.before;
  const V r2 = MulAdd(p.x, p.x, p.y * p.y);
  Packet top;
  top.x_px = top.y_px = top.depth = hn::Zero(D());
  top.p = {p.x, p.y, MulAdd(r2, s.rays.drop_per_m2, p.z)};
  top.distance = path.before;
  top.to_eye = -direction;
  const V3 foggy = ThroughFog(SeeFog(fog, ray, path), light);
  return Where(meets, Haze(s, top, foggy), light);
}

// Fog on a way that begins at the sea, up to a height, and ends at a place.
static HWY_NOINLINE V3 FogFromSea(const Shading& s, V3 direction, V distance, V height, V3 place,
                                  V3 colour) {
  const Fog& fog = s.media.fog;
  const V length = Max(distance, 1e-3f), up = Max(height, 0.0f);
  direction.z = Min(up / length, 1.0f);
  const FogRay ray = {fog.at_sea,
                      direction,
                      distance,
                      up,
                      NegMulAdd(direction.x, distance, place.x),
                      NegMulAdd(direction.y, distance, place.y)};
  return ThroughFog(SeeFog(fog, ray, PathTo(fog, ray)), colour);
}

// paper_depth_ratio() of the angle whose cosine in air this is, at least 0.02; the angle is right
// to 7e-5. Source: Abramowitz, Stegun, Handbook of Mathematical Functions, 1964, 4.4.45.
HWY_INLINE V PaperDepthRatio(V cosine) {
  V acos = MulAdd(cosine, -0.0187293f, 0.0742610f);
  acos = MulAdd(cosine, acos, -0.2121144f);
  acos = MulAdd(cosine, acos, 1.5707288f);
  const V rest = Max(1.0f - cosine, 0.0f);
  const V angle = acos * Sqrt(rest);
  const V steep = NegMulAdd(angle, 0.16f, 0.75f);
  const V flat = NegMulAdd(angle, 0.8f, 1.26f);
  return IfThenElse(angle <= 0.8f, steep, flat);
}

// Light's way through water to something at a depth.
struct WaterPath {
  V depth;   // true, of a thing that is seen at the apparent one [m]
  V length;  // down from the sun and up to the surface [m]
};

HWY_INLINE WaterPath PathThroughWater(const Media& media, const Packet& packet, V apparent) {
  const V cos_eye = Max(packet.to_eye.z, 0.02f);
  const float inv_n = 1.0f / media.refraction_index;
  // cos of the refracted ray; apparent depth / true depth k = (1/n) cos / cos_t.
  const V sin_t = Sqrt(Max(NegMulAdd(cos_eye, cos_eye, 1.0f), 0.0f)) * inv_n;
  const V cos_t = Sqrt(NegMulAdd(sin_t, sin_t, 1.0f));
  const V depth = media.paper_refraction ? apparent / PaperDepthRatio(cos_eye)
                                         : apparent * (cos_t * media.refraction_index / cos_eye);
  const V path_up = Min(depth / cos_t, 200.0f);
  return {depth, MulAdd(depth, kDaylightSlant, path_up)};  // sunlight comes down at a slant
}

// Light is lost on its way, and the water body's takes its place (Beer-Lambert).
HWY_INLINE V3 AbsorbInWater(const Media& media, const WaterPath& path, V3 light) {
  const D d;
  const glm::vec3 absorption = media.absorption_per_m;
  const auto lost = [&](float per_m, V body, V seen) {
    const V through = Exp(d, path.length * -per_m);
    return Lerp(body, seen, through);
  };
  return {lost(absorption.x, Constant(media.body.x), light.x),
          lost(absorption.y, Constant(media.body.y), light.y),
          lost(absorption.z, Constant(media.body.z), light.z)};
}

// Whether what a view shows lies in water.
template <ViewKind kView>
HWY_INLINE bool ShowsWaterSide(const Media& media) {
  return (kView == ViewKind::kRefraction) != media.submerged;
}

// (1 - e^-x) / x, given e^-x.
HWY_INLINE V LossOver(V x, V e) {
  const V one = Constant(1.0f);
  const V exact = (one - e) / x;
  // Near 0 the difference has no digits left.
  V series = NegMulAdd(x, 1.0f / 24.0f, 1.0f / 6.0f);
  series = NegMulAdd(NegMulAdd(x, series, 0.5f), x, one);
  return IfThenElse(Abs(x) < 0.03f, series, exact);
}

// A straight way through water, from a depth at which the part `daylight` is left of the light that
// enters.
struct WaterWay {
  V length;  // [m], over 0
  V deeper;  // by how much it ends deeper than it begins [m]
};

// Light at the end of a way, where it is lit by what of `light` comes down so far, as it arrives at
// the way's beginning; in between water takes some away and scatters daylight to the eye. A light
// that depth has not dimmed (the surface's) is that of a way that ends at depth 0.
// With z the depth, s the length, c lost a metre and K of daylight: light e^(-c s - K z_end) +
// scattered c Int_0^s e^(-c t - K z(t)) dt.
// `shafts` is how much of that is scattered against the mean.
HWY_INLINE V3 ThroughWater(const Media& media, glm::vec3 daylight, const WaterWay& way, V3 light,
                           V shafts = Constant(1.0f)) {
  const D d;
  const auto along = [&](int channel, V seen) HWY_ATTR {
    const float c = media.absorption_per_m[channel];
    const V lost = way.length * c;
    const V x = MulAdd(way.deeper, media.daylight_lost_per_m[channel], lost);
    // Daylight makes up for e^60: from where it cannot, nothing is seen.
    const V passes = Exp(d, Clamp(-x, -80.0f, 60.0f));
    const V scattered = lost * LossOver(x, passes) * (shafts * media.scattered[channel]);
    return MulAdd(seen, passes, scattered) * daylight[channel];
  };
  return {along(0, light.x), along(1, light.y), along(2, light.z)};
}

// What a way without end shows, from a depth on, that goes down by w >= 0 a metre.
HWY_INLINE V3 EndlessWater(const Media& media, glm::vec3 daylight, V w) {
  const auto along = [&](int channel) HWY_ATTR {
    const float c = media.absorption_per_m[channel];
    const V lost = MulAdd(w, media.daylight_lost_per_m[channel], std::max(c, 1e-9f));
    return c * media.scattered[channel] * daylight[channel] / lost;
  };
  return {along(0), along(1), along(2)};
}

// Light as it arrives at an eye under water from what a packet of the window shows: the surface
// itself, or what lies in the water.
template <SurfaceKind kSurface>
HWY_INLINE V3 SeenInWater(const Media& media, V level, const Packet& shown, V3 light, V shafts) {
  const V zero = hn::Zero(D());
  V depth = zero;
  if constexpr (kSurface != SurfaceKind::kWater) depth = Max(level - shown.p.z, zero);
  const V deeper = depth - media.eye_depth_m;
  return ThroughWater(media, media.daylight_at_eye, {shown.distance, deeper}, light, shafts);
}

// A packet as a view shows it, and what it shows: the true places in the world.
struct Seen {
  Packet packet;   // where a mirrored or moved point really is
  WaterPath path;  // through water, of an eye in air; of the refraction image only
  WaterWay way;    // of an eye under water: from the surface; of the reflection image only
};

// Undoes what map_point() does for an eye under water. The way through air to what it sees through
// the surface has its own direction and length.
template <ViewKind kView>
HWY_INLINE Seen FindSeenFromBelow(const Media& media, const Packet& shown, V level) {
  const V zero = hn::Zero(D()), one = Constant(1.0f), n = Constant(media.refraction_index);
  const V beyond = shown.p.z - level, image = Max(beyond, zero);
  Seen seen;
  seen.packet = shown;
  if constexpr (kView == ViewKind::kReflection) {
    seen.packet.p.z = level - beyond;
    seen.packet.to_eye.z = -shown.to_eye.z;
    const V part = Clamp(image / Max(shown.p.z, 1e-3f), 0.0f, 1.0f);
    seen.way = {shown.distance * part, image};
  } else {
    const V cos_water = Max(-shown.to_eye.z, 0.02f);
    const V sin_water = Sqrt(Max(NegMulAdd(cos_water, cos_water, one), zero));
    const V sin_air = Min(sin_water * n, one);
    const V cos_air = Sqrt(NegMulAdd(sin_air, sin_air, one));
    const V height = image * cos_air / (n * cos_water);
    const V across = image * sin_water / cos_water;
    seen.packet.p.z = level + (height + Min(beyond, zero));
    seen.packet.distance = Sqrt(MulAdd(height, height, across * across));
    const V3 to_eye = {shown.to_eye.x * n, shown.to_eye.y * n, -cos_air};
    seen.packet.to_eye = to_eye * InverseSqrt(Dot(to_eye, to_eye));
  }
  return seen;
}

// Undoes what map_point() does; `level` is the height of the water's level over the eye.
template <ViewKind kView>
HWY_INLINE Seen FindSeen(const Shading& s, const Packet& shown, V level) {
  if (s.media.submerged) return FindSeenFromBelow<kView>(s.media, shown, level);
  Seen seen;
  seen.packet = shown;
  if constexpr (kView == ViewKind::kReflection) {
    seen.packet.p.z = level + level - shown.p.z;
    seen.packet.to_eye.z = -shown.to_eye.z;
  }
  if constexpr (kView == ViewKind::kRefraction) {
    const V zero = hn::Zero(D());
    const V below = level - shown.p.z;
    seen.path = PathThroughWater(s.media, shown, Abs(below));
    seen.packet.p.z = level - hn::CopySign(seen.path.depth, below);
    seen.path.length = IfThenElseZero(below > zero, seen.path.length);
  }
  return seen;
}

// Light that leaves a surface, as it arrives: through air, or through water up to the surface. To
// an eye under water it arrives at the surface.
template <ViewKind kView>
HWY_INLINE V3 Attenuate(const Shading& s, const Packet& shown, const Seen& seen, V3 light) {
  if constexpr (kView == ViewKind::kRefraction) {
    if (!s.media.submerged) return AbsorbInWater(s.media, seen.path, light);
    const V3 hazy = Haze(s, seen.packet, light);
    if (!s.media.fog.on) return hazy;
    const V height = seen.packet.p.z - s.media.eye_depth_m;
    return FogFromSea(s, -seen.packet.to_eye, seen.packet.distance, height, seen.packet.p, hazy);
  } else if (s.media.submerged) {
    return ThroughWater(s.media, glm::vec3(1.0f), seen.way, light);
  } else {
    const V3 hazy = Haze(s, shown, light);
    if (!s.media.fog.on) return hazy;
    // Beyond the water, which is in fog of its own.
    const V height = (seen.packet.p.z - shown.p.z) * 0.5f;
    const V part = Clamp(height / Max(-shown.p.z, 1e-3f), 0.0f, 1.0f);
    return FogFromSea(s, -shown.to_eye, shown.distance * part, height, seen.packet.p, hazy);
  }
}

// Whether the air before surfaces is laid once all are shaded (air_tile-inl.h). Clouds below the
// eye lie before it: where there are any, each surface has both. Haze alone is little, and left to
// surfaces too.
HWY_INLINE bool IsAirLaidLast(const Shading& s) {
  return (s.media.fog.on || s.media.molecules_per_m.z > 0.0f) && !s.media.submerged &&
         !s.light.clouds.is_below;
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
