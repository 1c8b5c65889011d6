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

void pack_rgb(const RgbaImage& image, RgbMap& map) {
  SWELL_CHECK(image.width == image.height && image.width <= 4096 &&
                  std::has_single_bit(static_cast<unsigned>(image.width)),
              "size={}x{}", image.width, image.height);
  const int size = image.width;
  map.size = size;
  map.words.resize(static_cast<std::size_t>(size) * size);
  for (int y = 0; y < size; ++y) {
    const std::uint32_t* upper =
        image.texels.data() + static_cast<std::ptrdiff_t>(y) * image.stride;
    const std::uint32_t* lower = upper + (y + 1 < size ? image.stride : 0);
    for (int x = 0; x < size; ++x) {
      const int next = std::min(x + 1, size - 1);
      RgbWord& word = map.words[static_cast<std::size_t>(y) * size + x];
      const std::array<std::uint32_t, 4> texels = {upper[x], upper[next], lower[x], lower[next]};
      for (std::size_t n = 0; n < 12; ++n)
        word.bytes[n] = static_cast<std::int8_t>((texels[n % 4] >> (8 * (n / 4)) & 0xff) ^ 0x80);
    }
  }
}

RgbMap pack_rgb(const RgbaImage& image) {
  RgbMap map;
  pack_rgb(image, map);
  return map;
}

}  // namespace swell::texture
