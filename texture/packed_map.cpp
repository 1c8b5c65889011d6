#include "texture/packed_map.h"

#include <algorithm>
#include <bit>

#include "math/check.h"
#include "math/large_array.h"

namespace swell::texture {

namespace {

// Texels of a level's block along each axis, as powers of two.
int log2_block_x(int level, BlurAxis axis) {
  return axis == BlurAxis::kX ? level : std::max(level - 1, 0);
}
int log2_block_y(int level, BlurAxis axis) {
  return axis == BlurAxis::kY ? level : std::max(level - 1, 0);
}

int blocks(int texels, int log2_block) { return (texels + (1 << log2_block) - 1) >> log2_block; }

// The mean of four colours, channel by channel, to the nearest.
std::uint32_t mean_of(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  constexpr std::uint32_t kEven = 0x00ff00ffu, kHalf = 0x00020002u;
  const std::uint32_t low = (a & kEven) + (b & kEven) + (c & kEven) + (d & kEven) + kHalf;
  const std::uint32_t high =
      (a >> 8 & kEven) + (b >> 8 & kEven) + (c >> 8 & kEven) + (d >> 8 & kEven) + kHalf;
  return (low >> 2 & kEven) | (high >> 2 & kEven) << 8;
}

}  // namespace

void resize_image(int width, int height, RgbaImage& image, int levels, BlurAxis blur_axis) {
  SWELL_CHECK(width >= 1 && width <= 16384 && height >= 1 && height <= 16384, "size={}x{}", width,
              height);
  SWELL_CHECK(levels >= 1 && levels <= kMostRgbaLevels, "levels={}", levels);
  image.width = width;
  image.height = height;
  image.levels = levels;
  image.blur_axis = blur_axis;
  std::int32_t begin = 0;
  for (int level = 0; level < levels; ++level) {
    const int block_x = log2_block_x(level, blur_axis), block_y = log2_block_y(level, blur_axis);
    const int w = blocks(width, block_x), h = blocks(height, block_y);
    const int stride = (w + 16) / 16 * 16;  // rows of whole cache lines
    const auto at = static_cast<std::size_t>(level);
    image.level_begin[at] = begin, image.level_stride[at] = stride;
    image.last_x[at] = static_cast<float>(w - 1), image.last_y[at] = static_cast<float>(h - 1);
    image.scale_x[at] = 1.0f / static_cast<float>(1 << block_x);
    image.scale_y[at] = 1.0f / static_cast<float>(1 << block_y);
    begin += stride * (h + 1);
  }
  image.stride = image.level_stride[0];
  reserve_large(image.texels, static_cast<std::size_t>(begin));
  image.texels.assign(static_cast<std::size_t>(begin), 0);
}

void fill_padding(RgbaImage& image) {
  for (int level = 0; level < image.levels; ++level) {
    const auto at = static_cast<std::size_t>(level);
    const std::ptrdiff_t stride = image.level_stride[at];
    const int width = static_cast<int>(image.last_x[at]) + 1;
    const int height = static_cast<int>(image.last_y[at]) + 1;
    std::uint32_t* const texels = image.texels.data() + image.level_begin[at];
    for (int y = 0; y < height; ++y) texels[y * stride + width] = texels[y * stride + width - 1];
    std::uint32_t* const last_row = texels + (height - 1) * stride;
    std::copy_n(last_row, width + 1, last_row + stride);
  }
}

void soften_block(int x0, int y0, int x1, int y1, RgbaImage& image) {
  for (int level = 1; level < image.levels; ++level) {
    const auto at = static_cast<std::size_t>(level);
    const int block_x = log2_block_x(level, image.blur_axis);
    const int block_y = log2_block_y(level, image.blur_axis);
    const bool halves_x = block_x > log2_block_x(level - 1, image.blur_axis);
    const bool halves_y = block_y > log2_block_y(level - 1, image.blur_axis);
    const std::ptrdiff_t fine_stride = image.level_stride[at - 1];
    const auto last_x = static_cast<int>(image.last_x[at - 1]);
    const auto last_y = static_cast<int>(image.last_y[at - 1]);
    const std::uint32_t* const fine = image.texels.data() + image.level_begin[at - 1];
    std::uint32_t* const coarse = image.texels.data() + image.level_begin[at];
    const int begin_x = x0 >> block_x, end_x = blocks(x1, block_x);
    const int begin_y = y0 >> block_y, end_y = blocks(y1, block_y);
    // Columns that have both of their halves.
    const int whole_x = halves_x ? std::min(end_x, (last_x + 1) / 2) : end_x;
    for (int y = begin_y; y < end_y; ++y) {
      const int first = halves_y ? 2 * y : y, second = halves_y ? std::min(2 * y + 1, last_y) : y;
      const std::uint32_t* const upper = fine + first * fine_stride;
      const std::uint32_t* const lower = fine + second * fine_stride;
      std::uint32_t* const row = coarse + y * static_cast<std::ptrdiff_t>(image.level_stride[at]);
      if (halves_x) {
        for (int x = begin_x; x < whole_x; ++x)
          row[x] = mean_of(upper[2 * x], upper[2 * x + 1], lower[2 * x], lower[2 * x + 1]);
        if (whole_x < end_x)
          row[whole_x] = mean_of(upper[last_x], upper[last_x], lower[last_x], lower[last_x]);
      } else {
        for (int x = begin_x; x < end_x; ++x)
          row[x] = mean_of(upper[x], upper[x], lower[x], lower[x]);
      }
    }
  }
}

void pack_rgb(const RgbaImage& image, RgbMap& map) {
  SWELL_CHECK(image.width == image.height && image.width <= 4096 &&
                  std::has_single_bit(static_cast<unsigned>(image.width)),
              "size={}x{}", image.width, image.height);
  const int size = image.width;
  map.size = size;
  resize_large(map.words, static_cast<std::size_t>(size) * size);
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
