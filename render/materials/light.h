// The light that all materials share, and the media that it passes on its way to the eye.
#pragma once

#include <glm/glm.hpp>

#include "render/materials/clouds.h"
#include "render/parts.h"
#include "render/world/world_state.h"
#include "texture/packed_map.h"

namespace swell::render {

// Linear RGB, exposed (but for a gradient's: SkyMaps).
struct Light {
  // Of the sun, or of the moon when the sun is down.
  glm::vec3 sun_direction{0, 0, 1};
  glm::vec3 sun_irradiance{1.0f};  // what clouds leave of it on average
  glm::vec3 disc_radiance{0.0f};
  glm::vec3 ambient{0.3f};  // the sky's mean radiance
  glm::vec3 horizon{0.3f};  // its mean round the horizon
  const texture::SmoothImage* sky_clear = nullptr;
  const texture::RgbMap* sky_soft = nullptr;
  Clouds clouds;
};

// What light passes on its way.
struct Media {
  // Air: haze takes the horizon's colour, and thins with height.
  float inv_haze_m = 0.0f;  // at sea level
  float inv_haze_height_m = 0.0f;
  // Water.
  float refraction_index = 1.333f;
  glm::vec3 body{0.0f};      // radiance of deep water
  glm::vec3 body_sun{0.0f};  // the part of it that is the sun's
  glm::vec3 absorption_per_m{0.0f};
  // For an eye under water.
  bool submerged = false;
  float eye_depth_m = 0.0f;             // under the mean level, at least 0
  glm::vec3 daylight_at_eye{1.0f};      // what is left there of the light that enters
  glm::vec3 scattered{0.0f};            // radiance of a long level way just under the surface
  glm::vec3 daylight_lost_per_m{0.0f};  // of light on its way down
};

// The light that enters comes down at a slant, on so many metres a metre of depth.
inline constexpr float kDaylightSlant = 1.2f;

// clouds: of the frame. soft: the blurred sky with them, to be kept as long as the light.
Light make_light(const World::State& world, const Clouds& clouds, const texture::RgbMap& soft);
Media make_media(const World::State& world, const Light& light, PartSet without);
// The same where an eye at the height eye_z over the mean level is under water.
Media submerge(const Media& media, double eye_z);

}  // namespace swell::render
