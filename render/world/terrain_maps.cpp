// The land's slopes and colours as maps over its square, and around it.
#include "render/world/terrain_maps.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "math/for_each_row.h"
#include "math/large_array.h"
#include "math/stop.h"
#include "render/world/ground_cover.h"
#include "render/world/rgb_code.h"
#include "render/world/world_state.h"
#include "terrain/apron.h"
#include "texture/perlin.h"

namespace swell::render {
namespace {

constexpr int kTerrainMapSize = 1024;

// Noise that colours the ground, over the terrain's square: sand and scrub, clumps of trees.
struct GroundNoise {
  LargeArray<float> patchiness, clumps;  // kTerrainMapSize a side
};

GroundNoise make_ground_noise(double step_m, std::uint64_t seed, Workers& workers) {
  constexpr int n = kTerrainMapSize;
  const texture::PerlinNoise noise(seed);
  GroundNoise ground{make_large<float>(std::size_t{n} * n), make_large<float>(std::size_t{n} * n)};
  std::vector<double> patch_x(n), clump_x(n);
  for (int i = 0; i < n; ++i) {
    patch_x[i] = i * step_m / 14.0;
    clump_x[i] = i * step_m / 5.0 + 31.7;
  }
  for_each_row(n, workers, [&](int j) {
    std::vector<double> patchiness(n), clumps(n);
    noise.fractal2_row(patch_x, j * step_m / 14.0, 5, 0.6, patchiness);
    noise.fractal2_row(clump_x, j * step_m / 5.0, 3, 0.7, clumps);
    for (int i = 0; i < n; ++i) {
      const std::size_t k = static_cast<std::size_t>(j) * n + i;
      ground.patchiness[k] = std::clamp(static_cast<float>(patchiness[i]), -1.0f, 1.0f);
      ground.clumps[k] = static_cast<float>(clumps[i]);
    }
  });
  return ground;
}

// A square of heights, and their slopes by central differences.
struct Relief {
  int size;
  std::vector<float> height_m;
  LargeArray<float> slope_x, slope_y;

