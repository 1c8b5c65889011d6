#include "render/packets/square_map.h"

#include "math/elementary.h"

namespace swell::render {

SquareMap make_square_map(const texture::PackedMap1& map, double size_m, glm::dvec2 from_corner) {
  const double texels_per_m = map.size / size_m;
  return {.map = &map,
          .texels_fx8_per_m = static_cast<float>(256.0 * texels_per_m),
          .x_eye_fx8 = static_cast<float>(256.0 * texels_per_m * from_corner.x),
          .y_eye_fx8 = static_cast<float>(256.0 * texels_per_m * from_corner.y),
          .log2_texels_per_m = static_cast<float>(log(texels_per_m) * 1.4426950408889634)};
}

}  // namespace swell::render
