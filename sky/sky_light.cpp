#include "sky/sky_light.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "math/smoothstep.h"

namespace swell::sky {
namespace {

// ---- A painted sky

// Henyey and Greenstein's phase function times 4 pi: haze droplets throw light forward.
// Source: L. G. Henyey, J. L. Greenstein, Diffuse radiation in the galaxy, 1941, eq. 2.
double forward_scattering(double cos_theta, double g) {
  const double base = 1.0 + g * g - 2.0 * g * cos_theta;
  return (1.0 - g * g) / (base * std::sqrt(base));
}

// The direction, or that of the horizon below it, of length 1.
glm::dvec3 above_horizon(glm::vec3 direction) {
  const glm::dvec3 d(direction.x, direction.y, std::max(direction.z, 0.0f));
  const double length = glm::length(d);
  return length > 0.0 ? d / length : glm::dvec3(0.0, 1.0, 0.0);
}

// ---- An atmosphere

// Irradiance of the sun outside the air, in the unit of radiance: 127 500 lx.
// Source: Illuminating Engineering Society, Recommended Practice for the Calculation of Daylight
// Availability, 1984.
constexpr float kSunIrradiance = 12.75f;
// The full moon is 14 magnitudes fainter.
// Source: C. W. Allen, Astrophysical Quantities, 1973, section 66.
// Eyes in the dark see it bluer than it is: Purkinje's effect.
constexpr glm::vec3 kFullMoon = kSunIrradiance / 398000.0f * glm::vec3(0.75f, 1.02f, 1.45f);
// The stars and the air's own glow have 2e-4 cd/m^2, which gives 6e-4 lx.
// Source: F. Patat, UBVRI night sky brightness during sunspot maximum, 2003: 21.6 magnitudes per
// square second of arc.
constexpr glm::vec3 kNight = 2e-8f * glm::vec3(0.8f, 1.0f, 1.6f);

constexpr float kDiscSolidAngle = static_cast<float>(kPi * kSunRadius_rad * kSunRadius_rad);

// Brightness of the moon by the lit part of its disc, 1 when full.
// Source: K. Krisciunas, B. E. Schaefer, A model of the brightness of moonlight, 1991, eq. 9.
float moon_brightness(double lit_part) {
  const double phase_deg = acos(2.0 * lit_part - 1.0) * (180.0 / kPi);
  const double squared = phase_deg * phase_deg;
  return static_cast<float>(pow(10.0, -0.4 * (0.026 * phase_deg + 4e-9 * squared * squared)));
}

// What is left of the computed light of the sky when the sun is down: a fit to the illuminance of
// twilight. The air computed has no haze above a few kilometres, and its light is too strong by
// 1.5 to 1.7 from -4 degrees down.
// Source: P. M. Janiczek, J. A. DeYoung, Computer Programs for Sun and Moon Illuminance, United
// States Naval Observatory Circular 171, 1987.
float twilight_part(double sine) {
  return static_cast<float>(1.0 - 0.38 * smoothstep(0.02, -0.07, sine));
}

void add_source(glm::vec3 to_light, glm::vec3 irradiance, Workers& workers, SkyLight& light) {
  light.sources.push_back(
      {make_sky_table(light.atmosphere, glm::dvec3(to_light), 0.0, workers), irradiance});
}

glm::vec3 disc_radiance(const SkyLight& light, const SkyLight::Source& source, double height_m) {
  return source.irradiance / kDiscSolidAngle *
         whole_disc_transmittance(light.atmosphere, height_m, source.table.to_light.z);
}

// The last source throws the shadows.
void set_direct_light(SkyLight& light) {
  const SkyLight::Source& source = light.sources.back();
  const double sine = source.table.to_light.z;
  light.to_light = source.table.to_light;
  light.irradiance = source.irradiance * disc_transmittance(light.atmosphere, 0.0, sine);
  light.cloud_irradiance =
      source.irradiance * disc_transmittance(light.atmosphere, kCloudHeight_m, sine);
}

void set_discs(double height_m, SkyLight& light) {
  light.disc_radiance = disc_radiance(light, light.sources.back(), height_m);
  light.sun_disc_radiance = disc_radiance(light, light.sources.front(), height_m);
}

SkyLight make_atmosphere_light(const Sky& sky, const Atmosphere& atmosphere, Workers& workers) {
  const glm::vec3 to_sun = sky.sun_direction;
  SkyLight light;
  light.sky = sky;
  light.atmosphere = atmosphere;
  add_source(to_sun, glm::vec3(kSunIrradiance), workers, light);
  const glm::vec3 to_moon = moon_direction(sky);
  constexpr auto kRadius = static_cast<float>(kSunRadius_rad);
  if (to_sun.z <= -kRadius && to_moon.z > -kRadius && sky.moon_phase != 0.0)
    add_source(to_moon, moon_brightness(sky.moon_phase) * kFullMoon, workers, light);
  set_direct_light(light);
  set_discs(0.0, light);
  return light;
}

SkyLight make_gradient_light(const Sky& sky) {
  SkyLight light;
  light.sky = sky;
  light.to_light = sky.sun_direction;
  light.irradiance = sky.sun_direction.z > 0.0f ? gradient_of(sky).sun_radiance : glm::vec3(0.0f);
  light.cloud_irradiance = light.irradiance;
  light.disc_radiance = light.sun_disc_radiance = 8.0f * light.irradiance;
  return light;
}

}  // namespace

glm::vec3 sun_direction(double azimuth_rad, double elevation_rad) {
  const double cos_elevation = cos(elevation_rad);
  return glm::vec3(sin(azimuth_rad) * cos_elevation, cos(azimuth_rad) * cos_elevation,
                   sin(elevation_rad));
}

glm::vec3 moon_direction(const Sky& sky) {
  if (!sky.moon_azimuth_rad && !sky.moon_elevation_rad) return -sky.sun_direction;
  return sun_direction(sky.moon_azimuth_rad.value_or(sky.sun_azimuth_rad + kPi),
                       sky.moon_elevation_rad.value_or(-sky.sun_elevation_rad));
}

bool is_gradient(const Sky& sky) {
  return sky.model == SkyModel::kGradient || sky.sun_radiance || sky.zenith || sky.horizon;
}

GradientSky gradient_of(const Sky& sky) {
  GradientSky gradient;
  gradient.sun_radiance = sky.sun_radiance.value_or(gradient.sun_radiance);
  gradient.zenith = sky.zenith.value_or(gradient.zenith);
  gradient.horizon = sky.horizon.value_or(gradient.horizon);
  return gradient;
}

glm::vec3 gradient_radiance(const Sky& sky, glm::vec3 direction) {
  const glm::dvec3 d = above_horizon(direction), to_sun(sky.sun_direction);
  const GradientSky gradient = gradient_of(sky);
  const glm::dvec3 zenith(gradient.zenith), horizon(gradient.horizon), sun(gradient.sun_radiance);
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
  return glm::vec3(glm::max(radiance, glm::dvec3(0.0)));
}

SkyLight make_sky_light(const Sky& sky, Workers& workers) {
  if (is_gradient(sky)) return make_gradient_light(sky);
  return make_atmosphere_light(sky, make_atmosphere(sky.turbidity, workers), workers);
}

SkyLight make_sky_light(const Sky& sky, const Atmosphere& atmosphere, Workers& workers) {
  return is_gradient(sky) ? make_gradient_light(sky)
                          : make_atmosphere_light(sky, atmosphere, workers);
}

SkyLight sky_light_at_height(const SkyLight& light, double height_m, Workers& workers) {
  SkyLight at_height = light;
  if (is_gradient(light.sky)) return at_height;
  for (SkyLight::Source& source : at_height.sources)
    source.table = make_sky_table(light.atmosphere, source.table.to_light, height_m, workers);
  set_discs(height_m, at_height);
  return at_height;
}

glm::vec3 clear_radiance(const SkyLight& light, glm::vec3 direction) {
  if (light.sources.empty()) return gradient_radiance(light.sky, direction);
  const bool is_at_height = light.sources.front().table.horizon_sine < 0.0;
  const glm::dvec3 d =
      is_at_height ? glm::normalize(glm::dvec3(direction)) : above_horizon(direction);
  glm::vec3 radiance = kNight;
  for (const SkyLight::Source& source : light.sources)
    radiance +=
        twilight_part(source.table.to_light.z) * source.irradiance * sky_radiance(source.table, d);
  return radiance;
}

double automatic_exposure(double light) { return 2.2 * pow(light, -0.83); }

}  // namespace swell::sky
