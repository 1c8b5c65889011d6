// The sky as maps of its upper hemisphere.
#include <algorithm>
#include <cmath>
#include <vector>

#include "math/elementary.h"
#include "render/world/for_each_row.h"
#include "render/world/rgb_code.h"
#include "render/world/world_state.h"
#include "scene/sky.h"
#include "texture/perlin.h"

namespace swell::render {
namespace {

constexpr int kSharpSkySize = 768, kSoftSkySize = 128;
// Waves too small to see spread what they mirror: no cloud's edge is sharp in the sea.
constexpr int kSoftSkyBlur = 5;  // at twice its size

// The direction that a sky map's texel shows; outside the horizon's circle it points below.
glm::vec3 sky_direction(int x, int y, int size) {
  const float u = (2.0f * (static_cast<float>(x) + 0.5f)) / static_cast<float>(size) - 1.0f;
  const float v = (2.0f * (static_cast<float>(y) + 0.5f)) / static_cast<float>(size) - 1.0f;
  const float r2 = u * u + v * v;
  return glm::vec3(2.0f * u, 2.0f * v, 1.0f - r2) / (1.0f + r2);
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

// size x size texels of three floats each.
std::vector<float> sample_sky(const scene::Sky& sky, const texture::PerlinNoise& clouds, int size,
                              Workers& workers) {
  std::vector<float> rgb(static_cast<std::size_t>(3 * size * size));
  for_each_row(size, workers, [&](int y) {
    float* p = rgb.data() + std::ptrdiff_t{3} * y * size;
    for (int x = 0; x < size; ++x) {
      glm::vec3 d = sky_direction(x, y, size);
      d.z = std::max(d.z, -0.1f);
      const glm::vec3 radiance = scene::sky_radiance(sky, clouds, d);
      for (int c = 0; c < 3; ++c) *p++ = radiance[c];
    }
  });
  return rgb;
}

// Means of 2 x 2 texels.
std::vector<float> halve(const std::vector<float>& rgb, int size) {
  std::vector<float> result;
  for (std::ptrdiff_t y = 0; y < size; y += 2) {
    for (std::ptrdiff_t x = 0; x < size; x += 2) {
      const float* p = rgb.data() + 3 * (y * size + x);
      for (int c = 0; c < 3; ++c)
        result.push_back(0.25f * (p[c] + p[c + 3] + p[3 * size + c] + p[3 * size + c + 3]));
    }
  }
  return result;
}

texture::RgbaImage encode(const std::vector<float>& rgb, int size, Workers& workers) {
  texture::RgbaImage image;
  texture::resize_image(size, size, image);
  for_each_row(size, workers, [&](int y) {
    for (int x = 0; x < size; ++x) {
      const float* p = rgb.data() + 3 * (static_cast<std::ptrdiff_t>(y) * size + x);
      image.texels[static_cast<std::size_t>(y) * image.stride + x] =
          encode_rgb({p[0], p[1], p[2]}, kLookupRange);
    }
  });
  texture::fill_padding(image);
  return image;
}

// Two box filters each way, then half the size.
texture::RgbMap build_soft_sky(const scene::Sky& sky, const texture::PerlinNoise& clouds,
                               Workers& workers) {
  constexpr int size = 2 * kSoftSkySize;
  std::vector<float> rgb = sample_sky(sky, clouds, size, workers);
  for (int pass = 0; pass < 2; ++pass) {
    blur(rgb, size, kSoftSkyBlur, true, workers);
    blur(rgb, size, kSoftSkyBlur, false, workers);
  }
  return texture::pack_rgb(encode(halve(rgb, size), kSoftSkySize, workers));
}

// Mean radiance of the sky weighted by the cosine to the zenith: rings of equal weight.
glm::vec3 ambient_radiance(const scene::Sky& sky, const texture::PerlinNoise& clouds) {
  constexpr int kRings = 12, kSectors = 24;
  glm::vec3 sum(0.0f);
  for (int i = 0; i < kRings; ++i) {
    const float sin2 = (static_cast<float>(i) + 0.5f) / kRings;  // sin^2 of the zenith angle
    const float horizontal = std::sqrt(sin2), z = std::sqrt(1.0f - sin2);
    for (int j = 0; j < kSectors; ++j) {
      const SinCos a = sin_cos_turns((j + 0.5) / kSectors);
      sum += scene::sky_radiance(
          sky, clouds,
          {horizontal * static_cast<float>(a.cos), horizontal * static_cast<float>(a.sin), z});
    }
  }
  return sum / static_cast<float>(kRings * kSectors);
}

glm::vec3 horizon_radiance(const scene::Sky& sky, const texture::PerlinNoise& clouds) {
  constexpr int kSectors = 96;
  glm::vec3 sum(0.0f);
  for (int j = 0; j < kSectors; ++j) {
    const SinCos a = sin_cos_turns((j + 0.5) / kSectors);
    sum += scene::sky_radiance(sky, clouds, glm::vec3(glm::dvec3(a.cos, a.sin, 0.0)));
  }
  return sum / static_cast<float>(kSectors);
}

}  // namespace

SkyMaps build_sky_maps(const scene::Sky& sky, Workers& workers) {
  const texture::PerlinNoise clouds(sky.cloud_seed);
  return {encode(sample_sky(sky, clouds, kSharpSkySize, workers), kSharpSkySize, workers),
          build_soft_sky(sky, clouds, workers), ambient_radiance(sky, clouds),
          horizon_radiance(sky, clouds)};
}

}  // namespace swell::render
