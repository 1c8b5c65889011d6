// Images in memory: row-major, interleaved channels, first row on top.
#pragma once

#include <cstdint>
#include <vector>

namespace swell::texture {

struct ImageF {
  int width = 0, height = 0, channels = 0;
  std::vector<float> pixels;  // width * height * channels
  float& at(int x, int y, int c) {
    return pixels[(static_cast<std::size_t>(y) * width + x) * channels + c];
  }
  float at(int x, int y, int c) const {
    return pixels[(static_cast<std::size_t>(y) * width + x) * channels + c];
  }
};

struct Image16 {
  int width = 0, height = 0, channels = 0;
  std::vector<std::uint16_t> pixels;
};

struct Image8 {
  int width = 0, height = 0, channels = 0;
  std::vector<std::uint8_t> pixels;
};

}  // namespace swell::texture
