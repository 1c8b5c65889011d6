#include "texture/smooth_image.h"

#include <algorithm>
#include <cmath>

#include "math/check.h"

namespace swell::texture {

SmoothImage make_smooth_image(std::span<const float> rgb, int size, float range) {
  const std::size_t texels = static_cast<std::size_t>(size) * size;
  SWELL_CHECK(size >= 2 && size <= 4096 && rgb.size() == 3 * texels, "size={} floats={}", size,
              rgb.size());
  const auto code = [&](float value) {
    const float root = std::sqrt(std::clamp(value / range, 0.0f, 1.0f));
    return static_cast<std::uint32_t>(root * 65535.0f + 0.5f);
  };
  SmoothImage image{size, range, {}};
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<std::uint32_t>& words = image.channels[c];
    words.resize(texels);
    for (std::size_t i = 0; i < texels; ++i) words[i] = code(rgb[3 * i + c]);
    for (std::size_t i = 0; i < texels; ++i) {
      const bool is_last = (i + 1) % static_cast<std::size_t>(size) == 0;
      words[i] |= (is_last ? words[i] : words[i + 1] & 0xffff) << 16;
    }
  }
  return image;
}

}  // namespace swell::texture
