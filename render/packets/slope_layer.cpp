#include "render/packets/slope_layer.h"

#include <algorithm>
#include <cmath>

#include "math/check.h"
#include "math/elementary.h"

namespace swell::render {

float fraction(double x) { return static_cast<float>(x - std::floor(x)); }

namespace {

// `eye` relative to the map's origin.
SlopeLayer lay(const texture::PackedMap2& map, glm::dvec2 length_m, float gain, glm::dvec2 eye) {
  SlopeLayer layer;
  layer.map = &map;
  const double map_fx8 = 256.0 * map.size;
  layer.texels_fx8_per_m = static_cast<float>(map_fx8 / length_m.x);
  layer.y_texels_fx8_per_m = static_cast<float>(map_fx8 / length_m.y);
  layer.x_eye_fx8 = static_cast<float>(map_fx8) * fraction(eye.x / length_m.x);
  layer.y_eye_fx8 = static_cast<float>(map_fx8) * fraction(eye.y / length_m.y);
  const double finest_m = std::min(length_m.x, length_m.y);
  layer.log2_texels_per_m = static_cast<float>(log(map.size / finest_m) * 1.4426950408889634);
  layer.gain = gain;
  layer.coarsest = std::nextafter(static_cast<float>(map.detail_levels), 0.0f);
  const auto lost = [&](int level) {
    return (level < map.detail_levels ? map.lost_variance[level] : map.lost_variance.back()) *
           gain * gain;
  };
  for (int i = 0; i < 2 * SlopeLayer::kTableLevels; ++i) {
    const int level = i % SlopeLayer::kTableLevels;
    layer.lost_variance[i] = lost(level);
    layer.lost_by_next[i] = lost(level + 1) - lost(level);
  }
  return layer;
}

}  // namespace

float lost_variance(const SlopeLayer& layer, float level_m) {
  const float level = std::clamp(level_m + layer.log2_texels_per_m, 0.0f, layer.coarsest);
  const float base = std::floor(level);
  const auto at = static_cast<std::size_t>(base);
  return layer.lost_variance[at] + (level - base) * layer.lost_by_next[at];
}

SlopeLayer make_layer(const texture::PackedMap2& map, double length_m, float gain, glm::dvec2 eye,
                      glm::dvec2 moved_m) {
  return lay(map, glm::dvec2(length_m), gain, eye - moved_m);
}

SlopeLayer make_patch_layer(const texture::PackedMap2& map, glm::dvec2 length_m,
                            const ocean::PatchTiling& tiling, glm::dvec2 eye) {
  SlopeLayer layer = lay(map, length_m, 1.0f, eye);
  layer.tiling = tiling;
  layer.eye_column = ocean::tile_number(std::floor(eye.x / length_m.x));
  layer.eye_row = ocean::tile_number(std::floor(eye.y / length_m.y));
  return layer;
}

SlopeLayer make_square_layer(const texture::PackedMap2& map, double size_m,
                             glm::dvec2 from_corner) {
  SlopeLayer layer = make_layer(map, size_m, 1.0f, from_corner, {});
  layer.x_eye_fx8 = static_cast<float>(256.0 * map.size * from_corner.x / size_m);
  layer.y_eye_fx8 = static_cast<float>(256.0 * map.size * from_corner.y / size_m);
  return layer;
}

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