  float steepness(std::size_t k) const {
    return std::sqrt(slope_x[k] * slope_x[k] + slope_y[k] * slope_y[k]);
  }
};

Relief make_relief(int size, double step_m, std::vector<float> height_m, Workers& workers) {
  const std::size_t count = height_m.size();
  Relief relief{size, std::move(height_m), make_large<float>(count), make_large<float>(count)};
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

CoverMaps pack_ground(const Relief& relief, double step_m, const LargeArray<GroundPlace>& places,
                      const terrain::GroundMaterials& materials, Workers& workers) {
  const LargeArray<float> sky_seen = find_sky_seen(relief.size, relief.height_m, step_m, workers);
  std::array<LargeArray<glm::vec4>, std::tuple_size_v<CoverMaps>> values;
  for (auto& four : values) four = make_large<glm::vec4>(places.size());
  for_each_row(relief.size, workers, [&](int j) {
    for (int i = 0; i < relief.size; ++i) {
      const std::size_t k = static_cast<std::size_t>(j) * relief.size + i;
      const GroundCover cover = cover_of(places[k], materials);
      const auto channel = [&](std::size_t n) -> float& {
        return values[n / 4][k][static_cast<glm::length_t>(n % 4)];
      };
      for (std::size_t n = 0; n < kMappedCovers; ++n) channel(n) = cover[static_cast<Cover>(n)];
      channel(kSkySeenChannel) = sky_seen[k];
    }
  });
  CoverMaps maps;
  for (std::size_t n = 0; n < maps.size(); ++n)
    maps[n] = texture::pack_cover(relief.size, values[n], workers);
  return maps;
}

// What the places of a relief are like: noise_at(i, j) numbers the texel of the noise.
template <class NoiseAt>
LargeArray<GroundPlace> find_places(const Relief& relief, double step_m, const GroundNoise& noise,
                                    Workers& workers, const NoiseAt& noise_at) {
  const LargeArray<float> hollow = find_hollows(relief.size, relief.height_m, step_m, workers);
  auto places = make_large<GroundPlace>(hollow.size());
  for_each_row(relief.size, workers, [&](int j) {
    for (int i = 0; i < relief.size; ++i) {
      const std::size_t k = static_cast<std::size_t>(j) * relief.size + i, n = noise_at(i, j);
      places[k] = {relief.height_m[k], relief.steepness(k), hollow[k], noise.patchiness[n],
                   noise.clumps[n]};
    }
  });
  return places;
}

texture::RgbaImage paint_map(const Relief& relief, const LargeArray<GroundPlace>& places,
                             const terrain::GroundMaterials& materials, Workers& workers) {
  return paint(relief.size, workers, [&](int i, int j) {
    return ground_albedo(places[static_cast<std::size_t>(j) * relief.size + i], materials);
  });
}

// Where the map's noise goes on mirrored, half as many texels on the same way.
std::size_t mirrored_noise(int i, int j) {
  constexpr int n = kTerrainMapSize;
  const auto mirrored = [](int texel) {
    const int k = std::abs(2 * texel - n / 2);
    return static_cast<std::size_t>(k < n ? k : 2 * n - 1 - k);
  };
  return mirrored(j) * n + mirrored(i);
}

// Two texels to each of the relief's; heights and noise of their own.
texture::RgbaImage paint_around(const Relief& relief, const LargeArray<GroundPlace>& places,
                                const GroundNoise& noise, const terrain::GroundMaterials& materials,
                                Workers& workers) {
  return paint(2 * relief.size, workers, [&](int i, int j) {
    const auto at = [&](int x, int y) {
      return static_cast<std::size_t>(std::min(y, relief.size - 1)) * relief.size +
             std::min(x, relief.size - 1);
    };
    const int x = i / 2, y = j / 2;
    GroundPlace place = places[at(x, y)];
    place.height_m =
        0.25f * (relief.height_m[at(x, y)] + relief.height_m[at(x + i % 2, y)] +
                 relief.height_m[at(x, y + j % 2)] + relief.height_m[at(x + i % 2, y + j % 2)]);
    const std::size_t k = mirrored_noise(i, j);
    place.patchiness = noise.patchiness[k];
    place.clumps = noise.clumps[k];
    return ground_albedo(place, materials);
  });
}

texture::PackedMap2 pack_slopes(const Relief& relief, Workers& workers) {
  texture::PackedMap2 map;
  texture::pack_map2(relief.size, relief.slope_x, relief.slope_y, 0.0f, map, 0.0f, &workers);
  return map;
}

// The surface at `size` x `size` points from the grid's corner.
std::vector<float> sample_square(const terrain::HeightGrid& terrain, const terrain::Grid& grid,
                                 Workers& workers) {
  std::vector<float> height_m;
  resize_large(height_m, grid.size());
  for_each_row(grid.samples_y, workers, [&](int j) {
    std::vector<glm::dvec2> p(static_cast<std::size_t>(grid.samples_x));
    for (int i = 0; i < grid.samples_x; ++i) p[static_cast<std::size_t>(i)] = grid.point(i, j);
    terrain::sample_heights(terrain, p, std::span(height_m).subspan(grid.index(0, j), p.size()));
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
                               const terrain::HeightGrid& around,
                               const terrain::TerrainDescription& description, Workers& workers) {
  constexpr int n = kTerrainMapSize;
  const double step_m = terrain.grid.size_m() / n;
  const GroundNoise noise = make_ground_noise(step_m, description.seed, workers);
  const Relief relief = make_relief(
      n, step_m, sample_square(terrain, {terrain.grid.min_world, step_m, n, n}, workers), workers);
  // The map that repeats leaves the last row and column out.
  terrain::Grid coarse = around.grid;
  coarse.samples_x = coarse.samples_y = kAroundSize;
  const Relief relief_around = make_relief(kAroundSize, coarse.spacing_m,
                                           terrain::resample(around, coarse).height_m, workers);
  const terrain::GroundMaterials& materials = description.ground;
  const LargeArray<GroundPlace> places =
      find_places(relief, step_m, noise, workers,
                  [](int i, int j) { return static_cast<std::size_t>(j) * n + i; });
  const LargeArray<GroundPlace> places_around =
      find_places(relief_around, coarse.spacing_m, noise, workers,
                  [](int i, int j) { return mirrored_noise(2 * i, 2 * j); });

  return {
      .slopes = pack_slopes(relief, workers),
      .slopes_around = pack_slopes(relief_around, workers),
      .albedo = paint_map(relief, places, materials, workers),
      .albedo_around = paint_around(relief_around, places_around, noise, materials, workers),
      .ground = pack_ground(relief, step_m, places, materials, workers),
      .ground_around =
          pack_ground(relief_around, coarse.spacing_m, places_around, materials, workers),
  };
}

}  // namespace swell::render
