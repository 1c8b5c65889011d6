#include "terrain/terrain.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

#include "math/elementary.h"
#include "terrain/apron.h"
#include "terrain/boundary.h"
#include "terrain/described_samples.h"
#include "terrain/island.h"
#include "terrain/sea_floor.h"
#include "texture/image/image_io.h"
#include "texture/perlin.h"

namespace swell::terrain {
namespace {

constexpr float kMaxHeight = 12000.0f;  // metres, up and down

[[noreturn]] void fail_pixel(const std::filesystem::path& path, int x, int y, float value,
                             const std::string& allowed) {
  throw TerrainError(fmt::format("{}: height at pixel ({}, {}), got {}, allowed {}", path.string(),
                                 x, y, value, allowed));
}

texture::ImageF read_heights(const std::filesystem::path& path) {
  texture::ImageF image = texture::read_image(path, {.max_side_px = kMaxImageSide});
  if (image.width != image.height || image.width < 1)
    throw TerrainError(
        fmt::format("{}: height image, got {} x {} pixels, allowed a square of 1 to "
                    "{} a side",
                    path.string(), image.width, image.height, kMaxImageSide));
  return image;
}

// Sample (i, j) from a picture whose top row is the northernmost.
float height_at(const TerrainDescription& description, const texture::ImageF& image, bool metres,
                int i, int j) {
  const int x = std::min(i, image.width - 1), y = image.height - 1 - std::min(j, image.height - 1);
  const float value = image.at(x, y, 0);
  if (metres && !(std::abs(value) <= kMaxHeight))
    fail_pixel(description.height_image, x, y, value, "-12000 to 12000 m");
  if (!metres && !(value >= 0.0f && value <= 1.0f))
    fail_pixel(description.height_image, x, y, value, "0 to 1 (EXR files hold metres)");
  const double height =
      metres ? value : description.low_m + value * (description.high_m - description.low_m);
  return static_cast<float>(height - description.sea_level_m);
}

HeightGrid terrain_from_image(const TerrainDescription& description) {
  const texture::ImageF image = read_heights(description.height_image);
  const bool metres = texture::holds_floats(description.height_image);
  const int samples = std::max(image.width, 2);
  HeightGrid terrain{
      {.spacing_m = description.metres_per_pixel, .samples_x = samples, .samples_y = samples}};
  terrain.grid.min_world = description.centre_m - 0.5 * terrain.grid.size_m();
  terrain.height_m.reserve(terrain.grid.size());
  for (int j = 0; j < samples; ++j)
    for (int i = 0; i < samples; ++i)
      terrain.height_m.push_back(height_at(description, image, metres, i, j));
  return terrain;
}

constexpr int kBeachSamples = 513;
constexpr double kBeachTop_m = 0.5;  // up to there the beach is a plane
constexpr double kDunes_m = 5.0;     // mean height of the land behind, above the beach

// The land's height where a plane goes on to plane_m > kBeachTop_m: a bend into dunes without an
// edge, at most kBeachTop_m + 1.32 kDunes_m (three octaves add up to 1.56).
double dune_height(const texture::PerlinNoise& noise, glm::dvec2 p_dunes, double plane_m) {
  const double rise = 1.0 - exp(-(plane_m - kBeachTop_m) / kDunes_m);
  const double rolling = noise.fractal2(p_dunes.x, p_dunes.y, 3, 0.4);
  return kBeachTop_m + kDunes_m * rise * (1.0 + 0.2 * rise * rolling);
}

HeightGrid terrain_from_coast(const TerrainDescription& description, Workers& workers) {
  const texture::PerlinNoise noise(description.seed);
  const double spacing_m = description.beach_size_m / (kBeachSamples - 1);
  HeightGrid terrain{{description.centre_m - 0.5 * description.beach_size_m, spacing_m,
                      kBeachSamples, kBeachSamples}};
  terrain.height_m.resize(terrain.grid.size());
  const double dune_length_m = std::max(45.0, 8.0 * spacing_m);  // 8 samples and more
  workers.for_each(kBeachSamples, [&](std::size_t row, int) {
    const int j = static_cast<int>(row);
    for (int i = 0; i < kBeachSamples; ++i) {
      const double plane_m = -description.beach_slope *
                             distance_to_coast(description.coast_m, terrain.grid.point(i, j));
      const glm::dvec2 p_dunes = spacing_m * glm::dvec2(i, j) / dune_length_m;
      const double height = plane_m > kBeachTop_m ? dune_height(noise, p_dunes, plane_m)
                                                  : std::max(plane_m, -description.floor_depth_m);
      terrain.height_m[terrain.grid.index(i, j)] = static_cast<float>(height);
    }
  });
  return terrain;
}

// `above` is not allowed itself.
void check_value(const char* name, double value, double above = -HUGE_VAL) {
  if (!(value > above && value < HUGE_VAL))
    throw TerrainError(fmt::format("terrain.{}", name), fmt::format("{}", value),
                       fmt::format("finite and over {}", above));
}

void check_coast(std::span<const glm::dvec2> coast_m) {
  if (coast_m.size() == 1) throw TerrainError("terrain.coast_m", "1 point", "2 or more");
  for (std::size_t n = 0; n < coast_m.size(); ++n) {
    check_value("coast_m, east", coast_m[n].x);
    check_value("coast_m, north", coast_m[n].y);
    if (n > 0 && glm::distance(coast_m[n], coast_m[n - 1]) < kShortestStretch_m)
      throw TerrainError(
          fmt::format("terrain.coast_m[{}]", n),
          fmt::format("[{}, {}]", coast_m[n].x, coast_m[n].y),
          fmt::format("a point {} m or more from the one before", kShortestStretch_m));
  }
}

void check_description(const TerrainDescription& description) {
  check_coast(description.coast_m);
  if (!description.coast_m.empty() && !description.height_image.empty())
    throw TerrainError("terrain.coast_m", "it besides height_image", "one of them");
  if (description.ground_from_boundary && description.boundary.empty())
    throw TerrainError("terrain.ground", "\"boundary\" without terrain.boundary",
                       "\"heights\", or \"boundary\" with its file");
  check_value("beach_slope", description.beach_slope, 0.0);
  check_value("beach_size_m", description.beach_size_m, 0.0);
  check_value("island_radius_m", description.island_radius_m, 0.0);
  check_value("floor_depth_m", description.floor_depth_m, 0.0);
  check_value("islands", description.islands, 0.0);
  check_value("archipelago_size_m", description.archipelago_size_m, 0.0);
  check_value("metres_per_pixel", description.metres_per_pixel, 0.0);
  check_value("island_height_m", description.island_height_m);
  check_value("low_m", description.low_m);
  check_value("high_m", description.high_m);
  check_value("sea_level_m", description.sea_level_m);
  check_value("centre_m[0]", description.centre_m.x);
  check_value("centre_m[1]", description.centre_m.y);
}

// Sets what follows from the heights.
void finish(HeightGrid& terrain) {
  const auto [lowest, highest] = std::ranges::minmax_element(terrain.height_m);
  terrain.lowest_m = *lowest;
  terrain.highest_m = *highest;
  terrain.apron = make_apron(terrain);
}

}  // namespace

std::optional<double> described_size_m(const TerrainDescription& description) {
  if (!description.coast_m.empty()) return description.beach_size_m;
  if (!description.height_image.empty()) return std::nullopt;
  return description.islands > 1 ? description.archipelago_size_m : island_size_m(description);
}

int samples_at_most(const TerrainDescription& description) {
  const int of_heights = !description.coast_m.empty() ? kBeachSamples
                         : !description.height_image.empty()
                             ? texture::side_at_most_px(description.height_image, kMaxImageSide)
                         : description.islands > 1 ? kArchipelagoSamples
                                                   : kIslandSamples;
  return description.ground_from_boundary ? std::max(of_heights, kShoreMapCells + 1) : of_heights;
}

HeightGrid build_terrain(const TerrainDescription& description) {
  Workers one(1);
  return build_terrain(description, one);
}

HeightGrid build_terrain(const TerrainDescription& description, Workers& workers) {
  check_description(description);
  HeightGrid terrain = !description.coast_m.empty() ? terrain_from_coast(description, workers)
                       : !description.height_image.empty() ? terrain_from_image(description)
                       : description.islands > 1           ? build_archipelago(description, workers)
                                                           : build_island(description, workers);
  finish(terrain);
  if (!description.ground_from_boundary) return terrain;
  terrain = ground_of_boundary(read_boundary(description.boundary, terrain), terrain);
  finish(terrain);
  return terrain;
}

}  // namespace swell::terrain
