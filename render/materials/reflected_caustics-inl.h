// The sun's light that waves throw up on what stands in the water.
#if defined(SWELL_RENDER_MATERIALS_REFLECTED_CAUSTICS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_MATERIALS_REFLECTED_CAUSTICS_INL_H_
#undef SWELL_RENDER_MATERIALS_REFLECTED_CAUSTICS_INL_H_
#else
#define SWELL_RENDER_MATERIALS_REFLECTED_CAUSTICS_INL_H_
#endif

#include "render/packets/fresnel-inl.h"
#include "render/tile/caustics-inl.h"
#include "render/tile/shading.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// From the first height on the light fades; from the second on there is none. (Higher up it would
// be as much but for what stands in its way, without a pattern.)
constexpr float kReflectedFade_m = 3.0f, kReflectedEnd_m = 7.0f;

// The light that arrives at points p relative to the eye with normals, as a part of the sun's
// irradiance. Where the light comes from is not looked for: it is as sunny there as at the point.
inline HWY_NOINLINE V ReflectedCaustics(const Shading& s, const V3& p, const V3& normal,
                                        V level_m) {
  const D d;
  const V zero = hn::Zero(d), one = Constant(1.0f);
  const glm::vec3 sun = s.light.sun_direction;
  const V height = Max(p.z + s.rays.eye_z, zero);
  const V facing = Max(Dot(normal, Constant({sun.x, sun.y, -sun.z})), zero);
  const V low =
      Clamp((kReflectedEnd_m - height) * (1.0f / (kReflectedEnd_m - kReflectedFade_m)), 0.0f, 1.0f);
  V light = facing * low;
  if (!s.caustics.throws_up || hn::AllFalse(d, light > zero)) return zero;
  const V x = MulAdd(height, s.caustics.reflected_from.x, p.x);
  const V y = MulAdd(height, s.caustics.reflected_from.y, p.y);
  for (std::size_t i = 0; i < s.caustics.patches; ++i) {
    const CausticPatch& patch = s.caustics.patch[i];
    const CausticPlace at = PlaceInCaustics(patch, x, y, level_m);
    // Contrast rises as that of a weak lens does, and falls above the focus.
    const V to_map = height * (1.0f / patch.mirrored_m);
    const V weight = Min(to_map, one / Max(to_map, 1e-6f));
    const V more = SampleCaustic(*patch.mirrored, at) - one;
    light = light * MulAdd(more, weight * s.caustics.strength, one);
  }
  return light * FresnelReflectance(d, Constant(sun.z), s.media.refraction_index);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
