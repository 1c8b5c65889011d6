// The paper's lighting of bump: the water's own colour times dot(normal, light) and a detail.
#if defined(SWELL_RENDER_WATER_BUMP_LIGHT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_WATER_BUMP_LIGHT_INL_H_
#undef SWELL_RENDER_WATER_BUMP_LIGHT_INL_H_
#else
#define SWELL_RENDER_WATER_BUMP_LIGHT_INL_H_
#endif

#include <algorithm>

#include "render/packets/packet-inl.h"
#include "render/tile/shading.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// Times the light of flat water without detail: (1 + detail) dot(normal, light) / dot(flat, light);
// where the sun is hidden, the detail alone. Lights lower than 12 degrees count as that high.
// Source: Ma, Zhu, Gong, 2006.
HWY_NOINLINE static V BumpLight(const Shading& s, const SlopeLayer& detail_layer,
                                const Packet& packet, V3 normal, V sun_visible) {
  const V zero = hn::Zero(D()), one = Constant(1.0f);
  const V level_m =
      FootprintLevel(FootprintAcross(s.rays, packet), Clamp(packet.to_eye.z, 0.02f, 1.0f));
  V detail = one, same = zero, unused = zero;
  AddSlopes(detail_layer, packet.p, level_m, {zero, zero}, detail, same, unused);
  const glm::vec3 sun = s.light.sun_direction;
  const V lit = Max(Dot(normal, Constant(sun)), zero);
  const V sunny = lit * (1.0f / std::max(sun.z, 0.2f));
  return detail * Lerp(one, sunny, sun_visible);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
