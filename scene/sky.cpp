#include "scene/sky.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "math/smoothstep.h"

namespace swell::scene {
namespace {

// Henyey and Greenstein's phase function times 4 pi: haze droplets throw light forward.
// Source: L. G. Henyey, J. L. Greenstein, Diffuse radiation in the galaxy, 1941, eq. 2.
double forward_scattering(double cos_theta, double g) {
  const double base = 1.0 + g * g - 2.0 * g * cos_theta;
  return (1.0 - g * g) / (base * std::sqrt(base));
}

// Part of the light that thin clouds send or hide, in [0, 1]: noise on a plane overhead, stretched
// along one axis as high clouds are.
double cloud_density(const Sky& sky, const texture::PerlinNoise& clouds, glm::dvec3 d) {
  constexpr double kFade = 0.06;  // sine of the elevation at which clouds start to show
  const double fade = smoothstep(kFade, 0.35, d.z);
  if (fade == 0.0 || sky.cloud_cover <= 0.0) return 0.0;
  const glm::dvec2 p = glm::dvec2(d.x, d.y) / d.z;
  const double bend = clouds.fractal2(0.9 * p.x + 31.7, 0.9 * p.y + 11.3, 2, 0.5);
  const double noise =
      clouds.fractal2(1.3 * p.x + 0.8 * bend + 5.1, 2.6 * p.y + 1.1 * bend, 5, 0.55);
  const double threshold = 0.9 - 1.5 * sky.cloud_cover;
  return fade * smoothstep(threshold, threshold + 1.0, noise);
}

}  // namespace

glm::vec3 sun_direction(double azimuth_rad, double elevation_rad) {
  const double cos_elevation = cos(elevation_rad);
  return glm::vec3(sin(azimuth_rad) * cos_elevation, cos(azimuth_rad) * cos_elevation,
                   sin(elevation_rad));
}

glm::vec3 sky_radiance(const Sky& sky, const texture::PerlinNoise& clouds, glm::vec3 direction) {
  // Below the horizon the sky goes on as at the horizon.
  glm::dvec3 d = glm::dvec3(direction);
  d.z = std::max(d.z, 0.0);
  const double length = glm::length(d);
  d = length > 0.0 ? d / length : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 to_sun(sky.sun_direction);
  const glm::dvec3 zenith(sky.zenith), horizon(sky.horizon), sun(sky.sun_radiance);
  const double cos_theta = glm::dot(d, to_sun);

  // Gradient: the air's path grows towards the horizon about as 1 / (sin elevation + 0.15).
  const double path = 1.15 * 0.15 / (d.z + 0.15) - 0.15 * d.z;
  glm::dvec3 radiance = zenith + (horizon - zenith) * path;

  // A low sun warms and brightens the horizon on its side.
  const double low_sun = 1.0 - smoothstep(0.0, 0.6, to_sun.z);
  const double sunward = 0.5 + 0.5 * cos_theta;
  const double glow = low_sun * path * path * sunward * sunward * sunward;
  radiance *= 1.0 + glow * glm::dvec3(0.75, 0.30, -0.10);

  // Haze around the sun, in two widths; none when it has set.
  const double up = smoothstep(-0.1, 0.05, to_sun.z);
  const double wide = forward_scattering(cos_theta, 0.6);
  const double narrow = forward_scattering(cos_theta, 0.9);
  radiance += sun * (up * (0.012 * wide + 0.0016 * narrow));

  // Clouds: as bright as the haze, brighter in front of the sun.
  const double density = cloud_density(sky, clouds, d);
  const glm::dvec3 white =
      0.5 * (horizon + glm::dvec3(0.9 * horizon.y)) + sun * (up * (0.06 + 0.012 * wide));
  radiance += (white - radiance) * (0.75 * density);
  return glm::vec3(glm::max(radiance, glm::dvec3(0.0)));
}

glm::vec3 sky_radiance(const Sky& sky, glm::vec3 direction) {
  return sky_radiance(sky, texture::PerlinNoise(sky.cloud_seed), direction);
}

}  // namespace swell::scene
