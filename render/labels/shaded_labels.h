// What shading alone knows of a tile's pixels, kept for the labels.
#pragma once

#include <array>

namespace swell::render {

// As the buffers of a tile: pixel (x, y) at y * tile_size + x. Set where there is a surface.
struct ShadedLabels {
  static constexpr int kMostPixels = 64 * 64;
  alignas(64) std::array<float, kMostPixels> normal_x, normal_y, normal_z;
  alignas(64) std::array<float, kMostPixels> foam_cover, flags;  // 0 but on water
};

}  // namespace swell::render
