#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "texture/uv_noise_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <span>

#include "math/check.h"
#include "texture/uv_noise.h"
//
#include "math/elementary-inl.h"
#include "math/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace swell::texture {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

void unit_vectors(const float* HWY_RESTRICT turns, std::size_t count, float* HWY_RESTRICT cos_out,
                  float* HWY_RESTRICT sin_out) {
  const hn::ScalableTag<float> d;
  hn::Vec<decltype(d)> sin, cos;
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
    swell::HWY_NAMESPACE::SinCosTurns(d, hn::LoadU(d, turns + i), sin, cos);
    hn::StoreU(cos, d, cos_out + i);
    hn::StoreU(sin, d, sin_out + i);
  }
  const hn::CappedTag<float, 1> d1;
  hn::Vec<decltype(d1)> sin1, cos1;
  for (; i < count; ++i) {
    swell::HWY_NAMESPACE::SinCosTurns(d1, hn::LoadU(d1, turns + i), sin1, cos1);
    hn::StoreU(cos1, d1, cos_out + i);
    hn::StoreU(sin1, d1, sin_out + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::texture
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swell::texture {

HWY_EXPORT(unit_vectors);

void write_unit_vectors(std::span<const float> turns, std::span<float> cos_out,
                        std::span<float> sin_out) {
  SWELL_CHECK(cos_out.size() == turns.size() && sin_out.size() == turns.size(), "turns={} {} {}",
              turns.size(), cos_out.size(), sin_out.size());
  HWY_DYNAMIC_DISPATCH(unit_vectors)(turns.data(), turns.size(), cos_out.data(), sin_out.data());
}

}  // namespace swell::texture
#endif  // HWY_ONCE
