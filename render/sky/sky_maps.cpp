// The sky as maps, exposed.
#include "render/sky/sky_maps.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/elementary.h"
#include "math/for_each_row.h"
#include "render/sky/clouds.h"
#include "render/world/rgb_code.h"
#include "render/world/world_state.h"
#include "sky/sky_light.h"

namespace swell::render {
namespace {

constexpr float kClearSkyRange = 64.0f;
// Closer near the sea, where haze is.
constexpr double kHeights_m[] = {300.0,   800.0,   1600.0,  3000.0,  5500.0,
                                 10000.0, 17000.0, 27000.0, 40000.0, 60000.0};
// Waves too small to see spread what they mirror: box filters of so many texels to each side.
constexpr int kSoftSkyBlur = 2, kSoftSkyPasses = 2;

// Where texel (x, y) of a map lies, from its middle; the map's side is 2.
glm::vec2 texel_place(int x, int y, int size) {
  const float step = 2.0f / static_cast<float>(size);
  return step * (glm::vec2(x, y) + 0.5f) - 1.0f;
}

// The direction at a place of the blurred map.
glm::vec3 sky_direction(glm::vec2 place) {
  const float r2 = glm::dot(place, place);
  return glm::vec3(2.0f * place, 1.0f - r2) / (1.0f + r2);
}

// Calls radiance_at(place) for the texels of a map: three floats each.
template <class RadianceAt>
std::vector<float> sample_map(int size, Workers& workers, const RadianceAt& radiance_at) {
  std::vector<float> rgb(static_cast<std::size_t>(3 * size * size));
  for_each_row(size, workers, [&](int y) {
    float* p = rgb.data() + std::ptrdiff_t{3} * y * size;
    for (int x = 0; x < size; ++x) {
      const glm::vec3 radiance = radiance_at(texel_place(x, y, size));
      for (int c = 0; c < 3; ++c) *p++ = radiance[c];
    }
  });
  return rgb;
}

// Box filter of half width `radius` along rows (step 3 floats) or columns, edges repeated.
void blur(std::vector<float>& rgb, int size, int radius, bool along_rows, Workers& workers) {
  std::vector<float> result(rgb.size());
  const std::ptrdiff_t step = along_rows ? 3 : 3 * size, line = along_rows ? 3 * size : 3;
  const float weight = 1.0f / static_cast<float>(2 * radius + 1);
  for_each_row(size, workers, [&](int j) {
    for (int i = 0; i < size; ++i) {
      for (int c = 0; c < 3; ++c) {
        float sum = 0.0f;
        for (int k = i - radius; k <= i + radius; ++k)
          sum += rgb[static_cast<std::size_t>(j * line + std::clamp(k, 0, size - 1) * step + c)];
        result[static_cast<std::size_t>(j * line + i * step + c)] = weight * sum;
      }
    }
  });
  rgb.swap(result);
}

std::vector<float> sample_soft_sky(const sky::SkyLight& light, float exposure, Workers& workers) {
  std::vector<float> rgb = sample_map(kSoftSkySize, workers, [&](glm::vec2 place) {
    return exposure * clear_radiance(light, sky_direction(place));
  });
  for (int pass = 0; pass < kSoftSkyPasses; ++pass)
    for (const bool along_rows : {true, false})
      blur(rgb, kSoftSkySize, kSoftSkyBlur, along_rows, workers);
  return rgb;
}

// Sine of the elevation of a row of the clear sky's map, over that of the horizon.
double row_sine(int row, double horizon_sine) {
  const bool is_sky = row < kSkyRows;
  const double from_horizon = is_sky ? 1.0 - static_cast<double>(row) / (kSkyRows - 1)
                                     : static_cast<double>(row - kSkyRows) / (kAirRows - 1);
  const double r = 1.0 - from_horizon * from_horizon, part = (1.0 - r * r) / (1.0 + r * r);
  return is_sky ? horizon_sine + part * (1.0 - horizon_sine)
                : horizon_sine - part * (1.0 + horizon_sine);
}

texture::SmoothImage build_clear_sky(const sky::SkyLight& light, glm::dvec2 azimuth,
                                     double height_m, float exposure, Workers& workers) {
  constexpr int kAllRows = kSkyRows + kAirRows;
  const double horizon_sine = sky::horizon_sine(height_m);
  std::vector<float> rgb(std::size_t{3} * kSkyColumns * kAllRows);
  for_each_row(kAllRows, workers, [&](int row) {
    float* p = rgb.data() + std::ptrdiff_t{3} * row * kSkyColumns;
    const double z = row_sine(row, horizon_sine), across = std::sqrt(std::max(1.0 - z * z, 0.0));
    for (int column = 0; column < kSkyColumns; ++column) {
      const double root = static_cast<double>(column) / (kSkyColumns - 1), half_sine = root * root;
      const double cosine = 1.0 - 2.0 * half_sine * half_sine;
      const double sine = 2.0 * half_sine * std::sqrt(1.0 - half_sine * half_sine);
      const glm::dvec2 d = across * (cosine * azimuth + sine * glm::dvec2(azimuth.y, -azimuth.x));
      const glm::vec3 radiance = exposure * clear_radiance(light, glm::vec3(d.x, d.y, z));
      for (int c = 0; c < 3; ++c) *p++ = radiance[c];
    }
  });
  return texture::make_smooth_image(rgb, kSkyColumns, kAllRows, kClearSkyRange);
}

texture::RgbMap pack_soft_sky(const std::vector<float>& rgb) {
  texture::RgbaImage image;
  texture::resize_image(kSoftSkySize, kSoftSkySize, image);
  for (int y = 0; y < kSoftSkySize; ++y)
    for (int x = 0; x < kSoftSkySize; ++x) {
      const float* p = rgb.data() + std::ptrdiff_t{3} * (y * kSoftSkySize + x);
      const float most = std::max({p[0], p[1], p[2], kSoftSkyRange});
      image.texels[static_cast<std::size_t>(y) * image.stride + x] =
          encode_rgb(glm::vec3(p[0], p[1], p[2]) * (kSoftSkyRange / most), kSoftSkyRange);
    }
  texture::fill_padding(image);
  return texture::pack_rgb(image);
}

// All reds, then all greens, then all blues.
std::vector<float> by_channel(const std::vector<float>& rgb) {
  std::vector<float> channels;
  channels.reserve(rgb.size());
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = c; i < rgb.size(); i += 3) channels.push_back(rgb[i]);
  return channels;
}

// Mean radiance of the clear sky weighted by the cosine to the zenith: rings of equal weight.
glm::vec3 clear_ambient(const sky::SkyLight& light) {
  constexpr int kRings = 16, kSectors = 32;
  glm::vec3 sum(0.0f);
  for (int i = 0; i < kRings; ++i) {
    const float sin2 = (static_cast<float>(i) + 0.5f) / kRings;  // sin^2 of the zenith angle
    const float horizontal = std::sqrt(sin2), z = std::sqrt(1.0f - sin2);
    for (int j = 0; j < kSectors; ++j) {
      const SinCos a = sin_cos_turns((j + 0.5) / kSectors);
      sum += clear_radiance(light, {horizontal * static_cast<float>(a.cos),
                                    horizontal * static_cast<float>(a.sin), z});
    }
  }
  return sum / static_cast<float>(kRings * kSectors);
}

glm::vec3 clear_horizon(const sky::SkyLight& light) {
  constexpr int kSectors = 96;
  glm::vec3 sum(0.0f);
  for (int j = 0; j < kSectors; ++j) {
    const SinCos a = sin_cos_turns((j + 0.5) / kSectors);
    sum += clear_radiance(light, glm::vec3(glm::dvec3(a.cos, a.sin, 0.0)));
  }
  return sum / static_cast<float>(kSectors);
}

double luminance(glm::vec3 rgb) {
  return glm::dot(glm::dvec3(rgb), glm::dvec3(0.2126, 0.7152, 0.0722));
}

// Returns the root mean square of the clear sky's luminance, from the horizon up.
double root_mean_square(const sky::SkyLight& light, double horizon_sine) {
  constexpr int kRings = 24, kSectors = 48;
  double sum = 0.0;
  for (int i = 0; i < kRings; ++i) {
    const double z = std::lerp(horizon_sine, 1.0, (i + 0.5) / kRings);
    const double across = std::sqrt(1.0 - z * z);
    for (int j = 0; j < kSectors; ++j) {
      const SinCos a = sin_cos_turns((j + 0.5) / kSectors);
      const double here =
          luminance(clear_radiance(light, glm::vec3(across * a.cos, across * a.sin, z)));
      sum += here * here;
    }
  }
  return std::sqrt(sum / (kRings * kSectors));
}

// The means over the sky with its clouds, and the direct light under them.
void set_lights(const sky::SkyLight& light, SkyMaps& maps) {
  const CloudLight& clouds = maps.cloud_light;
  maps.ambient = glm::mix(clear_ambient(light), clouds.mean_radiance, clouds.mean_opacity);
  maps.horizon = glm::mix(clear_horizon(light), 0.5f * clouds.mean_radiance, clouds.overcast);
  maps.to_light = light.to_light;
  maps.to_sun = light.sky.sun_direction;
  if (!is_gradient(light.sky)) maps.molecules_per_m = light.atmosphere.air.rayleigh_per_m;
  maps.irradiance = clouds.direct_part * light.irradiance;
}

void expose(float exposure, SkyMaps& maps) {
  for (glm::vec3* x :
       {&maps.ambient, &maps.horizon, &maps.irradiance, &maps.cloud_light.base,
        &maps.cloud_light.tops, &maps.cloud_light.forward, &maps.cloud_light.mean_radiance})
    *x *= exposure;
}

// What an eye adapts to: what a white level surface shows, or over a closed layer of clouds its
// tops; and the sky, its brightest parts above all. `maps` are exposed already.
double light_seen(const sky::SkyLight& light, double height_m, float exposure,
                  const SkyMaps& maps) {
  const CloudLight& clouds = maps.cloud_light;
  const double under = part_under_clouds(height_m);
  const double white =
      luminance(maps.ambient) + luminance(maps.irradiance) * std::max(maps.to_light.z, 0.0f) / kPi;
  const double level = std::lerp(white, luminance(clouds.tops), clouds.overcast * (1.0 - under));
  const double clear = exposure * root_mean_square(light, sky::horizon_sine(height_m));
  return level + 2.0 * std::lerp(clear, luminance(maps.ambient), clouds.overcast * under);
}

// The factor of what is stored. A gradient is stored as it is.
float choose_exposure(const sky::SkyLight& light, SkyMaps& maps) {
  const scene::Sky& sky = light.sky;
  if (is_gradient(sky)) {
    maps.exposure = static_cast<float>(sky.exposure.value_or(1.0));
    return 1.0f;
  }
  if (sky.exposure) return static_cast<float>(*sky.exposure);
  return static_cast<float>(sky::automatic_exposure(light_seen(light, 0.0, 1.0f, maps)));
}

// The exposure where an eye sees so many times the light of sea level. From high up the sun may
// still shine, or the sky glow, when it is night below.
float exposure_at_height(const scene::Sky& sky, double light_ratio) {
  if (sky.exposure || light_ratio <= 1.0) return 1.0f;
  return static_cast<float>(sky::automatic_exposure(light_ratio) / sky::automatic_exposure(1.0));
}

// The sky is drawn alike on both sides of its brighter light: in twilight that is the sun, wherever
// the moon stands.
glm::vec3 brighter_side(const sky::SkyLight& light) {
  constexpr float kTwilight = -0.2f;
  const glm::vec3 to_sun = light.sky.sun_direction;
  const bool is_opposite = sky::moon_direction(light.sky) == -to_sun;
  return !is_opposite && to_sun.z > kTwilight ? to_sun : light.to_light;
}

// `maps`: exposed.
void build_heights(const sky::SkyLight& sea_level, float exposure, Workers& workers,
                   SkyMaps& maps) {
  const glm::vec2 level(brighter_side(sea_level));
  const float length = glm::length(level);
  if (length > 0.0f) maps.azimuth = level / length;
  const double light_below = light_seen(sea_level, 0.0, exposure, maps);
  const auto add_height = [&](const sky::SkyLight& light, double height_m) {
    const double light_here = light_seen(light, height_m, exposure, maps);
    maps.heights.push_back(
        {height_m, build_clear_sky(light, glm::dvec2(maps.azimuth), height_m, exposure, workers),
         exposure * light.disc_radiance, exposure * light.sun_disc_radiance,
         exposure_at_height(light.sky, light_here / light_below)});
  };
  add_height(sea_level, 0.0);
  if (is_gradient(sea_level.sky)) return;
  for (const double height_m : kHeights_m)
    add_height(sky_light_at_height(sea_level, height_m, workers), height_m);
}

}  // namespace

SkyMaps build_sky_maps(const scene::Sky& sky, const sky::Atmosphere& atmosphere, Workers& workers) {
  const sky::SkyLight light = sky::make_sky_light(sky, atmosphere, workers);
  SkyMaps maps;
  maps.cloud_light =
      make_cloud_light(light, clear_ambient(light), static_cast<float>(sky.cloud_cover));
  set_lights(light, maps);
  const float exposure = choose_exposure(light, maps);
  expose(exposure, maps);
  maps.stored_exposure = exposure;
  build_heights(light, exposure, workers, maps);
  const std::vector<float> soft = sample_soft_sky(light, exposure, workers);
  maps.soft_clear = by_channel(soft);
  maps.soft = pack_soft_sky(soft);
  if (sky.cloud_cover > 0.0)
    build_cloud_map(sky.cloud_seed, light.to_light, workers, maps.clouds, maps.cloud_variance);
  return maps;
}

}  // namespace swell::render
