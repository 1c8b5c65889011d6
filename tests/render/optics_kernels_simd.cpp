#include "render/optics_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/optics_kernels_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/materials/fresnel-inl.h"
#include "render/materials/water-inl.h"

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

void Slopes(const Water& water, glm::vec3 p_rel, SeenSlopes& result) {
  Packet packet;
  packet.x_px = packet.y_px = hn::Zero(D());
  packet.p = Constant(p_rel);
  packet.depth = packet.distance = Constant(-p_rel.z);
  packet.to_eye = Constant(glm::vec3(0.0f, 0.0f, 1.0f));
  const WaterSlopes s = water.has_coast ? SampleWater<true>(water, ViewRays{}, packet)
                                        : SampleWater<false>(water, ViewRays{}, packet);
  result.slope = {hn::GetLane(s.slope_x), hn::GetLane(s.slope_y)};
  result.variance = hn::GetLane(s.variance);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(Fresnel);
HWY_EXPORT(Slopes);

void fresnel_reflectance(std::span<const float> cos_theta, float n, std::span<float> reflectance) {
  HWY_DYNAMIC_DISPATCH(Fresnel)(cos_theta, n, reflectance);
}

SeenSlopes sample_water(const Water& water, glm::vec3 p_rel) {
  SeenSlopes result;
  HWY_DYNAMIC_DISPATCH(Slopes)(water, p_rel, result);
  return result;
}

}  // namespace swell::render
#endif  // HWY_ONCE
