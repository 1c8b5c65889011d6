// The light that all materials share, and the media that it passes on its way to the eye.
#pragma once

#include <glm/glm.hpp>

#include "render/parts.h"
#include "render/world/world_state.h"
#include "texture/packed_map.h"

namespace swell::render {

inline constexpr float kCosSunRim = 0.99998f, kCosSunCore = 0.999992f;

// Linear RGB.
struct Light {
  glm::vec3 sun_direction{0, 0, 1};
  glm::vec3 sun_irradiance{1.0f};
  glm::vec3 ambient{0.3f};  // the sky's mean radiance
  glm::vec3 horizon{0.3f};  // its mean round the horizon
  const texture::RgbaImage* sky_sharp = nullptr;
  const texture::RgbMap* sky_soft = nullptr;
};

// What light passes on its way.
struct Media {
  // Air: haze takes the horizon's colour.
  float inv_haze_m = 0.0f;
  // Water.
  float refraction_index = 1.333f;
  glm::vec3 body{0.0f};  // radiance of deep water
  glm::vec3 absorption_per_m{0.0f};
};

Light make_light(const World::State& world);
Media make_media(const World::State& world, const Light& light, PartSet without);

}  // namespace swell::render
