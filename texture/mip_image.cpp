#include "texture/mip_image.h"

#include "math/check.h"
#include "texture/srgb.h"

namespace swell::texture {
namespace {

std::array<float, 256> make_linear_table() {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double code = static_cast<double>(i) / 255.0;
    table[i] = static_cast<float>(linear_of_srgb(code));
  }
  return table;
}

// The byte whose linear value is nearest.
std::uint32_t byte_of(float linear, const std::array<float, 256>& table) {
  const auto above = std::lower_bound(table.begin(), table.end(), linear);
  if (above == table.begin()) return 0;
  if (above == table.end()) return 255;
  const auto nearest = linear - above[-1] < *above - linear ? above - 1 : above;
  return static_cast<std::uint32_t>(nearest - table.begin());
}

// The mean of the two by two texels, or two, or one, that become the texel (x, y).
std::uint32_t shrunk_texel(const MipImage& image, const MipImage::Level& fine, int x, int y) {
  const std::array<float, 256>& table = image.linear;
  glm::vec3 sum(0.0f);
  const int x1 = std::min(2 * x + 1, fine.width - 1), y1 = std::min(2 * y + 1, fine.height - 1);
  for (const int j : {std::min(2 * y, y1), y1})
    for (const int i : {std::min(2 * x, x1), x1}) {
      const std::uint32_t word =
          image.texels[fine.first + static_cast<std::uint32_t>(j * fine.width + i)];
      sum += glm::vec3(table[word & 255], table[word >> 8 & 255], table[word >> 16 & 255]);
    }
  sum *= 0.25f;
  return byte_of(sum.x, table) | byte_of(sum.y, table) << 8 | byte_of(sum.z, table) << 16 |
         0xff000000u;
}

}  // namespace

MipImage make_mip_image(int width, int height, std::span<const std::uint32_t> texels) {
  SWELL_CHECK(width >= 1 && width <= 16384 && height >= 1 && height <= 16384 &&
                  texels.size() == static_cast<std::size_t>(width) * height,
              "{}x{}, {} texels", width, height, texels.size());
  MipImage image;
  image.linear = make_linear_table();
  image.levels.push_back({width, height, 0});
  image.texels.assign(texels.begin(), texels.end());
  while (image.levels.back().width > 1 || image.levels.back().height > 1) {
    const MipImage::Level fine = image.levels.back();
    const MipImage::Level next{std::max(fine.width / 2, 1), std::max(fine.height / 2, 1),
                               static_cast<std::uint32_t>(image.texels.size())};
    for (int y = 0; y < next.height; ++y)
      for (int x = 0; x < next.width; ++x) image.texels.push_back(shrunk_texel(image, fine, x, y));
    image.levels.push_back(next);
  }
  return image;
}

}  // namespace swell::texture
