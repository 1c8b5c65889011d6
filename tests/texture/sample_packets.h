// The packed maps' samplers over arrays, on the selected SIMD target.
#pragma once

#include <span>
#include <vector>

#include "texture/cover_map.h"
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

struct Sample3 {
  float r, g, b;
  bool operator==(const Sample3&) const = default;
};

// Where to sample a map: coordinates in 1/256 texels of level 0, and a level. Spans of one length.
struct MapPlaces {
  std::span<const int> x_fx8, y_fx8, level;
};

std::vector<Sample2> sample_level(const PackedMap2& map, const MapPlaces& places);

std::vector<float> sample_level(const PackedMap1& map, const MapPlaces& places);

// Adds to sums[i] `gain` times the blend of places.level[i] and the next level by t[i].
void add_blended(const PackedMap2& map, const MapPlaces& places, std::span<const float> t,
                 float gain, std::span<Sample2> sums);

std::vector<Sample4> sample_rgba(const RgbaImage& image, std::span<const float> x_px,
                                 std::span<const float> y_px);

// On one of its levels a place.
std::vector<Sample4> sample_rgba_level(const RgbaImage& image, std::span<const float> x_px,
                                       std::span<const float> y_px, std::span<const int> level);

std::vector<Sample3> sample_rgb(const RgbMap& map, std::span<const float> x_fx8,
                                std::span<const float> y_fx8);

// The four channels in their order.
std::vector<Sample4> sample_cover(const CoverMap& map, const MapPlaces& places);

}  // namespace swell::texture
