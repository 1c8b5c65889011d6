// Random images, and what their texels hold.
#pragma once

#include <algorithm>
#include <cstdint>

#include "math/random.h"
#include "texture/packed_map.h"

namespace swell::texture {

inline RgbaImage random_image(int width, int height, std::uint64_t seed) {
  RgbaImage image;
  resize_image(width, height, image);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.texels[static_cast<std::size_t>(y) * image.stride + x] =
          static_cast<std::uint32_t>(random_bits(seed, y * width + x));
    }
  }
  fill_padding(image);
  return image;
}

// One of a texel's bytes, 0 to 3; beyond the image, of the nearest texel.
inline int channel(const RgbaImage& image, int x, int y, int c) {
  x = std::clamp(x, 0, image.width - 1);
  y = std::clamp(y, 0, image.height - 1);
  return image.texels[static_cast<std::size_t>(y) * image.stride + x] >> (8 * c) & 0xff;
}

}  // namespace swell::texture
