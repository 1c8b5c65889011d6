// What the water's own light is multiplied by: its texture, and the paper's lighting of bump.
// Source: Ma, Zhu, Gong, 2006.
#if defined(SWELL_RENDER_WATER_OWN_COLOUR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_WATER_OWN_COLOUR_INL_H_
#undef SWELL_RENDER_WATER_OWN_COLOUR_INL_H_
#else
#define SWELL_RENDER_WATER_OWN_COLOUR_INL_H_
#endif

#include <algorithm>

#include "render/packets/packet-inl.h"
#include "render/packets/slope_layer.h"
#include "render/tile/shading.h"
#include "render/water/water.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

HWY_INLINE V3 SampleTint(const TintLayer& tint, V3 p, V level_m) {
  const V zero = hn::Zero(D()), one = Constant(1.0f);
  V3 factor = {one, one, one};
  V unused = zero, same = zero;
  AddSlopes(tint.red_green, p, level_m, {zero, zero}, factor.x, factor.y, same);
  AddSlopes(tint.blue, p, level_m, {zero, zero}, factor.z, unused, same);
  return factor;
}

// The bump's light is (1 + detail) dot(normal, light) / dot(flat, light) times that of flat water
// without detail; where the sun is hidden, the detail alone. Lights lower than 12 degrees count as
// that high.
HWY_NOINLINE static V3 OwnColour(const Shading& s, const Water& water, const Packet& packet,
                                 V3 normal, V sun_visible) {
  const V zero = hn::Zero(D()), one = Constant(1.0f);
  const V level_m =
      FootprintLevel(FootprintAcross(s.rays, packet), Clamp(packet.to_eye.z, 0.02f, 1.0f));
  V3 factor = {one, one, one};
  if (water.texture.on()) factor = SampleTint(water.texture, packet.p, level_m);
  if (!water.bump_detail.on()) return factor;
  const glm::vec3 sun = s.light.sun_direction;
  const V lit = Max(Dot(normal, Constant(sun)), zero);
  const V sunny = lit * (1.0f / std::max(sun.z, 0.2f));
  return factor * SampleTint(water.bump_detail, packet.p, level_m) * Lerp(one, sunny, sun_visible);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
