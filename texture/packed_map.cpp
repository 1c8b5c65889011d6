#include "texture/packed_map.h"

#include <algorithm>
#include <bit>

#include "math/check.h"

namespace swell::texture {

void resize_image(int width, int height, RgbaImage& image) {
  SWELL_CHECK(width >= 1 && width <= 16384 && height >= 1 && height <= 16384, "size={}x{}", width,
              height);
  image.width = width;
  image.height = height;
  image.stride = (width + 16) / 16 * 16;  // rows of whole cache lines
  image.texels.assign(static_cast<std::size_t>(image.stride) * (height + 1), 0);
}

void fill_padding(RgbaImage& image) {
  const std::size_t stride = static_cast<std::size_t>(image.stride);
  for (int y = 0; y < image.height; ++y) {
    std::uint32_t* const row = image.texels.data() + y * stride;
    row[image.width] = row[image.width - 1];
  }
  const auto last_row =
      image.texels.begin() + static_cast<std::ptrdiff_t>(stride) * (image.height - 1);
  std::copy_n(last_row, image.width + 1, last_row + image.stride);
}

RgbMap pack_rgb(const RgbaImage& image) {
  SWELL_CHECK(image.width == image.height && image.width <= 4096 &&
                  std::has_single_bit(static_cast<unsigned>(image.width)),
              "size={}x{}", image.width, image.height);
  const int size = image.width;
  RgbMap map{size, {}};
  map.words.reserve(static_cast<std::size_t>(size) * size);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      RgbWord word{};
      for (int n = 0; n < 12; ++n) {
        const int at_x = std::min(x + n % 2, size - 1), at_y = std::min(y + n / 2 % 2, size - 1);
        const std::uint32_t texel =
            image.texels[static_cast<std::size_t>(at_y) * image.stride + at_x];
        const auto code = static_cast<int>(texel >> (8 * (n / 4)) & 0xff);
        word.bytes[static_cast<std::size_t>(n)] = static_cast<std::int8_t>(code - 128);
      }
      map.words.push_back(word);
    }
  }
  return map;
}

}  // namespace swell::texture
