// What the display shows of light.
#if defined(SWELL_RENDER_TILE_TONE_CURVE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_RENDER_TILE_TONE_CURVE_INL_H_
#undef SWELL_RENDER_TILE_TONE_CURVE_INL_H_
#else
#define SWELL_RENDER_TILE_TONE_CURVE_INL_H_
#endif

#include <glm/vec3.hpp>

#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// Exposed light as light of the display, in [0, 1]: a long shoulder from kShoulder up that reaches
// white at infinity only, so that foam and glitter keep their form: 1 is shown at 0.70, 4 at 0.91.
constexpr float kShoulder = 0.4f;

HWY_INLINE V ToneCurve(V linear, V exposure) {
  const V x = Max(linear * exposure, 0.0f);
  const V over = Max(x - kShoulder, 0.0f);
  V mapped = x;
  if (!hn::AllFalse(D(), over > 0.0f)) {
    const V shoulder = over / MulAdd(over, 1.0f / (1.0f - kShoulder), 1.0f);
    mapped = Min(Min(x, kShoulder) + shoulder, 1.0f);
  }
  return mapped;
}

// A mean of light's channels, and how much its differences count.
struct BrightnessScale {
  glm::vec3 weights;
  float factor;
};

// `factor` times about the sRGB code of light.
HWY_INLINE V BrightnessOf(const V3& light, const BrightnessScale& scale, float exposure) {
  const V mean =
      MulAdd(light.x, scale.weights.x, MulAdd(light.y, scale.weights.y, light.z * scale.weights.z));
  return Sqrt(ToneCurve(mean, Constant(exposure))) * (255.0f * scale.factor);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
