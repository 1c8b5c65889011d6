// The packed maps' samplers over arrays, on the selected SIMD target.
#pragma once

#include <span>
#include <vector>

#include "texture/packed_map.h"

namespace swell::texture {

struct Sample2 {
  float a, b;
  bool operator==(const Sample2&) const = default;
};

struct Sample4 {
  float r, g, b, a;
  bool operator==(const Sample4&) const = default;
};

// One sample per element of u; v and level have as many elements.
std::vector<Sample2> sample_packed2(const PackedMap2& map, std::span<const float> u,
                                    std::span<const float> v, std::span<const int> level);
std::vector<Sample2> sample_packed2_level(const PackedMap2& map, std::span<const float> u,
                                          std::span<const float> v, int level);
std::vector<Sample4> sample_rgba(const RgbaImage& image, std::span<const float> x_px,
                                 std::span<const float> y_px);

}  // namespace swell::texture
