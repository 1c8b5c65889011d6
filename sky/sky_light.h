// The sky as a function of direction, without its clouds and the sun's disc: what the renderer
// tabulates once per scene.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "sky/atmosphere.h"
#include "sky/sky.h"

namespace swell::sky {

// The unit vector towards azimuth_rad (clockwise from north) and elevation_rad (up positive).
glm::vec3 sun_direction(double azimuth_rad, double elevation_rad);

// Towards the moon.
glm::vec3 moon_direction(const Sky& sky);

// ---- A painted sky

// How far the gradient goes on beyond sky.horizon: at the horizon itself the sky's radiance is
// (1 + kBeyondHorizon) horizon - kBeyondHorizon zenith, which must not be negative.
inline constexpr float kBeyondHorizon = 0.15f;

// Linear RGB.
struct GradientSky {
  glm::vec3 sun_radiance{1.0f};            // irradiance scale of direct light
  glm::vec3 zenith{0.10f, 0.25f, 0.60f};   // radiance overhead
  glm::vec3 horizon{0.65f, 0.75f, 0.85f};  // the same about 1 degree above the horizon
};

bool is_gradient(const Sky& sky);
// With the defaults for what the sky does not have.
GradientSky gradient_of(const Sky& sky);

// Radiance in `direction` (world, any length but 0), finite and >= 0: a gradient from horizon to
// zenith, warm and bright around the sun. Below the horizon: the horizon's colour. Thread safe.
glm::vec3 gradient_radiance(const Sky& sky, glm::vec3 direction);

// ---- Any sky

// Radiances are linear RGB with a luminance of 1 for 10 000 cd/m^2; a gradient's have a unit of
// their own.
struct SkyLight {
  // The one light that throws shadows: the sun; the moon when the sun is down; or none, 0.
  glm::vec3 to_light{0, 0, 1};
  glm::vec3 irradiance{0.0f};         // at sea level, of a surface turned to it
  glm::vec3 cloud_irradiance{0.0f};   // the same at the height of clouds
  glm::vec3 disc_radiance{0.0f};      // of its disc, were it above the horizon as a whole
  glm::vec3 sun_disc_radiance{0.0f};  // the same of the sun, which may be down at sea level alone

  // Where the radiance of the clear sky comes from.
  struct Source {
    SkyTable table;
    glm::vec3 irradiance{0.0f};  // outside the air
  };
  std::vector<Source> sources;  // none: a gradient
  Atmosphere atmosphere;        // but for a gradient
  Sky sky;
};

inline constexpr double kCloudHeight_m = 4000.0;

// Makes the light at sea level. The same bits with any workers.
SkyLight make_sky_light(const Sky& sky, Workers& workers);

// Makes it likewise in air of the sky's turbidity that is there already, for many suns in one air.
SkyLight make_sky_light(const Sky& sky, const Atmosphere& atmosphere, Workers& workers);

// What an eye at height_m in (0, kAirTop_m) sees of `light`, that of sea level: its sky, and discs.
// A gradient is the same at all heights. The same bits with any workers. About 5 ms on two threads.
SkyLight sky_light_at_height(const SkyLight& light, double height_m, Workers& workers);

// Radiance of the clear sky in `direction` (world, any length but 0), finite and >= 0. Below the
// horizon: sky_radiance()'s, of a gradient the horizon's. Thread safe.
glm::vec3 clear_radiance(const SkyLight& light, glm::vec3 direction);

// What the exposure is where the scene does not say, by the luminance that the eye is adapted to,
// over 10 000 cd/m^2, > 0. It follows the light, but not quite: dusk is shown darker than day, and
// the night darker still.
double automatic_exposure(double light);

}  // namespace swell::sky
