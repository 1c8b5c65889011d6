// The sea floor and the land: a height field on a square, from a height image or from noise.
// Outside the square the height is the deep floor.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace swell::scene {

struct TerrainDescription {
  // From an image (grey or first channel): height = low_m + value * (high_m - low_m) for integer
  // images, metres for float images; then minus sea_level_m.
  std::filesystem::path height_image;  // empty: islands from noise
  double metres_per_pixel = 2.0;
  double low_m = -20.0, high_m = 40.0;
  double sea_level_m = 0.0;
  glm::dvec2 centre_m{0.0};
  // From noise: one island of this radius on a floor of this depth, with shallow water around it.
  double island_radius_m = 180.0;
  double island_height_m = 35.0;
  double floor_depth_m = 14.0;
  std::uint64_t seed = 3;
};

// samples x samples heights (samples = 2^n + 1 or any size for images), spacing_m apart, sample
// (i, j) at min_world + spacing_m (i, j), row j northwards.
struct Terrain {
  glm::dvec2 min_world{0.0};
  double spacing_m = 1.0;
  int samples = 0;
  std::vector<float> height_m;
  float lowest_m = 0.0f, highest_m = 0.0f;
  double size_m() const { return spacing_m * (samples - 1); }
};

// Throws SceneError (bad values) or texture::FileError (bad image).
Terrain build_terrain(const TerrainDescription& description);

// Bilinear height at world points; outside the square the nearest border sample.
void sample_heights(const Terrain& terrain, std::span<const glm::dvec2> p_world,
                    std::span<float> height_m);

}  // namespace swell::scene
