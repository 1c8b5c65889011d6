// How much of the sun points of objects see past the objects that they are on.
#if defined(SWELL_RENDER_TILE_SELF_SHADOW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_SELF_SHADOW_INL_H_
#undef SWELL_RENDER_TILE_SELF_SHADOW_INL_H_
#else
#define SWELL_RENDER_TILE_SELF_SHADOW_INL_H_
#endif

#include "render/tile/shading_result-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// What one object leaves of the sun at points p, relative to the eye, of its surface with these
// normals. Points are taken off the surface towards the sun: the map's four points around hold what
// lies up to 2.1 spaces between points away, and by so much a plane clears it, however it leans.
HWY_INLINE V SunOverOne(const ObjectShadows& shadows, const SunDepth& map, const V3& p,
                        const V3& normal) {
  const D d;
  constexpr float kOff = 2.6f;
  const V off = Constant(kOff / map.points_per_m);
  const V facing = Dot(normal, Constant(shadows.sun));
  const V3 q = MulAdd(normal, hn::CopySign(off, facing), p + Constant(-map.middle_rel));
  const auto place = [&](glm::vec3 axis) HWY_ATTR {
    const V at = Dot(q, Constant(axis)) - map.first_m;
    return Clamp(at * map.points_per_m, 0.0f, static_cast<float>(map.side) - 1.001f);
  };
  const V x = place(shadows.right), y = place(shadows.up), depth = Dot(q, Constant(shadows.sun));
  const VI i = TruncateToInt(x), j = TruncateToInt(y);
  const VI first = j * map.side + i;
  const auto lit = [&](int offset) HWY_ATTR {
    const V nearest = hn::GatherIndex(d, map.depth_m.data() + offset, first);
    return IfThenElseZero(nearest <= depth, Constant(1.0f));
  };
  const V s = x - hn::ConvertTo(d, i), t = y - hn::ConvertTo(d, j);
  const V part = Lerp(Lerp(lit(0), lit(1), s), Lerp(lit(map.side), lit(map.side + 1), s), t);
  return NegMulAdd(1.0f - part, map.strength, 1.0f);
}

// What each lane's object leaves of the sun at points p of its own surface, as SunOverOne() has it.
// maps: null for an object that does not shade itself.
template <std::size_t kCount>
HWY_NOINLINE V SunOverOwn(const ObjectShadows& shadows,
                          const std::array<const SunDepth*, kCount>& maps, const V3& p,
                          const V3& normal) {
  const D d;
  V visible = Constant(1.0f);
  HWY_ALIGN std::array<float, kCount> is_its;
  for (std::size_t i = 0; i < kCount; ++i) {
    if (!maps[i] || (i > 0 && maps[i] == maps[i - 1])) continue;
    for (std::size_t k = 0; k < kCount; ++k) is_its[k] = maps[k] == maps[i] ? 1.0f : 0.0f;
    const auto its = hn::Load(d, is_its.data()) > 0.0f;
    visible = IfThenElse(its, SunOverOne(shadows, *maps[i], p, normal), visible);
  }
  return visible;
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
