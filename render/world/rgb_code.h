// Colours as bytes that are even steps for the eye.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace swell::render {

// The nearest byte to 255 sqrt(c / range) of each channel, R in the low byte, alpha 255; channels
// outside [0, range] are clamped.
inline std::uint32_t encode_rgb(glm::vec3 linear, float range) {
  const auto code = [&](float c) {
    const float root = std::sqrt(std::max(c, 0.0f) / range);
    return static_cast<std::uint32_t>(std::floor(std::clamp(root, 0.0f, 1.0f) * 255.0f + 0.5f));
  };
  return code(linear.x) | code(linear.y) << 8 | code(linear.z) << 16 | 0xff000000u;
}

}  // namespace swell::render
