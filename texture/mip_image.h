// A picture with mip levels for what is sampled at few places, one by one: textures of meshes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace swell::texture {

// Repeats itself. Level l has max(width >> l, 1) x max(height >> l, 1) texels, down to one.
struct MipImage {
  struct Level {
    int width = 0, height = 0;
    std::uint32_t first = 0;  // texel
  };
  std::vector<Level> levels;
  std::vector<std::uint32_t> texels;  // sRGB, R in the low byte
  std::array<float, 256> linear{};    // the value of each byte
};

// From width x height texels, row by row, of sides in [1, 16384].
MipImage make_mip_image(int width, int height, std::span<const std::uint32_t> texels);

// Linear RGB at (u, v), where (0, 0) is the corner before the first texel and (1, 1) that behind
// the last, blended between texels of one level.
inline glm::vec3 sample_level(const MipImage& image, int number, float u, float v) {
  const std::array<float, 256>& linear = image.linear;
  const MipImage::Level& level = image.levels[static_cast<std::size_t>(number)];
  // Into the first period, so that no float is too large for a texel's number.
  const float x = (u - std::floor(u)) * static_cast<float>(level.width) - 0.5f;
  const float y = (v - std::floor(v)) * static_cast<float>(level.height) - 0.5f;
  const float x0 = std::floor(x), y0 = std::floor(y);
  const auto wrapped = [](int i, int size) { return i < 0 ? i + size : i >= size ? i - size : i; };
  const auto texel = [&](int i, int j) {
    const std::uint32_t word =
        image.texels[level.first +
                     static_cast<std::uint32_t>(wrapped(j, level.height) * level.width +
                                                wrapped(i, level.width))];
    return glm::vec3(linear[word & 255], linear[word >> 8 & 255], linear[word >> 16 & 255]);
  };
  const int i = static_cast<int>(x0), j = static_cast<int>(y0);
  const float s = x - x0, t = y - y0;
  const glm::vec3 low = texel(i, j) + s * (texel(i + 1, j) - texel(i, j));
  const glm::vec3 high = texel(i, j + 1) + s * (texel(i + 1, j + 1) - texel(i, j + 1));
  return low + t * (high - low);
}

// Blends sample_level() between two levels. level: log2 of a footprint's breadth in texels. u, v
// and level are finite.
inline glm::vec3 sample(const MipImage& image, float u, float v, float level) {
  const float at = std::clamp(level, 0.0f, static_cast<float>(image.levels.size() - 1));
  const int fine = static_cast<int>(at);
  const float t = at - static_cast<float>(fine);
  const glm::vec3 value = sample_level(image, fine, u, v);
  if (t == 0.0f) return value;
  return value + t * (sample_level(image, fine + 1, u, v) - value);
}

}  // namespace swell::texture
