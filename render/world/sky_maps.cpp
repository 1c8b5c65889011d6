// The sky as maps of its upper hemisphere, exposed.
#include <algorithm>
#include <cmath>
#include <vector>

#include "math/elementary.h"
#include "render/materials/clouds.h"
#include "render/world/for_each_row.h"
#include "render/world/rgb_code.h"
#include "render/world/world_state.h"
#include "scene/sky.h"

namespace swell::render {
namespace {

constexpr int kClearSkySize = 384;
constexpr float kClearSkyRange = 64.0f;
// Waves too small to see spread what they mirror: box filters of so many texels to each side.
constexpr int kSoftSkyBlur = 2, kSoftSkyPasses = 2;

// Where texel (x, y) of a map lies, from its middle; the map's side is 2.
glm::vec2 texel_place(int x, int y, int size) {
  const float step = 2.0f / static_cast<float>(size);
  return step * (glm::vec2(x, y) + 0.5f) - 1.0f;
}

// The direction at r = |place| of the blurred map, or at r of the clear one.
glm::vec3 sky_direction(glm::vec2 place, float r) {
  const float radius = glm::length(place), r2 = r * r;
  const glm::vec2 azimuth = radius > 0.0f ? place / radius : glm::vec2(0.0f, 1.0f);
  return glm::vec3(2.0f * r * azimuth, 1.0f - r2) / (1.0f + r2);
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

std::vector<float> sample_soft_sky(const scene::SkyLight& light, float exposure, Workers& workers) {
  std::vector<float> rgb = sample_map(kSoftSkySize, workers, [&](glm::vec2 place) {
    return exposure * clear_radiance(light, sky_direction(place, glm::length(place)));
  });
  for (int pass = 0; pass < kSoftSkyPasses; ++pass)
    for (const bool along_rows : {true, false})
      blur(rgb, kSoftSkySize, kSoftSkyBlur, along_rows, workers);
  return rgb;
}

texture::SmoothImage build_clear_sky(const scene::SkyLight& light, float exposure,
                                     Workers& workers) {
  const std::vector<float> rgb = sample_map(kClearSkySize, workers, [&](glm::vec2 place) {
    const float left = 1.0f - std::min(glm::length(place), 1.0f);
    return exposure * clear_radiance(light, sky_direction(place, 1.0f - left * left));
  });
  return texture::make_smooth_image(rgb, kClearSkySize, kClearSkyRange);
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
glm::vec3 clear_ambient(const scene::SkyLight& light) {
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

glm::vec3 clear_horizon(const scene::SkyLight& light) {
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

// Of the clear sky's luminance, over the hemisphere.
double root_mean_square(const scene::SkyLight& light) {
  constexpr int kRings = 24, kSectors = 48;
  double sum = 0.0;
  for (int i = 0; i < kRings; ++i) {
    const double z = (i + 0.5) / kRings, across = std::sqrt(1.0 - z * z);
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
void set_lights(const scene::SkyLight& light, SkyMaps& maps) {
  const CloudLight& clouds = maps.cloud_light;
  maps.ambient = glm::mix(clear_ambient(light), clouds.mean_radiance, clouds.mean_opacity);
  maps.horizon = glm::mix(clear_horizon(light), 0.5f * clouds.mean_radiance, clouds.overcast);
  maps.to_light = light.to_light;
  maps.irradiance = clouds.direct_part * light.irradiance;
  maps.disc_radiance = light.disc_radiance;
}

void expose(float exposure, SkyMaps& maps) {
  for (glm::vec3* x :
       {&maps.ambient, &maps.horizon, &maps.irradiance, &maps.disc_radiance, &maps.cloud_light.base,
        &maps.cloud_light.forward, &maps.cloud_light.mean_radiance})
    *x *= exposure;
}

// The factor of what is stored. A gradient is stored as it is.
float choose_exposure(const scene::SkyLight& light, SkyMaps& maps) {
  const scene::Sky& sky = light.sky;
  if (is_gradient(sky)) {
    maps.exposure = static_cast<float>(sky.exposure.value_or(1.0));
    return 1.0f;
  }
  if (sky.exposure) return static_cast<float>(*sky.exposure);
  // What a white level surface shows, and the sky, its brightest parts above all.
  const double white =
      luminance(maps.ambient) + luminance(maps.irradiance) * std::max(maps.to_light.z, 0.0f) / kPi;
  const double sky_seen =
      std::lerp(root_mean_square(light), luminance(maps.ambient), maps.cloud_light.overcast);
  return static_cast<float>(scene::automatic_exposure(white + 2.0 * sky_seen));
}

}  // namespace

SkyMaps build_sky_maps(const scene::Sky& sky, Workers& workers) {
  const scene::SkyLight light = scene::make_sky_light(sky, workers);
  SkyMaps maps;
  maps.cloud_light =
      make_cloud_light(light, clear_ambient(light), static_cast<float>(sky.cloud_cover));
  set_lights(light, maps);
  const float exposure = choose_exposure(light, maps);
  expose(exposure, maps);
  maps.clear = build_clear_sky(light, exposure, workers);
  const std::vector<float> soft = sample_soft_sky(light, exposure, workers);
  maps.soft_clear = by_channel(soft);
  maps.soft = pack_soft_sky(soft);
  if (sky.cloud_cover > 0.0)
    build_cloud_map(sky.cloud_seed, light.to_light, workers, maps.clouds, maps.cloud_variance);
  return maps;
}

}  // namespace swell::render
