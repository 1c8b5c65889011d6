// The land and the sea floor.
#if defined(SWELL_RENDER_TERRAIN_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TERRAIN_INL_H_
#undef SWELL_RENDER_TERRAIN_INL_H_
#else
#define SWELL_RENDER_TERRAIN_INL_H_
#endif

#include "render/materials/foam-inl.h"
#include "render/tile/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

HWY_INLINE V GroundLevel(const ShadeContext& c, const Packet& packet) {
  return FootprintLevel(FootprintAcross(c, packet), Clamp(hn::Abs(packet.to_eye.z), 0.3f, 1.0f));
}

// Radiance of the ground at p (relative to the eye, x and y true): diffuse, lit by sun and sky.
// Without detail for what is seen through or in water.
template <bool kDetail>
HWY_INLINE V3 GroundRadiance(const ShadeContext& c, const Packet& packet, V level_m) {
  const D d;
  const V zero = hn::Zero(d);
  V slope_x = zero, slope_y = zero, variance = zero;
  if constexpr (kDetail) {
    AddSlopes(c.terrain_slopes, packet.p, level_m, zero, zero, slope_x, slope_y, variance);
    AddSlopes(c.terrain_detail, packet.p, level_m, zero, zero, slope_x, slope_y, variance);
  } else {
    NearestSlopes(c.terrain_slopes, packet.p, level_m, slope_x, slope_y);
  }
  const V inv_length =
      InverseSqrt(hn::MulAdd(slope_x, slope_x, hn::MulAdd(slope_y, slope_y, Constant(1.0f))));
  const V3 normal = {hn::Neg(hn::Mul(slope_x, inv_length)), hn::Neg(hn::Mul(slope_y, inv_length)),
                     inv_length};

  const V cos_sun = hn::Max(Dot(normal, Constant(c.sun_direction)), zero);
  const V sky_seen = hn::MulAdd(normal.z, Constant(0.5f), Constant(0.5f));
  const V3 light = ScaleAdd(Constant(c.sun_irradiance), hn::Mul(cos_sun, Constant(0.318309886f)),
                            Scale(Constant(c.ambient), sky_seen));
  const V x = hn::MulAdd(packet.p.x, Constant(c.albedo_texels_per_m), Constant(c.albedo_x_eye));
  const V y = hn::MulAdd(packet.p.y, Constant(c.albedo_texels_per_m), Constant(c.albedo_y_eye));
  V r, g, b, alpha;
  texture::HWY_NAMESPACE::SampleRgba(d, *c.terrain_albedo, x, y, r, g, b, alpha);
  return Product(light, {hn::Mul(r, r), hn::Mul(g, g), hn::Mul(b, b)});
}

// Light's way through water to something at a depth.
struct WaterPath {
  V depth;   // true, of a thing that is seen at the apparent one [m]
  V length;  // down from the sun and up to the surface [m]
};

HWY_INLINE WaterPath PathThroughWater(const ShadeContext& c, const Packet& packet, V apparent) {
  const D d;
  const V cos_eye = hn::Max(packet.to_eye.z, Constant(0.02f));
  const float inv_n = 1.0f / c.refraction_index;
  // cos of the refracted ray; apparent depth / true depth k = (1/n) cos / cos_t.
  const V sin_t =
      hn::Mul(hn::Sqrt(hn::Max(hn::NegMulAdd(cos_eye, cos_eye, Constant(1.0f)), hn::Zero(d))),
              Constant(inv_n));
  const V cos_t = hn::Sqrt(hn::NegMulAdd(sin_t, sin_t, Constant(1.0f)));
  const V depth = hn::Mul(apparent, hn::Div(hn::Mul(cos_t, Constant(c.refraction_index)), cos_eye));
  const V path_up = hn::Min(hn::Div(depth, cos_t), Constant(200.0f));
  return {depth, hn::MulAdd(depth, Constant(1.2f), path_up)};  // sunlight comes down at a slant
}

// Light is lost on its way, and the water body's takes its place (Beer-Lambert).
HWY_INLINE V3 AbsorbInWater(const ShadeContext& c, const WaterPath& path, V3 light) {
  const D d;
  const glm::vec3 absorption = c.absorption_per_m;
  const auto lost = [&](float per_m, V body, V seen) {
    const V through = Exp(d, hn::Mul(path.length, Constant(-per_m)));
    return Lerp(body, seen, through);
  };
  return {lost(absorption.x, Constant(c.body.x), light.x),
          lost(absorption.y, Constant(c.body.y), light.y),
          lost(absorption.z, Constant(c.body.z), light.z)};
}

// 1 over the land's square, falling to 0 at its rim, beyond which there is deep water.
HWY_INLINE V InsideLand(const ShadeContext& c, V3 p) {
  constexpr float kRim = 1.0f / 30.0f;  // of the side
  const SlopeLayer& square = c.terrain_slopes;
  const auto from_rim = [&](float eye, V x) HWY_ATTR {
    const V u = hn::MulAdd(x, Constant(square.inv_length), Constant(eye));
    return hn::Min(u, hn::Sub(Constant(1.0f), u));
  };
  const V nearest = hn::Min(from_rim(square.u_eye, p.x), from_rim(square.v_eye, p.y));
  return Clamp(hn::Mul(nearest, Constant(1.0f / kRim)), 0.0f, 1.0f);
}

// The ground through water: the pixel's z is squeezed.
HWY_INLINE V3 ShadeSubmerged(const ShadeContext& c, const Packet& packet) {
  const V3 ground = GroundRadiance<false>(c, packet, GroundLevel(c, packet));
  const V apparent = hn::Max(hn::Neg(hn::Add(packet.p.z, Constant(c.eye_z))), hn::Zero(D()));
  const V3 seen = AbsorbInWater(c, PathThroughWater(c, packet, apparent), ground);
  return Lerp(Constant(c.body), seen, InsideLand(c, packet.p));
}

// Dry ground as the reflection image shows it (p mirrored: the true height is -z).
HWY_INLINE V3 ShadeMirrored(const ShadeContext& c, const Packet& packet) {
  return Haze(c, packet, GroundRadiance<false>(c, packet, GroundLevel(c, packet)));
}

// Ground as the eye sees it, with the sea's last sheets on it.
HWY_INLINE V3 ShadeTerrain(const ShadeContext& c, const Packet& packet) {
  const V level_m = GroundLevel(c, packet);
  const V3 ground = GroundRadiance<true>(c, packet, level_m);
  const V height_m = hn::Add(packet.p.z, Constant(c.eye_z));
  return Haze(c, packet, AddSwash(c, packet, level_m, height_m, ground));
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
