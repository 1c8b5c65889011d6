#include "math/check.h"
#include "render/sky/sky_frame.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/sky/sky_frame_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
//
#include "render/sky/clouds-inl.h"
#include "render/sky/fog-inl.h"
#include "render/sky/sky_maps.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// The angle over which the clear sky is blurred too: no cloud's edge is sharp in the sea.
constexpr float kSoftAngleLog2 = -4.5f;

HWY_INLINE VI ByteOf(V radiance) {
  const V part = Max(radiance, 0.0f) * (1.0f / kSoftSkyRange);
  const V code = Sqrt(Min(part, 1.0f)) * 255.0f;
  return TruncateToInt(code + 0.5f);
}

HWY_INLINE VI CodeOf(V3 light) {
  const V range = Constant(kSoftSkyRange);
  const V most = Max(light.x, Max(light.y, light.z));
  const V fits = range / Max(most, range);
  return ByteOf(light.x * fits) |
         (hn::ShiftLeft<8>(ByteOf(light.y * fits)) | hn::ShiftLeft<16>(ByteOf(light.z * fits)));
}

// Lays what `volume` has at places of the map before `light`; texels: half of the map's.
HWY_INLINE V3 AddVolume(const CloudSky& volume, V column, V row, V3 light) {
  constexpr float kPart = static_cast<float>(CloudSky::kSide) / kSoftSkySize;
  const auto place = [](V at) HWY_ATTR {
    return Clamp(MulAdd(at, kPart, -0.5f), 0.0f, CloudSky::kSide - 1.001f);
  };
  const V x = place(column), y = place(row);
  const VI i = TruncateToInt(x), j = TruncateToInt(y);
  const V s = x - hn::ConvertTo(D(), i), t = y - hn::ConvertTo(D(), j);
  const VI upper = j * CloudSky::kSide + i;
  const auto read = [&](std::size_t channel) HWY_ATTR {
    const float* const texels = volume.texels[channel].data();
    const auto at = [&](int offset)
                        HWY_ATTR { return hn::GatherIndex(D(), texels, upper + offset); };
    return Lerp(Lerp(at(0), at(1), s), Lerp(at(CloudSky::kSide), at(CloudSky::kSide + 1), s), t);
  };
  const V passes = 1.0f - read(CloudSky::kOpacity);
  return MulAdd(light, passes, {read(0), read(1), read(2)});
}

void SoftSkyRow(const SkyMaps& sky, const Clouds& clouds, const CloudSky& volume, const Fog& fog,
                int y, std::uint32_t* codes, std::uint32_t* foggy_codes) {
  const D d;
  constexpr float kStep = 2.0f / kSoftSkySize;
  constexpr std::size_t kChannel = static_cast<std::size_t>(kSoftSkySize) * kSoftSkySize;
  const V v = Constant(kStep * (static_cast<float>(y) + 0.5f) - 1.0f);
  const V one = Constant(1.0f);
  for (int x = 0; x < kSoftSkySize; x += static_cast<int>(hn::Lanes(d))) {
    const V column = hn::ConvertTo(d, CountFrom(x)) + 0.5f;
    const V u = MulSub(column, kStep, one);
    // Outside the horizon's circle: as at the horizon.
    const V r2 = MulAdd(u, u, v * v);
    const V z = Max((one - r2) / (one + r2), 0.0f);
    const V across = Sqrt(NegMulAdd(z, z, one) / Max(r2, 1e-12f));
    const std::size_t at = static_cast<std::size_t>(y) * kSoftSkySize + static_cast<std::size_t>(x);
    const float* clear = sky.soft_clear.data() + at;
    const V3 direction = {u * across, v * across, z};
    V3 light = {hn::LoadU(d, clear), hn::LoadU(d, clear + kChannel),
                hn::LoadU(d, clear + 2 * kChannel)};
    if (clouds.any) {
      V passes;
      const CloudView view = ViewClouds(clouds, direction, Constant(kSoftAngleLog2));
      light =
          AddClouds(clouds, view, SampleClouds(clouds, view.x, view.y, view.level), light, passes);
    }
    if (volume.any)
      light = AddVolume(volume, column, Constant(static_cast<float>(y) + 0.5f), light);
    hn::StoreU(CodeOf(light), DI(), reinterpret_cast<std::int32_t*>(codes + x));
    if (!fog.on) continue;
    const V3 foggy = SkyThroughFog(fog, fog.at_sea, direction, light);
    hn::StoreU(CodeOf(foggy), DI(), reinterpret_cast<std::int32_t*>(foggy_codes + x));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(SoftSkyRow);

void write_soft_sky_row(const SkyMaps& sky, const Clouds& clouds, const CloudSky& volume,
                        const Fog& fog, int y, texture::RgbaImage& clear,
                        texture::RgbaImage& foggy) {
  for (const texture::RgbaImage* const codes : {&clear, &foggy})
    SWELL_CHECK(codes->width == kSoftSkySize && y >= 0 && y < codes->height, "width={} y={}",
                codes->width, y);
  const auto row_of = [&](texture::RgbaImage& codes) {
    return codes.texels.data() + static_cast<std::ptrdiff_t>(y) * codes.stride;
  };
  HWY_DYNAMIC_DISPATCH(SoftSkyRow)(sky, clouds, volume, fog, y, row_of(clear), row_of(foggy));
}

}  // namespace swell::render
#endif  // HWY_ONCE
