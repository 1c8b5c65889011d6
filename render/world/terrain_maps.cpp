// The land's slopes and colours as maps over its square, and around it.
#include <algorithm>
#include <cmath>
#include <vector>

#include "math/smoothstep.h"
#include "render/world/for_each_row.h"
#include "render/world/rgb_code.h"
#include "render/world/world_state.h"
#include "terrain/apron.h"
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

// Noise that colours the ground, over the terrain's square: sand and scrub, clumps of trees.
struct GroundNoise {
  std::vector<float> patchiness, clumps;  // kTerrainMapSize a side
};

GroundNoise make_ground_noise(double step_m, std::uint64_t seed, Workers& workers) {
  constexpr int n = kTerrainMapSize;
  const texture::PerlinNoise noise(seed);
  GroundNoise ground{std::vector<float>(std::size_t{n} * n),
                     std::vector<float>(std::size_t{n} * n)};
  for_each_row(n, workers, [&](int j) {
    for (int i = 0; i < n; ++i) {
      const std::size_t k = static_cast<std::size_t>(j) * n + i;
      const auto patchiness =
          static_cast<float>(noise.fractal2(i * step_m / 14.0, j * step_m / 14.0, 5, 0.6));
      ground.patchiness[k] = std::clamp(patchiness, -1.0f, 1.0f);
      ground.clumps[k] =
          static_cast<float>(noise.fractal2(i * step_m / 5.0 + 31.7, j * step_m / 5.0, 3, 0.7));
    }
  });
  return ground;
}

// A square of heights, and their slopes by central differences.
struct Relief {
  int size;
  std::vector<float> height_m, slope_x, slope_y;

  float steepness(std::size_t k) const {
    return std::sqrt(slope_x[k] * slope_x[k] + slope_y[k] * slope_y[k]);
  }
};

Relief make_relief(int size, double step_m, std::vector<float> height_m, Workers& workers) {
  Relief relief{size, std::move(height_m), {}, {}};
  relief.slope_x.resize(relief.height_m.size());
  relief.slope_y.resize(relief.height_m.size());
  const auto at = [&](int i, int j) {
    return relief.height_m[static_cast<std::size_t>(std::clamp(j, 0, size - 1)) * size +
                           std::clamp(i, 0, size - 1)];
  };
  const auto inv_span = static_cast<float>(0.5 / step_m);
  for_each_row(size, workers, [&](int j) {
    for (int i = 0; i < size; ++i) {
      const std::size_t k = static_cast<std::size_t>(j) * size + i;
      relief.slope_x[k] = (at(i + 1, j) - at(i - 1, j)) * inv_span;
      relief.slope_y[k] = (at(i, j + 1) - at(i, j - 1)) * inv_span;
    }
  });
  return relief;
}

// Fills an image of `size` texels a side with colours: albedo_at(i, j).
template <class AlbedoAt>
texture::RgbaImage paint(int size, Workers& workers, const AlbedoAt& albedo_at) {
  texture::RgbaImage image;
  texture::resize_image(size, size, image);
  for_each_row(size, workers, [&](int j) {
    for (int i = 0; i < size; ++i)
      image.texels[static_cast<std::size_t>(j) * image.stride + i] =
          encode_rgb(albedo_at(i, j), 1.0f);
  });
  texture::fill_padding(image);
  return image;
}

texture::RgbaImage paint_map(const Relief& relief, const GroundNoise& noise, Workers& workers) {
  return paint(relief.size, workers, [&](int i, int j) {
    const std::size_t k = static_cast<std::size_t>(j) * relief.size + i;
    return ground_albedo(relief.height_m[k], relief.steepness(k), noise.patchiness[k],
                         noise.clumps[k]);
  });
}

// Two texels to each of the relief's and half as many as the map's on the same way; the map's noise
// goes on mirrored.
texture::RgbaImage paint_around(const Relief& relief, const GroundNoise& noise, Workers& workers) {
  constexpr int n = kTerrainMapSize;
  const int size = 2 * relief.size;
  const auto mirrored = [&](int texel) {
    const int k = std::abs(2 * texel - n / 2);
    return static_cast<std::size_t>(k < n ? k : 2 * n - 1 - k);
  };
  return paint(size, workers, [&](int i, int j) {
    const auto at = [&](int x, int y) {
      return static_cast<std::size_t>(std::min(y, relief.size - 1)) * relief.size +
             std::min(x, relief.size - 1);
    };
    const int x = i / 2, y = j / 2;
    const float height =
        0.25f * (relief.height_m[at(x, y)] + relief.height_m[at(x + i % 2, y)] +
                 relief.height_m[at(x, y + j % 2)] + relief.height_m[at(x + i % 2, y + j % 2)]);
    const std::size_t k = mirrored(j) * n + mirrored(i);
    return ground_albedo(height, relief.steepness(at(x, y)), noise.patchiness[k], noise.clumps[k]);
  });
}

texture::PackedMap2 pack_slopes(const Relief& relief) {
  texture::PackedMap2 map;
  texture::pack_map2(relief.size, relief.slope_x, relief.slope_y, 0.0f, map);
  return map;
}

// The surface at `size` x `size` points from the grid's corner.
std::vector<float> sample_square(const terrain::HeightGrid& terrain, const terrain::Grid& grid,
                                 Workers& workers) {
  std::vector<float> height_m(grid.size());
  for_each_row(grid.samples_y, workers, [&](int j) {
    for (int i = 0; i < grid.samples_x; ++i)
      height_m[grid.index(i, j)] =
          static_cast<float>(terrain::height_at(terrain, grid.point(i, j)));
  });
  return height_m;
}

}  // namespace

terrain::HeightGrid sample_around(const terrain::HeightGrid& terrain, Workers& workers) {
  const terrain::Grid square = terrain::square_with_apron(terrain);
  const terrain::Grid grid{square.min_world, square.size_m() / kAroundSize, kAroundSize + 1,
                           kAroundSize + 1};
  return {grid, sample_square(terrain, grid, workers)};
}

TerrainMaps build_terrain_maps(const terrain::HeightGrid& terrain,
                               const terrain::HeightGrid& around, std::uint64_t seed,
                               Workers& workers) {
  constexpr int n = kTerrainMapSize;
  const double step_m = terrain.grid.size_m() / n;
  const GroundNoise noise = make_ground_noise(step_m, seed, workers);
  const Relief relief = make_relief(
      n, step_m, sample_square(terrain, {terrain.grid.min_world, step_m, n, n}, workers), workers);
  // The map that repeats leaves the last row and column out.
  terrain::Grid coarse = around.grid;
  coarse.samples_x = coarse.samples_y = kAroundSize;
  const Relief relief_around = make_relief(kAroundSize, coarse.spacing_m,
                                           terrain::resample(around, coarse).height_m, workers);

  TerrainMaps maps;
  maps.albedo = paint_map(relief, noise, workers);
  maps.albedo_around = paint_around(relief_around, noise, workers);
  workers.run_both([&] { maps.slopes = pack_slopes(relief); },
                   [&] { maps.slopes_around = pack_slopes(relief_around); });
  return maps;
}

}  // namespace swell::render
