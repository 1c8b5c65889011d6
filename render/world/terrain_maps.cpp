// The land's slopes and colours as maps over its square.
#include <algorithm>
#include <cmath>
#include <vector>

#include "math/smoothstep.h"
#include "render/world/for_each_row.h"
#include "render/world/rgb_code.h"
#include "render/world/world_state.h"
#include "texture/perlin.h"

namespace swell::render {
namespace {

constexpr int kTerrainMapSize = 1024;

// Reflectance of the ground by height, steepness and noise: sand, then scrub and forest, rock
// where it is steep, grey-green growth in deeper water. Wet sand passes into the floor's colours
// within two metres of depth.
glm::vec3 ground_albedo(float height_m, float steepness, float noise, float clumps) {
  const glm::vec3 sand =
      glm::mix(glm::vec3(0.58f, 0.50f, 0.36f), glm::vec3(0.68f, 0.61f, 0.47f), 0.5f + 0.5f * noise);
  const glm::vec3 wet_sand = sand * 0.62f;
  const glm::vec3 green =
      glm::mix(glm::vec3(0.035f, 0.075f, 0.020f), glm::vec3(0.14f, 0.18f, 0.05f),
               smoothstep(-0.35f, 0.45f, clumps + 0.3f * noise));
  const glm::vec3 rock =
      glm::mix(glm::vec3(0.20f, 0.18f, 0.16f), glm::vec3(0.34f, 0.31f, 0.27f), 0.5f + 0.5f * noise);
  const glm::vec3 reef(0.16f, 0.19f, 0.13f);
  glm::vec3 c = glm::mix(wet_sand, sand, smoothstep(0.1f, 0.7f, height_m));
  c = glm::mix(c, green, smoothstep(1.8f, 4.0f, height_m + 1.5f * noise));
  c = glm::mix(c, rock, smoothstep(0.55f, 0.9f, steepness + 0.15f * noise));
  const glm::vec3 floor = glm::mix(sand, reef, 0.75f * smoothstep(0.15f, 0.5f, noise));
  return glm::mix(c, floor, smoothstep(0.1f, 2.0f, -height_m));
}

}  // namespace

TerrainMaps build_terrain_maps(const terrain::HeightGrid& terrain, std::uint64_t seed,
                               Workers& workers) {
  constexpr int n = kTerrainMapSize;
  const double step = terrain.grid.size_m() / n;
  const std::vector<float> height =
      terrain::resample(terrain, {terrain.grid.min_world, step, n, n}).height_m;
  const auto at = [&](int i, int j) {
    return height[static_cast<std::size_t>(std::clamp(j, 0, n - 1)) * n + std::clamp(i, 0, n - 1)];
  };

  TerrainMaps maps;
  texture::resize_image(n, n, maps.albedo);
  const texture::PerlinNoise noise(seed);
  std::vector<float> slope_x(height.size()), slope_y(height.size());
  const float inv_span = static_cast<float>(0.5 / step);
  for_each_row(n, workers, [&](int j) {
    for (int i = 0; i < n; ++i) {
      const std::size_t k = static_cast<std::size_t>(j) * n + i;
      slope_x[k] = (at(i + 1, j) - at(i - 1, j)) * inv_span;
      slope_y[k] = (at(i, j + 1) - at(i, j - 1)) * inv_span;
      const float steepness = std::sqrt(slope_x[k] * slope_x[k] + slope_y[k] * slope_y[k]);
      const auto patchiness =
          static_cast<float>(noise.fractal2(i * step / 14.0, j * step / 14.0, 5, 0.6));
      const auto clumps =
          static_cast<float>(noise.fractal2(i * step / 5.0 + 31.7, j * step / 5.0, 3, 0.7));
      maps.albedo.texels[static_cast<std::size_t>(j) * maps.albedo.stride + i] = encode_rgb(
          ground_albedo(height[k], steepness, std::clamp(patchiness, -1.0f, 1.0f), clumps), 1.0f);
    }
  });
  texture::fill_padding(maps.albedo);
  texture::pack_map2(n, slope_x, slope_y, 0.0f, maps.slopes);
  return maps;
}

}  // namespace swell::render
