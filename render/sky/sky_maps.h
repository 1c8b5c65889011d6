// The sky of a world as maps.
#pragma once

#include <glm/glm.hpp>
#include <tuple>
#include <vector>

#include "math/parallel.h"
#include "texture/packed_map.h"
#include "texture/smooth_image.h"

namespace swell::sky {
struct Atmosphere;
struct FoggyAir;
struct Sky;
}  // namespace swell::sky

namespace swell::render {

// Cover and light of the clouds, constants of a world.
struct CloudLight {
  float threshold = 0.0f;  // of the noise over its deviation: what is above is cloud
  float overcast = 0.0f;   // 0 as a rule, 1 where no gap is left
  float loss = 0.15f;      // 1 / (1 + loss depth) of the light that falls on clouds comes through
  float mean_opacity = 0.0f, direct_part = 1.0f;  // means over the sky
  glm::vec3 to_light{0, 0, 1};
  // Linear RGB radiances.
  glm::vec3 base{0.0f};     // of a bright side, where light comes through
  glm::vec3 tops{0.0f};     // of the same, seen from above
  glm::vec3 forward{0.0f};  // times the phase function: light that goes straight on
  glm::vec3 mean_radiance{0.0f};

  auto fields() {
    return std::tie(threshold, overcast, loss, mean_opacity, direct_part, to_light, base, tops,
                    forward, mean_radiance);
  }
};

// Radiance in the blurred sky is stored as sqrt(radiance / kSoftSkyRange) * 255; what is brighter
// keeps its hue.
inline constexpr float kSoftSkyRange = 4.0f;
inline constexpr int kSoftSkySize = 128;

// The map of a clear sky, kSkyColumns x (kSkyRows + kAirRows). It is the same on both sides of the
// light's azimuth: column 0 has that azimuth, the last one the opposite, and the root of
// sin(azimuth / 2) grows evenly. Row 0 is the zenith and row kSkyRows - 1 the horizon, where the
// rows are closest; the rows after that go from the horizon to straight down, and hold the air
// before the sea (sky::sky_radiance). render/sky/sky_map-inl.h says where a direction lies.
inline constexpr int kSkyColumns = 128, kSkyRows = 192, kAirRows = 64;

// The clear sky as an eye at a height sees it, exposed.
struct SkyAtHeight {
  double height_m = 0.0;
  texture::SmoothImage map;
  glm::vec3 disc_radiance{0.0f};      // of the light
  glm::vec3 sun_disc_radiance{0.0f};  // of the sun
  // What the eye adapts to over what it does at sea level, at least 1: from high up the sun may
  // still shine, or the sky glow, when it is night below.
  float exposure = 1.0f;

  auto fields() { return std::tie(height_m, map, disc_radiance, sun_disc_radiance, exposure); }
};

// The sky, exposed. The blurred map shows the upper hemisphere: direction d of length 1 lies at
// r = |d.xy| / (1 + d.z) from its middle, and the horizon is the circle of radius size / 2.
struct SkyMaps {
  std::vector<SkyAtHeight> heights;  // what the eye sees behind the clouds, sea level first
  glm::vec2 azimuth{0, 1};           // the light's, of length 1
  std::vector<float> soft_clear;     // blurred at sea level, kSoftSkySize^2 reds, greens, blues
  texture::RgbMap soft;              // the same as a map, for a sky without clouds
  texture::PackedMap2 clouds;        // noise
  float cloud_variance = 0.0f;
  CloudLight cloud_light;
  glm::vec3 ambient{0.0f};  // mean radiance of the upper hemisphere, cosine-weighted
  glm::vec3 horizon{0.0f};  // mean radiance round the horizon
  // The light is the sun, or the moon when the sun is down.
  glm::vec3 to_light{0, 0, 1};
  glm::vec3 irradiance{0.0f};       // under the clouds
  glm::vec3 to_sun{0, 0, 1};        // also when it is down
  glm::vec3 molecules_per_m{0.0f};  // what air alone scatters at sea level
  float exposure = 1.0f;            // that is still to be applied: a gradient's
  float stored_exposure = 1.0f;     // that has been applied

  auto fields() {
    return std::tie(heights, azimuth, soft_clear, soft, clouds, cloud_variance, cloud_light,
                    ambient, horizon, to_light, irradiance, to_sun, molecules_per_m, exposure,
                    stored_exposure);
  }
};

// What fog makes of the light over it: sky::FogLight of each channel, exposed.
struct FogLights {
  glm::vec3 even{0.0f}, ambient{0.0f};
  glm::vec3 even_sun{0.0f}, ambient_sun{0.0f};  // the parts that are the sun's
};

// atmosphere: of the sky's turbidity; of a painted sky any. The same bits with any workers.
SkyMaps build_sky_maps(const sky::Sky& sky, const sky::Atmosphere& atmosphere, Workers& workers);
FogLights light_fog(const sky::FoggyAir& air, const SkyMaps& sky);

}  // namespace swell::render
