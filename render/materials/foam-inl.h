// Foam on broken waves, and the thin sheets that they send up the beach.
#if defined(SWELL_RENDER_FOAM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_FOAM_INL_H_
#undef SWELL_RENDER_FOAM_INL_H_
#else
#define SWELL_RENDER_FOAM_INL_H_
#endif

#include "render/materials/fresnel-inl.h"
#include "render/tile/packet-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// The part of a packet's pixels that foam hides, for foam in [0, 1]: 0 for less than a fiftieth,
// 1 for 1.
HWY_INLINE V FoamCover(const ShadeContext& c, V3 p, V level_m, V foam) {
  const D d;
  constexpr float kSoft = 0.3f;  // width of a bubble's rim, as a threshold
  const auto some = hn::Gt(foam, Constant(0.02f));
  if (hn::AllFalse(d, some)) return hn::Zero(d);
  // A step between two mip levels is no wider than the lace's own irregularity.
  V code, unused;
  NearestSlopes(c.foam_pattern, p, level_m, code, unused);
  const V threshold = hn::MulAdd(code, Constant(0.5f), Constant(0.5f));
  const V over = hn::MulSub(foam, Constant(1.0f + kSoft), threshold);
  return hn::IfThenElseZero(some, Clamp(hn::Mul(over, Constant(1.0f / kSoft)), 0.0f, 1.0f));
}

HWY_INLINE V3 AddFoam(const ShadeContext& c, V cover, V3 light) {
  return Lerp(light, Constant(c.foam_light), hn::Mul(cover, Constant(0.92f)));
}

// Where the sea's edge is now, as a height on the beach from 0 to c.swash_m: it runs up fast and
// back slowly, not everywhere at one time.
struct Swash {
  V edge_m;
  V retreat;  // 0 while it comes, up to 1 as it goes
};

HWY_INLINE Swash FindSwash(const ShadeContext& c, V3 p) {
  const D d;
  V along_a, along_b, sine, cosine, unused;
  SinCosTurns(d,
              hn::MulAdd(p.x, Constant(c.swash_a.x),
                         hn::MulAdd(p.y, Constant(c.swash_a.y), Constant(c.swash_a.z))),
              along_a, unused);
  SinCosTurns(d,
              hn::MulAdd(p.x, Constant(c.swash_b.x),
                         hn::MulAdd(p.y, Constant(c.swash_b.y), Constant(c.swash_b.z))),
              along_b, unused);
  const V lag = hn::Mul(hn::Add(along_a, along_b), Constant(0.3f));
  const V turns = hn::Sub(Constant(c.swash_cycles), lag);
  SinCosTurns(d, turns, sine, cosine);
  // cos(phi - 0.35 cos phi) leans forward: up in less than half the time.
  const V leaning = hn::MulAdd(cosine, Constant(-0.056f), turns);
  SinCosTurns(d, leaning, sine, cosine);
  const V half = Constant(0.5f);
  const V reach = hn::MulAdd(along_b, Constant(0.15f), Constant(0.85f));
  const V edge = hn::Mul(hn::MulAdd(sine, half, half), hn::Mul(reach, Constant(c.swash_m)));
  return {edge, hn::MulAdd(cosine, hn::Neg(half), half)};
}

// Wet sand mirrors the sky; a sheet of water with foam at its rim runs over it. `ground` is the
// ground's light at p, whose height is height_m.
HWY_INLINE V3 AddSwash(const ShadeContext& c, const Packet& packet, V level_m, V height_m,
                       V3 ground) {
  const D d;
  const auto reached = hn::Lt(height_m, Constant(1.6f * c.swash_m));
  if (c.swash_m <= 0.0f || hn::AllFalse(d, reached)) return ground;
  const Swash swash = FindSwash(c, packet.p);
  // Sand stays wet for a while up to where the sheets come.
  const V dry = Clamp(hn::Mul(height_m, Constant(1.0f / (1.6f * c.swash_m))), 0.0f, 1.0f);
  const V wet = hn::NegMulAdd(hn::Mul(dry, dry), dry, Constant(1.0f));
  const V cos_eye = Clamp(packet.to_eye.z, 0.05f, 1.0f);
  const V mirror = FresnelReflectance(d, cos_eye, c.refraction_index);
  const V3 up = {hn::Neg(packet.to_eye.x), hn::Neg(packet.to_eye.y), hn::Abs(packet.to_eye.z)};
  const V3 sky = SkyRadiance(*c.sky_soft, up, Constant(1.0f));
  const V below = hn::Sub(swash.edge_m, height_m);  // of the sheet's rim [m of height]
  const V sheet = Clamp(hn::Mul(below, Constant(40.0f)), 0.0f, 1.0f);
  const V shine = hn::Mul(mirror, hn::MulAdd(sheet, Constant(0.5f), hn::Mul(wet, Constant(0.5f))));
  const V darkened = hn::NegMulAdd(wet, Constant(0.15f), Constant(1.0f));
  V3 light = Lerp(Scale(ground, darkened), sky, shine);
  // A bright rim, then lace that thins out.
  const V from_rim = hn::Mul(below, Constant(1.0f / c.swash_m));
  const V rim = Clamp(hn::NegMulAdd(from_rim, Constant(9.0f), Constant(1.0f)), 0.0f, 1.0f);
  const V lace = Clamp(hn::NegMulAdd(from_rim, Constant(0.9f), Constant(0.6f)), 0.0f, 1.0f);
  const V fresh = hn::NegMulAdd(swash.retreat, Constant(0.6f), Constant(1.0f));
  const V foam = hn::IfThenElseZero(hn::Gt(below, hn::Zero(d)), hn::Mul(hn::Max(rim, lace), fresh));
  light = AddFoam(c, FoamCover(c, packet.p, level_m, foam), light);
  return {hn::IfThenElse(reached, light.x, ground.x), hn::IfThenElse(reached, light.y, ground.y),
          hn::IfThenElse(reached, light.z, ground.z)};
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
