// What the medium between a surface and the eye does to light: once for all materials.
#if defined(SWELL_RENDER_TILE_ATTENUATE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_ATTENUATE_INL_H_
#undef SWELL_RENDER_TILE_ATTENUATE_INL_H_
#else
#define SWELL_RENDER_TILE_ATTENUATE_INL_H_
#endif

#include <algorithm>

#include "render/tile/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// The mean density of haze on the way to what a packet shows, against that at sea level. At the
// height h over the sea it is 1 / (1 + h / H)^2, much like exp(-h / H) and of the same amount in
// all, because between places of heights a H and b H on a straight line the mean of that is
// 1 / ((1 + a) (1 + b)): no exponential, and no difference of almost equal ones. The way is taken
// as two such lines, which meet where its middle lies over a round earth.
HWY_INLINE V MeanHaze(const Shading& s, const Packet& shown) {
  const float per_m = s.media.inv_haze_height_m, eye_z = s.rays.eye_z;
  const V one = Constant(1.0f);
  const V eye = Constant(1.0f + std::max(eye_z, 0.0f) * per_m);
  // Mirrored things lie below the level.
  const V height = hn::Abs(hn::Add(shown.p.z, Constant(eye_z)));
  const V place = hn::MulAdd(height, Constant(per_m), one);
  const V both = hn::Add(eye, place);
  const V r2 = hn::MulAdd(shown.p.x, shown.p.x, hn::Mul(shown.p.y, shown.p.y));
  const V sagging = hn::Mul(r2, Constant(0.25f * s.rays.drop_per_m2 * per_m));
  const V middle = hn::Max(hn::MulSub(both, Constant(0.5f), sagging), one);
  return hn::Div(hn::Mul(both, Constant(0.5f)), hn::Mul(hn::Mul(eye, place), middle));
}

// Blends towards the horizon's colour with distance, so that no edge of the sea shows. Haze of less
// than half a step of the picture is left out: near packets then need no lookup. Straight down
// there is no azimuth to look up: the steeper the view, the more the mean of the horizon takes
// over.
HWY_INLINE V3 Haze(const Shading& s, const Packet& packet, V3 colour) {
  const D d;
  const V depth =
      hn::Mul(hn::Mul(packet.distance, Constant(-s.media.inv_haze_m)), MeanHaze(s, packet));
  const V clear = Exp(d, depth);
  const V amount = hn::Max(hn::Sub(Constant(1.0f - 1.0f / 512.0f), clear), hn::Zero(d));
  if (hn::AllFalse(d, hn::Gt(amount, hn::Zero(d)))) return colour;
  const V x = hn::Neg(packet.to_eye.x), y = hn::Neg(packet.to_eye.y);
  const V horizontal2 = hn::Max(hn::MulAdd(x, x, hn::Mul(y, y)), Constant(1e-12f));
  const V3 ahead = SoftSkyRadiance(*s.light.sky_soft, {x, y, hn::Zero(d)}, hn::Sqrt(horizontal2));
  const V level4 = hn::Mul(horizontal2, horizontal2), level8 = hn::Mul(level4, level4);
  const V steep = hn::NegMulAdd(level8, level8, Constant(1.0f));
  return Lerp(colour, Lerp(ahead, Constant(s.light.horizon), steep), amount);
}

// Light's way through water to something at a depth.
struct WaterPath {
  V depth;   // true, of a thing that is seen at the apparent one [m]
  V length;  // down from the sun and up to the surface [m]
};

HWY_INLINE WaterPath PathThroughWater(const Media& media, const Packet& packet, V apparent) {
  const D d;
  const V cos_eye = hn::Max(packet.to_eye.z, Constant(0.02f));
  const float inv_n = 1.0f / media.refraction_index;
  // cos of the refracted ray; apparent depth / true depth k = (1/n) cos / cos_t.
  const V sin_t =
      hn::Mul(hn::Sqrt(hn::Max(hn::NegMulAdd(cos_eye, cos_eye, Constant(1.0f)), hn::Zero(d))),
              Constant(inv_n));
  const V cos_t = hn::Sqrt(hn::NegMulAdd(sin_t, sin_t, Constant(1.0f)));
  const V depth =
      hn::Mul(apparent, hn::Div(hn::Mul(cos_t, Constant(media.refraction_index)), cos_eye));
  const V path_up = hn::Min(hn::Div(depth, cos_t), Constant(200.0f));
  return {depth, hn::MulAdd(depth, Constant(1.2f), path_up)};  // sunlight comes down at a slant
}

// Light is lost on its way, and the water body's takes its place (Beer-Lambert).
HWY_INLINE V3 AbsorbInWater(const Media& media, const WaterPath& path, V3 light) {
  const D d;
  const glm::vec3 absorption = media.absorption_per_m;
  const auto lost = [&](float per_m, V body, V seen) {
    const V through = Exp(d, hn::Mul(path.length, Constant(-per_m)));
    return Lerp(body, seen, through);
  };
  return {lost(absorption.x, Constant(media.body.x), light.x),
          lost(absorption.y, Constant(media.body.y), light.y),
          lost(absorption.z, Constant(media.body.z), light.z)};
}

// A packet as a view shows it, and what it shows: the true places in the world.
struct Seen {
  Packet packet;   // where a mirrored or squeezed point really is
  WaterPath path;  // through water; of the refraction image only
};

// Undoes what map_point() does; `level` is the height of the water's level over the eye.
template <ViewKind kView>
HWY_INLINE Seen FindSeen(const Shading& s, const Packet& shown, V level) {
  Seen seen;
  seen.packet = shown;
  if constexpr (kView == ViewKind::kReflection) {
    seen.packet.p.z = hn::Sub(hn::Add(level, level), shown.p.z);
    seen.packet.to_eye.z = hn::Neg(shown.to_eye.z);
  }
  if constexpr (kView == ViewKind::kRefraction) {
    const V zero = hn::Zero(D());
    seen.path = PathThroughWater(s.media, shown, hn::Max(hn::Sub(level, shown.p.z), zero));
    const V above = hn::Max(hn::Sub(shown.p.z, level), zero);
    seen.packet.p.z = hn::Add(hn::Sub(level, seen.path.depth), above);
  }
  return seen;
}

// Light that leaves a surface, as it arrives: through air, or through water up to the surface.
template <ViewKind kView>
HWY_INLINE V3 Attenuate(const Shading& s, const Packet& shown, const Seen& seen, V3 light) {
  if constexpr (kView == ViewKind::kRefraction)
    return AbsorbInWater(s.media, seen.path, light);
  else
    return Haze(s, shown, light);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
