#include "render/world/sun_texture.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"

namespace swell::render {
namespace {

constexpr double kHaloPart = 0.06, kHaloRadius = 2.5;  // of the spot

// At a distance from the middle, in radii: 0 at the sides.
double light_at(double distance) {
  const double reach = static_cast<double>(SunTexture::kReach);
  const double spot = exp(-0.5 * distance * distance);
  const double from_halo = distance / kHaloRadius;
  const double halo = exp(-0.5 * from_halo * from_halo);
  const double inside = std::max(1.0 - distance * distance / (reach * reach), 0.0);
  return ((1.0 - kHaloPart) * spot + kHaloPart * halo) * inside * inside;
}

}  // namespace

SunTexture make_sun_texture() {
  SunTexture sun_texture;
  texture::resize_image(SunTexture::kSize, SunTexture::kSize, sun_texture.image);
  const double texel = 2.0 * static_cast<double>(SunTexture::kReach) / SunTexture::kSize;
  const double middle = 0.5 * (SunTexture::kSize - 1);
  double sum = 0.0;
  for (int y = 0; y < SunTexture::kSize; ++y)
    for (int x = 0; x < SunTexture::kSize; ++x) {
      const double dx = texel * (x - middle), dy = texel * (y - middle);
      const double root = std::sqrt(light_at(std::sqrt(dx * dx + dy * dy)));
      const auto code = static_cast<std::uint32_t>(std::nearbyint(255.0 * root));
      sun_texture.image.texels[static_cast<std::size_t>(y) * sun_texture.image.stride + x] =
          code * 0x01010101u;
      sum += code / 255.0 * (code / 255.0);
    }
  texture::fill_padding(sun_texture.image);
  sun_texture.whole = static_cast<float>(sum * texel * texel);
  return sun_texture;
}

}  // namespace swell::render
