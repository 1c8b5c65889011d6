#include "texture/packed_map.h"

#include <algorithm>

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

}  // namespace swell::texture
