#include "render/optics_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/optics_kernels_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/fresnel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

void Fresnel(std::span<const float> cos_theta, float n, std::span<float> reflectance) {
  const hn::ScalableTag<float> d;
  HWY_ALIGN float lanes[hn::MaxLanes(d)];
  for (std::size_t i = 0; i < cos_theta.size(); ++i) {
    hn::Store(FresnelReflectance(d, hn::Set(d, cos_theta[i]), n), d, lanes);
    reflectance[i] = lanes[i % hn::Lanes(d)];
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(Fresnel);

void fresnel_reflectance(std::span<const float> cos_theta, float n, std::span<float> reflectance) {
  HWY_DYNAMIC_DISPATCH(Fresnel)(cos_theta, n, reflectance);
}

}  // namespace swell::render
#endif  // HWY_ONCE
