#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "render/picture/develop.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/picture/develop_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/tile/resolve-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

void DevelopRow(std::span<float> light, int moments, float exposure, int y_px,
                std::span<std::uint32_t> rgba) {
  const D d;
  const V count = Constant(static_cast<float>(moments));
  const V exposed = Constant(exposure);
  for (std::size_t x = 0; x < rgba.size(); x += kLanes) {
    const std::size_t pixels = std::min(kLanes, rgba.size() - x);
    HWY_ALIGN std::array<float, 3 * kLanes> packet{};
    std::copy_n(light.data() + 3 * x, 3 * pixels, packet.data());
    V3 sum;
    hn::LoadInterleaved3(d, packet.data(), sum.x, sum.y, sum.z);
    const V3 mean = {sum.x / count, sum.y / count, sum.z / count};
    hn::StoreInterleaved3(mean.x, mean.y, mean.z, d, packet.data());
    std::copy_n(packet.data(), 3 * pixels, light.data() + 3 * x);
    const V3 display = {ToneCurve(mean.x, exposed), ToneCurve(mean.y, exposed),
                        ToneCurve(mean.z, exposed)};
    HWY_ALIGN std::array<std::int32_t, kLanes> codes;
    hn::Store(ToPixel(display, hn::ConvertTo(d, CountFrom(static_cast<int>(x))),
                      Constant(static_cast<float>(y_px))),
              DI(), codes.data());
    std::copy_n(codes.data(), pixels, rgba.data() + x);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(DevelopRow);

void develop_row(std::span<float> light, int moments, float exposure, int y_px,
                 std::span<std::uint32_t> rgba) {
  HWY_DYNAMIC_DISPATCH(DevelopRow)(light, moments, exposure, y_px, rgba);
}

}  // namespace swell::render
#endif
