#include "math/check.h"
#include "render/sky/cloud_sky.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/sky/cloud_sky_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
//
#include "render/sky/cloud_field-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

void CloudSkyRow(const VolumeClouds& clouds, const CloudAir& air, int y, CloudSky& sky) {
  const D d;
  const V one = Constant(1.0f);
  constexpr float kTexel = 2.0f / CloudSky::kSide;
  const V v = Constant(kTexel * (static_cast<float>(y) + 0.5f) - 1.0f);
  for (int x = 0; x < CloudSky::kSide; x += static_cast<int>(hn::Lanes(d))) {
    const V column = hn::ConvertTo(d, CountFrom(x)) + 0.5f;
    const V u = MulSub(column, kTexel, one);
    const V r2 = MulAdd(u, u, v * v);
    const V z = Max((one - r2) / (one + r2), 0.004f);
    const V across = Sqrt(NegMulAdd(z, z, one) / Max(r2, 1e-12f));
    const CloudLightSeen seen =
        SeeClouds(clouds, {u * across, v * across, z}, Constant(kFarthestCloud_m));
    const V height = seen.distance * z;
    const V density = air.inv_haze_m / MulAdd(height, air.inv_haze_height_m, one);
    const V clear = Exp(d, -(seen.distance * density));
    const V3 light = Lerp(Constant(air.horizon) * seen.opacity, RadianceOf(clouds, seen), clear);
    const std::size_t at =
        static_cast<std::size_t>(y) * CloudSky::kSide + static_cast<std::size_t>(x);
    hn::StoreU(light.x, d, &sky.texels[0][at]);
    hn::StoreU(light.y, d, &sky.texels[1][at]);
    hn::StoreU(light.z, d, &sky.texels[2][at]);
    hn::StoreU(seen.opacity, d, &sky.texels[CloudSky::kOpacity][at]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(CloudSkyRow);

void write_cloud_sky_row(const VolumeClouds& clouds, const CloudAir& air, int y, CloudSky& sky) {
  SWELL_CHECK(clouds.any() && y >= 0 && y < CloudSky::kSide, "row={}", y);
  HWY_DYNAMIC_DISPATCH(CloudSkyRow)(clouds, air, y, sky);
}

}  // namespace swell::render
#endif  // HWY_ONCE
