// The land among and under trees.
#if defined(SWELL_RENDER_MATERIALS_CANOPY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_CANOPY_INL_H_
#undef SWELL_RENDER_MATERIALS_CANOPY_INL_H_
#else
#define SWELL_RENDER_MATERIALS_CANOPY_INL_H_
#endif

#include "render/materials/canopy.h"
#include "render/packets/square_map-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

struct UnderTrees {
  V cover;     // part of the ground under crowns
  V far;       // 0 where trees are drawn, 1 where the land stands for them
  V sun, sky;  // what they leave of the light on the ground
};

// level_m: log2 of what a pixel shows of the ground.
HWY_INLINE UnderTrees FindUnderTrees(const Canopy& canopy, const SquareMap& sun_left,
                                     const ViewRays& rays, const Packet& packet, V level_m) {
  const D d;
  const V zero = hn::Zero(d), one = Constant(1.0f);
  if (!canopy.cover.map) return {zero, zero, one, one};
  const V cover = SampleSquare(canopy.cover, packet.p, level_m, zero);
  const V shade = one - SampleSquare(sun_left, packet.p, level_m, one);
  const V across = FootprintAcross(rays, packet);
  const V far = Clamp((across - canopy.near_log2_m) * canopy.per_log2, 0.0f, 1.0f);
  // From afar the crowns are seen, which the sun shines on, and less and less of their shade.
  const V near = NegMulAdd(far, cover, one);
  return {cover, far, NegMulAdd(shade, near, one), NegMulAdd(cover * near, 0.55f, one)};
}

// Litter lies under trees that are drawn; from afar their crowns are seen.
HWY_INLINE V3 ColourUnderTrees(const Canopy& canopy, const UnderTrees& under, V3 ground) {
  if (!canopy.cover.map) return ground;
  const V3 litter = {Constant(0.060f), Constant(0.052f), Constant(0.028f)};
  const V3 floor = Lerp(ground, litter, under.cover * 0.65f);
  return Lerp(floor, Constant(canopy.crowns), under.cover * under.far);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
