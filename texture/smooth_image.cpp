#include "texture/smooth_image.h"

#include <algorithm>
#include <cmath>

#include "math/check.h"

namespace swell::texture {

SmoothImage make_smooth_image(std::span<const float> rgb, int width, int height, float range) {
  const std::size_t texels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  SWELL_CHECK(
      width >= 2 && width <= 4096 && height >= 2 && height <= 4096 && rgb.size() == 3 * texels,
      "width={} height={} floats={}", width, height, rgb.size());
  const auto code = [&](float value) {
    const float root = std::sqrt(std::clamp(value / range, 0.0f, 1.0f));
    return static_cast<std::uint32_t>(root * 65535.0f + 0.5f);
  };
  SmoothImage image{width, height, range, {}};
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<std::uint32_t>& words = image.channels[c];
    words.resize(texels);
    for (std::size_t i = 0; i < texels; ++i) words[i] = code(rgb[3 * i + c]);
    for (std::size_t i = 0; i < texels; ++i) {
      const bool is_last = (i + 1) % static_cast<std::size_t>(width) == 0;
      words[i] |= (is_last ? words[i] : words[i + 1] & 0xffff) << 16;
    }
  }
  return image;
}

void blend_rows(const SmoothImage& a, const SmoothImage& b, float part, int first_row, int end_row,
                SmoothImage& result) {
  const auto code = [part](std::uint32_t from, std::uint32_t to) {
    const auto x = static_cast<float>(static_cast<std::int32_t>(from));
    const auto y = static_cast<float>(static_cast<std::int32_t>(to));
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(x + part * (y - x) + 0.5f));
  };
  const std::size_t begin = static_cast<std::size_t>(first_row) * a.width;
  const std::size_t end = static_cast<std::size_t>(end_row) * a.width;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::uint32_t *from = a.channels[c].data(), *to = b.channels[c].data();
    std::uint32_t* words = result.channels[c].data();
    for (std::size_t i = begin; i < end; ++i)
      words[i] = code(from[i] & 0xffff, to[i] & 0xffff) | code(from[i] >> 16, to[i] >> 16) << 16;
  }
}

}  // namespace swell::texture
