// The light that all materials share, and the media that it passes on its way to the eye.
#pragma once

#include <glm/glm.hpp>

#include "render/frame/parts.h"
#include "render/sky/clouds.h"
#include "render/sky/fog.h"
#include "render/sky/stars.h"
#include "texture/packed_map.h"

namespace swell::render {

struct CloudShadow;
struct SkyFrame;
struct WorldState;

// The sky that water mirrors as it is, where it is calm: clear or with clouds of a layer, without
// volumetric ones or fog before it, and in a wind that leaves water so calm.
struct CalmMirror {
  const texture::SmoothImage* sky = nullptr;  // the clear one at sea level (SkyMaps); none: off
  glm::vec2 azimuth{0, 1};
  const Clouds* clouds = nullptr;  // as seen from the sea under the eye; none: it is clear
  float pixel_angle = 1e-3f;
};
// Slope variance, of both axes together, from which on water mirrors the blurred sky alone: less
// than that of a breeze. Rays up and down are spread over 5 degrees then, two deviations.
inline constexpr float kCalmVariance = 1.0f / 1024.0f;

// Linear RGB, exposed (but for a gradient's: SkyMaps).
struct Light {
  // The light is the sun, or the moon when the sun is down.
  glm::vec3 sun_direction{0, 0, 1};
  glm::vec3 sun_irradiance{1.0f};             // what clouds leave of it on average
  glm::vec3 ambient{0.3f};                    // the sky's mean radiance
  glm::vec3 horizon{0.3f};                    // its mean round the horizon
  const texture::RgbMap* sky_soft = nullptr;  // blurred, through fog
  const texture::RgbMap* haze_sky = nullptr;  // the same without fog: what haze fades to

  // The sky as the eye sees it from its height.
  const texture::SmoothImage* sky_map = nullptr;
  glm::vec2 sky_azimuth{0, 1};
  float horizon_sine = 0.0f;
  glm::vec3 to_disc{0, 0, 1}, disc_radiance{0.0f};
  // The direction from the moon to the sun, where the disc is that of a moon which is not full.
  glm::vec3 disc_lit_from{0, 0, -1};
  bool moon_has_phase = false;
  float exposure = 1.0f;  // of the picture, still to be applied
  Clouds clouds;
  Stars stars;
  CalmMirror calm;
  const CloudShadow* cloud_shadow = nullptr;  // none: clouds dim all alike
  // The part of `ambient` that fog scatters down of the sun's light, where clouds shade it; else 0.
  float fog_ambient = 0.0f;
};

// What light passes on its way.
struct Media {
  // Air: haze takes the horizon's colour, and thins with height.
  float inv_haze_m = 0.0f;  // at sea level
  float inv_haze_height_m = 0.0f;
  // The air's molecules, which the haze of sea level stands for, too; 0: the eye is not high enough
  // to see more of them than that.
  glm::vec3 molecules_per_m{0.0f};
  float cloudy = 0.0f;  // how far the air is lit by an overcast sky, [0, 1]
  Fog fog;
  // Water.
  float refraction_index = 1.333f;
  bool paper_refraction = false;  // scene::RefractionModel::kPaper
  glm::vec3 body{0.0f};           // radiance of deep water
  glm::vec3 body_sun{0.0f};       // the part of it that is the sun's
  glm::vec3 absorption_per_m{0.0f};
  // For an eye under water.
  bool submerged = false;
  float water_level_m = 0.0f;           // of the water that it is in: the sea's is 0
  float eye_depth_m = 0.0f;             // under that level, at least 0
  glm::vec3 daylight_at_eye{1.0f};      // what is left there of the light that enters
  glm::vec3 scattered{0.0f};            // radiance of a long level way just under the surface
  glm::vec3 daylight_lost_per_m{0.0f};  // of light on its way down
};

// The light that enters comes down at a slant, on so many metres a metre of depth.
inline constexpr float kDaylightSlant = 1.2f;

// clouds, sky: of the frame; the sky to be kept as long as the light. ripple_variance: of the
// slopes of ripples too fine for any map (tile/ripples.h).
Light make_light(const WorldState& world, const Clouds& clouds, const SkyFrame& sky, const Fog& fog,
                 float ripple_variance);
// height_m: sky_height_m().
Media make_media(const WorldState& world, const Light& light, const Fog& fog, double height_m,
                 PartSet without);
// Returns the media for an eye at the height eye_z in water of this level, both over the sea's.
Media submerge(const Media& media, double eye_z, float water_level_m = 0.0f);

}  // namespace swell::render
