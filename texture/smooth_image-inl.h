// The sampler of SmoothImage.
#if defined(SWELL_TEXTURE_SMOOTH_IMAGE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SWELL_TEXTURE_SMOOTH_IMAGE_INL_H_
#undef SWELL_TEXTURE_SMOOTH_IMAGE_INL_H_
#else
#define SWELL_TEXTURE_SMOOTH_IMAGE_INL_H_
#endif

#include <hwy/highway.h>

#include "math/elementary-inl.h"
#include "math/lanes-inl.h"
#include "texture/smooth_image.h"

HWY_BEFORE_NAMESPACE();
namespace swell::texture {
namespace HWY_NAMESPACE {
using namespace swell::HWY_NAMESPACE;  // lanes

// Samples `image` bilinearly at (x, y), in texels from the first one's centre, clamped to the
// image; not NaN.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void SampleSmooth(D d, const SmoothImage& image, V x, V y, V& r, V& g, V& b) {
  const hn::RebindToSigned<D> di;
  const V zero = hn::Zero(d);
  x = Min(Max(x, zero), static_cast<float>(image.width - 1));
  y = Min(Max(y, zero), static_cast<float>(image.height - 1));
  const auto column = Min(swell::HWY_NAMESPACE::TruncateToInt(x), hn::Set(di, image.width - 2));
  const auto row = Min(swell::HWY_NAMESPACE::TruncateToInt(y), hn::Set(di, image.height - 2));
  const V right = x - hn::ConvertTo(d, column), below = y - hn::ConvertTo(d, row);
  const auto upper = row * image.width + column;
  const auto lower = upper + image.width;
  const V scale = hn::Set(d, image.range / (65535.0f * 65535.0f));

  const auto along_row = [&](const std::int32_t* words, auto index) HWY_ATTR {
    const auto word = hn::GatherIndex(di, words, index);
    const V left = hn::ConvertTo(d, word & 0xffff);
    const hn::RebindToUnsigned<D> du;
    const auto high = hn::ShiftRight<16>(hn::BitCast(du, word));
    const V next = hn::ConvertTo(d, hn::BitCast(di, high));
    return MulAdd(next - left, right, left);
  };
  const auto channel = [&](std::size_t c) HWY_ATTR {
    const auto* words = reinterpret_cast<const std::int32_t*>(image.channels[c].data());
    const V top = along_row(words, upper);
    const V code = MulAdd(along_row(words, lower) - top, below, top);
    return code * code * scale;
  };
  r = channel(0);
  g = channel(1);
  b = channel(2);
}

}  // namespace HWY_NAMESPACE
}  // namespace swell::texture
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
