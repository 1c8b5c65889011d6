#include "render/packets/tint.h"

#include "math/check.h"

namespace swell::render {

void pack_tint(int size, std::span<const std::vector<float>> channels, TintMaps& maps) {
  constexpr float kScale = 1.0f / 127.0f;
  SWELL_CHECK(channels.size() == 1 || channels.size() == 3, "channels={}", channels.size());
  const std::vector<float>& red = channels.front();
  texture::pack_map2(size, red, channels.size() == 1 ? red : channels[1], kScale, maps.red_green);
  if (channels.size() == 3)
    texture::pack_map2(size, channels[2], channels[2], kScale, maps.blue);
  else
    maps.blue.size = 0;
}

TintLayer make_tint(const TintMaps& maps, double length_m, glm::dvec2 eye) {
  const bool is_grey = maps.blue.size == 0;
  return {make_layer(maps.red_green, length_m, 1.0f, eye, {}),
          make_layer(is_grey ? maps.red_green : maps.blue, length_m, 1.0f, eye, {})};
}

}  // namespace swell::render
