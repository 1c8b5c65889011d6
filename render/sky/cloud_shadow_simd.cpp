#include <array>

#include "math/check.h"
#include "render/sky/cloud_shadow.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/sky/cloud_shadow_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
//
#include "render/sky/cloud_volume-inl.h"
#include "render/sky/cloud_volume.h"
#include "render/sky/clouds-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::render {
namespace HWY_NAMESPACE {

// What a deck leaves of the sun, over its mean.
HWY_INLINE V LightUnderDeck(const CloudShadowRow& in, V x, V y) {
  const Clouds& deck = *in.deck;
  const V level = Log2Coarse(D(), Constant(in.texel_m));
  const CloudNoise noise =
      SampleClouds(deck, x + in.slant.x * deck.height_m, y + in.slant.y * deck.height_m, level);
  const V passes = Exp(D(), -OpticalDepth(deck, noise));
  return Lerp(passes * (1.0f / in.deck_lit), Constant(1.0f), Constant(deck.light.overcast));
}

HWY_INLINE V LightUnderVolume(const CloudShadowRow& in, V x, V y) {
  const DI di;
  const CloudVolume& volume = *in.volume->volume;
  const V per_m = Constant(static_cast<float>(1.0 / volume.voxel_m));
  const LatticePlace px =
      PlaceOnLattice(MulAdd(x + in.slant.x * volume.base_m, per_m, in.volume->eye_voxel.x));
  const LatticePlace py =
      PlaceOnLattice(MulAdd(y + in.slant.y * volume.base_m, per_m, in.volume->eye_voxel.y));
  const int n = volume.form.side_log2;
  const VI wrap = hn::Set(di, volume.form.side() - 1), one = hn::Set(di, 1);
  const auto at = [&](VI i, VI j) HWY_ATTR {
    const VI index = hn::ShiftLeftSame(j & wrap, n) + (i & wrap);
    return hn::GatherIndex(D(), volume.sunlight.data(), index);
  };
  const VI right = px.cell + one, up = py.cell + one;
  const V light = Lerp(Lerp(at(px.cell, py.cell), at(right, py.cell), px.part),
                       Lerp(at(px.cell, up), at(right, up), px.part), py.part);
  if (volume.repeats) return light;
  const auto inside = [&](VI cell) HWY_ATTR { return (cell > -1) & (cell < wrap); };
  const auto both = inside(px.cell) & inside(py.cell);
  return IfThenElse(hn::RebindMask(D(), both), light, 1.0f);
}

void CloudShadowRowOf(const CloudShadowRow& in, std::uint8_t* row) {
  const D d;
  for (int x = 0; x <= CloudShadow::kSide; x += static_cast<int>(hn::Lanes(d))) {
    const V x_m = MulAdd(hn::ConvertTo(d, CountFrom(x)), in.texel_m, in.first_m.x);
    const V y_m = Constant(in.first_m.y);
    V light = Constant(1.0f);
    if (in.deck) light = LightUnderDeck(in, x_m, y_m);
    if (in.volume) light = light * LightUnderVolume(in, x_m, y_m);
    const V part = Clamp(light * (1.0f / in.most), 0.0f, 1.0f);
    HWY_ALIGN std::array<std::int32_t, hn::MaxLanes(d)> values;
    hn::Store(TruncateToInt(MulAdd(part, 255.0f, 0.5f)), DI(), values.data());
    for (std::size_t i = 0; i < values.size(); ++i)
      row[static_cast<std::size_t>(x) + i] = static_cast<std::uint8_t>(values[i]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::render {

HWY_EXPORT(CloudShadowRowOf);

void write_cloud_shadow_row(const CloudShadowRow& in, std::uint8_t* row) {
  SWELL_CHECK(in.deck || in.volume, "no clouds");
  HWY_DYNAMIC_DISPATCH(CloudShadowRowOf)(in, row);
}

}  // namespace swell::render
#endif  // HWY_ONCE
