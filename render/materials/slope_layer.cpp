#include "render/materials/slope_layer.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"

namespace swell::render {

float fraction(double x) { return static_cast<float>(x - std::floor(x)); }

SlopeLayer make_layer(const texture::PackedMap2& map, double length_m, float gain, glm::dvec2 eye,
                      glm::dvec2 moved_m) {
  SlopeLayer layer;
  layer.map = &map;
  layer.inv_length = static_cast<float>(1.0 / length_m);
  layer.u_eye = fraction((eye.x - moved_m.x) / length_m);
  layer.v_eye = fraction((eye.y - moved_m.y) / length_m);
  layer.log2_texels_per_m = static_cast<float>(log(map.size / length_m) * 1.4426950408889634);
  layer.gain = gain;
  // The two coarsest levels (1 and 4 texels) hold nothing worth a sample.
  layer.levels = std::clamp(map.levels - 2, 1, kTableLevels - 1);
  for (int i = 0; i < 2 * kTableLevels; ++i) {
    const int level = i % kTableLevels;
    const float lost = level < layer.levels ? map.lost_variance[level] : map.lost_variance.back();
    layer.lost_variance[i] = lost * gain * gain;
  }
  return layer;
}

SlopeLayer make_square_layer(const texture::PackedMap2& map, double size_m,
                             glm::dvec2 from_corner) {
  SlopeLayer layer = make_layer(map, size_m, 1.0f, from_corner, {});
  layer.u_eye = static_cast<float>(from_corner.x / size_m);
  layer.v_eye = static_cast<float>(from_corner.y / size_m);
  return layer;
}

}  // namespace swell::render
