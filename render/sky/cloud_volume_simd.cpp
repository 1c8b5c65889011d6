#include "math/check.h"
#include "render/sky/cloud_volume.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/sky/cloud_volume_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
//
#include "render/sky/cloud_volume-inl.h"
#include "render/sky/sky_maps.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

HWY_INLINE VI ToByte(V part) {
  return TruncateToInt(MulAdd(Clamp(part, 0.0f, 1.0f), 255.0f, 0.5f));
}

// Skylight comes from straight above and from four sides; what is scattered on its way goes on, so
// that it fades at a third of the depth.
HWY_INLINE V SkylightAt(const CloudVolume& volume, V3 place) {
  constexpr std::array<glm::vec3, 5> kFrom = {
      glm::vec3(0, 0, 1), glm::vec3(0.8f, 0.1f, 0.6f), glm::vec3(-0.8f, -0.1f, 0.6f),
      glm::vec3(0.1f, -0.8f, 0.6f), glm::vec3(-0.1f, 0.8f, 0.6f)};
  V sum = hn::Zero(D());
  for (const glm::vec3& from : kFrom)
    sum = sum + Exp(D(), DepthTowards(volume, place, from, 6, 30.0f, 1.8f) * (-1.0f / 3.0f));
  return sum * (1.0f / kFrom.size());
}

void CloudLightRow(const CloudVolume& volume, glm::vec3 to_light, int level, int y,
                   std::uint16_t* row) {
  constexpr int n = 1 << CloudVolume::kLightSideLog2;
  const D d;
  for (int x = 0; x < n; x += static_cast<int>(hn::Lanes(d))) {
    const V3 place = {hn::ConvertTo(d, CountFrom(x)) * 2.0f, Constant(2.0f * static_cast<float>(y)),
                      Constant(static_cast<float>(level))};
    const V depth = DepthTowards(volume, place, to_light, 22, 20.0f, 1.22f);
    const VI sun = ToByte(Exp(d, depth * (-1.0f / CloudVolume::kLightDepth)));
    const VI sky = ToByte(SkylightAt(volume, place));
    HWY_ALIGN std::array<std::int32_t, hn::MaxLanes(d)> values;
    hn::Store(sun | hn::ShiftLeft<8>(sky), DI(), values.data());
    for (std::size_t i = 0; i < values.size(); ++i)
      row[static_cast<std::size_t>(x) + i] = static_cast<std::uint16_t>(values[i]);
  }
}

void CloudSunlightRow(const CloudVolume& volume, glm::vec3 to_light, int y, float* row) {
  const int n = volume.form.side();
  const D d;
  constexpr int kSteps = 64;
  const float way_m = (volume.top_m - volume.base_m) / std::max(to_light.z, 0.05f);
  for (int x = 0; x < n; x += static_cast<int>(hn::Lanes(d))) {
    const V3 place = {hn::ConvertTo(d, CountFrom(x)), Constant(static_cast<float>(y)), hn::Zero(d)};
    const V depth = DepthTowards(volume, place, to_light, kSteps, way_m / kSteps, 1.0f);
    hn::StoreU(Exp(d, -depth), d, row + x);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(CloudLightRow);
HWY_EXPORT(CloudSunlightRow);

void write_cloud_light_row(const CloudVolume& volume, glm::vec3 to_light, int level, int y,
                           std::uint16_t* row) {
  SWELL_CHECK(
      level >= 0 && level < volume.form.levels && y >= 0 && y < 1 << CloudVolume::kLightSideLog2,
      "level={} y={}", level, y);
  HWY_DYNAMIC_DISPATCH(CloudLightRow)(volume, to_light, level, y, row);
}

void write_cloud_sunlight_row(const CloudVolume& volume, glm::vec3 to_light, int y, float* row) {
  SWELL_CHECK(y >= 0 && y < volume.form.side(), "y={}", y);
  HWY_DYNAMIC_DISPATCH(CloudSunlightRow)(volume, to_light, y, row);
}

}  // namespace swell::render
#endif  // HWY_ONCE
