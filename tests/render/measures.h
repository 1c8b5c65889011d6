// What tests measure of pictures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "render/frame.h"

namespace swell::render {

// Returns the luminance of linear light, as of Rec. 709.
inline float luminance(glm::vec3 rgb) {
  return glm::dot(rgb, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

// Where two pictures first differ, or nothing.
inline std::string difference(const Target& a, const Target& b) {
  if (a.rgba.size() != b.rgba.size()) return "sizes differ";
  for (std::size_t i = 0; i < a.rgba.size(); ++i)
    if (a.rgba[i] != b.rgba[i])
      return "pixel (" + std::to_string(i % static_cast<std::size_t>(a.width_px)) + ", " +
             std::to_string(i / static_cast<std::size_t>(a.width_px)) + ")";
  return "";
}

// How many pixels of two pictures of one size differ.
inline int different_pixels(const Target& a, const Target& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) count += a.rgba[i] != b.rgba[i];
  return count;
}

// Returns the mean absolute difference of two pictures of one size, over pixels and channels, in
// codes of 0 to 255.
inline double mean_difference(const Target& a, const Target& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i)
    for (int shift = 0; shift < 24; shift += 8)
      sum += std::abs(static_cast<int>(a.rgba[i] >> shift & 255) -
                      static_cast<int>(b.rgba[i] >> shift & 255));
  return sum / (3.0 * static_cast<double>(a.rgba.size()));
}

// The green codes of a picture, row by row.
inline std::vector<int> green_codes(const Target& target) {
  std::vector<int> green;
  for (const std::uint32_t rgba : target.rgba) green.push_back(static_cast<int>(rgba >> 8 & 255));
  return green;
}

// The green light of a picture with keep_linear, row by row.
inline std::vector<float> green_light(const Target& target) {
  std::vector<float> green;
  for (std::size_t i = 1; i < target.linear.size(); i += 3) green.push_back(target.linear[i]);
  return green;
}

// Shimmer: the part of all values that turn round by more than `step` each way between a frame and
// its neighbours.
inline double part_reversed(const std::vector<std::vector<int>>& frames, int step) {
  std::size_t reversed = 0, all = 0;
  for (std::size_t n = 1; n + 1 < frames.size(); ++n)
    for (std::size_t i = 0; i < frames[n].size(); ++i) {
      const int before = frames[n][i] - frames[n - 1][i], after = frames[n + 1][i] - frames[n][i];
      reversed += (before > step && after < -step) || (before < -step && after > step);
      ++all;
    }
  return static_cast<double>(reversed) / static_cast<double>(all);
}

}  // namespace swell::render
