// Open water without waves, for tests of what its shader makes of light.
#pragma once

#include <algorithm>
#include <vector>

#include "render/materials/list.h"
#include "render/shade/shade_tile.h"
#include "texture/packed_map.h"

namespace swell::render {

// Open water of one roughness under a sky of one colour.
struct PlainSea {
  PlainSea(double sky_code, float variance) {
    texture::RgbaImage image;
    texture::resize_image(16, 16, image);
    const auto code = static_cast<std::uint32_t>(sky_code);
    std::ranges::fill(image.texels, code * 0x010101u);
    sky = texture::pack_rgb(image);
    const std::vector<float> zero(16 * 16);
    texture::pack_map2(16, zero, zero, 1.0f / 127.0f, still);
    shading.light.sky_soft = &sky;
    shading.light.sun_irradiance = glm::vec3(0.0f);
    shading.rays.eye_z = 2.0f;
    auto& water = std::get<Water>(shading.materials);
    water.uv_noise.map = &still;
    water.base_variance = variance;
    water.optics.inv_crest_height = 1.0f;
  }
  void set_sun(glm::vec3 direction, glm::vec3 irradiance) {
    shading.light.sun_direction = direction;
    shading.light.sun_irradiance = irradiance;
    std::get<Water>(shading.materials).optics.glitter_light = irradiance;
  }

  texture::RgbMap sky;
  texture::PackedMap2 still;
  ViewShading shading;
};

}  // namespace swell::render
