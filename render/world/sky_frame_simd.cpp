#include "math/check.h"
#include "render/tile/shade_tile.h"
#include "render/world/sky_frame.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/world/sky_frame_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
//
#include "render/materials/clouds-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// The angle over which the clear sky is blurred too: no cloud's edge is sharp in the sea.
constexpr float kSoftAngleLog2 = -4.5f;

HWY_INLINE VI ByteOf(V radiance) {
  const V part = hn::Mul(hn::Max(radiance, hn::Zero(D())), Constant(1.0f / kSoftSkyRange));
  const V code = hn::Mul(hn::Sqrt(hn::Min(part, Constant(1.0f))), Constant(255.0f));
  return hn::ConvertTo(DI(), hn::Add(code, Constant(0.5f)));
}

void SoftSkyRow(const SkyMaps& sky, const Clouds& clouds, int y, std::uint32_t* codes) {
  const D d;
  constexpr float kStep = 2.0f / kSoftSkySize;
  constexpr std::size_t kChannel = static_cast<std::size_t>(kSoftSkySize) * kSoftSkySize;
  const V v = Constant(kStep * (static_cast<float>(y) + 0.5f) - 1.0f);
  const V one = Constant(1.0f), range = Constant(kSoftSkyRange);
  for (int x = 0; x < kSoftSkySize; x += static_cast<int>(hn::Lanes(d))) {
    const V column = hn::Add(hn::ConvertTo(d, CountFrom(x)), Constant(0.5f));
    const V u = hn::MulSub(column, Constant(kStep), one);
    // Outside the horizon's circle: as at the horizon.
    const V r2 = hn::MulAdd(u, u, hn::Mul(v, v));
    const V z = hn::Max(hn::Div(hn::Sub(one, r2), hn::Add(one, r2)), hn::Zero(d));
    const V across = hn::Sqrt(hn::Div(hn::NegMulAdd(z, z, one), hn::Max(r2, Constant(1e-12f))));
    const std::size_t at = static_cast<std::size_t>(y) * kSoftSkySize + static_cast<std::size_t>(x);
    const float* clear = sky.soft_clear.data() + at;
    V passes;
    const V3 direction = {hn::Mul(u, across), hn::Mul(v, across), z};
    const CloudView view = ViewClouds(clouds, direction, Constant(kSoftAngleLog2));
    const V3 light = AddClouds(
        clouds, view, SampleClouds(clouds, view.x, view.y, view.level),
        {hn::LoadU(d, clear), hn::LoadU(d, clear + kChannel), hn::LoadU(d, clear + 2 * kChannel)},
        passes);
    const V most = hn::Max(light.x, hn::Max(light.y, light.z));
    const V fits = hn::Div(range, hn::Max(most, range));
    const VI code = hn::Or(ByteOf(hn::Mul(light.x, fits)),
                           hn::Or(hn::ShiftLeft<8>(ByteOf(hn::Mul(light.y, fits))),
                                  hn::ShiftLeft<16>(ByteOf(hn::Mul(light.z, fits)))));
    hn::StoreU(code, DI(), reinterpret_cast<std::int32_t*>(codes + x));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(SoftSkyRow);

void write_soft_sky_row(const SkyMaps& sky, const Clouds& clouds, int y,
                        texture::RgbaImage& codes) {
  SWELL_CHECK(codes.width == kSoftSkySize && y >= 0 && y < codes.height && clouds.any,
              "width={} y={}", codes.width, y);
  HWY_DYNAMIC_DISPATCH(SoftSkyRow)
  (sky, clouds, y, codes.texels.data() + static_cast<std::ptrdiff_t>(y) * codes.stride);
}

}  // namespace swell::render
#endif  // HWY_ONCE
