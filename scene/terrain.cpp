#include "scene/terrain.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

#include "math/check.h"
#include "math/elementary.h"
#include "ocean/sea_floor.h"
#include "scene/island.h"
#include "texture/image_io.h"
#include "texture/perlin.h"

namespace swell::scene {
namespace {

constexpr float kMaxHeight = 12000.0f;  // metres, up and down

// Whether a picture file holds metres (true) or shares of white (false).
bool holds_metres(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".exr" || extension == ".hdr";
}

[[noreturn]] void fail_pixel(const std::filesystem::path& path, int x, int y, float value,
                             const std::string& allowed) {
  throw SceneError(fmt::format("{}: height at pixel ({}, {}), got {}, allowed {}", path.string(), x,
                               y, value, allowed));
}

texture::ImageF read_heights(const std::filesystem::path& path) {
  texture::ImageF image = texture::read_image(path, {.max_side_px = kMaxImageSide});
  if (image.width != image.height || image.width < 1)
    throw SceneError(
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

Terrain terrain_from_image(const TerrainDescription& description) {
  const texture::ImageF image = read_heights(description.height_image);
  const bool metres = holds_metres(description.height_image);
  Terrain terrain;
  terrain.samples = std::max(image.width, 2);
  terrain.spacing_m = description.metres_per_pixel;
  terrain.min_world = description.centre_m - 0.5 * terrain.size_m();
  terrain.height_m.reserve(static_cast<std::size_t>(terrain.samples) * terrain.samples);
  for (int j = 0; j < terrain.samples; ++j)
    for (int i = 0; i < terrain.samples; ++i)
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

Terrain terrain_from_coast(const TerrainDescription& description) {
  const texture::PerlinNoise noise(description.seed);
  Terrain terrain;
  terrain.samples = kBeachSamples;
  terrain.spacing_m = description.beach_size_m / (kBeachSamples - 1);
  terrain.min_world = description.centre_m - 0.5 * description.beach_size_m;
  terrain.height_m.reserve(static_cast<std::size_t>(kBeachSamples) * kBeachSamples);
  const double dune_length_m = std::max(45.0, 8.0 * terrain.spacing_m);  // 8 samples and more
  for (int j = 0; j < kBeachSamples; ++j) {
    for (int i = 0; i < kBeachSamples; ++i) {
      const glm::dvec2 offset = terrain.spacing_m * glm::dvec2(i, j);
      const double plane_m =
          -description.beach_slope *
          ocean::distance_to_coast(description.coast_m, terrain.min_world + offset);
      const double height = plane_m > kBeachTop_m
                                ? dune_height(noise, offset / dune_length_m, plane_m)
                                : std::max(plane_m, -description.floor_depth_m);
      terrain.height_m.push_back(static_cast<float>(height));
    }
  }
  return terrain;
}

// `above` is not allowed itself.
void check_value(const char* name, double value, double above = -HUGE_VAL) {
  if (!(value > above && value < HUGE_VAL))
    throw SceneError(
        fmt::format("terrain.{}, got {}, allowed finite and over {}", name, value, above));
}

void check_coast(std::span<const glm::dvec2> coast_m) {
  if (coast_m.size() == 1) throw SceneError("terrain.coast_m, got 1 point, allowed 2 or more");
  for (std::size_t n = 0; n < coast_m.size(); ++n) {
    check_value("coast_m, east", coast_m[n].x);
    check_value("coast_m, north", coast_m[n].y);
    if (n > 0 && glm::distance(coast_m[n], coast_m[n - 1]) < ocean::kShortestStretch_m)
      throw SceneError(fmt::format(
          "terrain.coast_m[{}], got [{}, {}], allowed a point {} m or more from the one "
          "before",
          n, coast_m[n].x, coast_m[n].y, ocean::kShortestStretch_m));
  }
}

void check_description(const TerrainDescription& description) {
  check_coast(description.coast_m);
  if (!description.coast_m.empty() && !description.height_image.empty())
    throw SceneError("terrain.coast_m, got it besides height_image, allowed one of them");
  check_value("beach_slope", description.beach_slope, 0.0);
  check_value("beach_size_m", description.beach_size_m, 0.0);
  check_value("island_radius_m", description.island_radius_m, 0.0);
  check_value("floor_depth_m", description.floor_depth_m, 0.0);
  check_value("metres_per_pixel", description.metres_per_pixel, 0.0);
  check_value("island_height_m", description.island_height_m);
  check_value("low_m", description.low_m);
  check_value("high_m", description.high_m);
  check_value("sea_level_m", description.sea_level_m);
  check_value("centre_m[0]", description.centre_m.x);
  check_value("centre_m[1]", description.centre_m.y);
}

}  // namespace

std::optional<double> described_size_m(const TerrainDescription& description) {
  if (!description.coast_m.empty()) return description.beach_size_m;
  if (!description.height_image.empty()) return std::nullopt;
  return island_size_m(description);
}

Terrain build_terrain(const TerrainDescription& description) {
  check_description(description);
  Terrain terrain = !description.coast_m.empty()       ? terrain_from_coast(description)
                    : description.height_image.empty() ? build_island(description)
                                                       : terrain_from_image(description);
  const auto [lowest, highest] = std::ranges::minmax_element(terrain.height_m);
  terrain.lowest_m = *lowest;
  terrain.highest_m = *highest;
  return terrain;
}

void sample_heights(const Terrain& terrain, std::span<const glm::dvec2> p_world,
                    std::span<float> height_m) {
  SWELL_CHECK(p_world.size() == height_m.size(), "p_world={} height_m={}", p_world.size(),
              height_m.size());
  SWELL_CHECK(terrain.samples >= 2, "samples={}", terrain.samples);
  const double last = terrain.samples - 1;
  for (std::size_t k = 0; k < p_world.size(); ++k) {
    const glm::dvec2 offset = (p_world[k] - terrain.min_world) / terrain.spacing_m;
    // max first, so that NaN becomes 0.
    const double x = std::min(std::max(0.0, offset.x), last);
    const double y = std::min(std::max(0.0, offset.y), last);
    const int i = std::min(static_cast<int>(x), terrain.samples - 2);
    const int j = std::min(static_cast<int>(y), terrain.samples - 2);
    const float* row = &terrain.height_m[static_cast<std::size_t>(j) * terrain.samples + i];
    const float* next = row + terrain.samples;
    const double south = row[0] + (x - i) * (static_cast<double>(row[1]) - row[0]);
    const double north = next[0] + (x - i) * (static_cast<double>(next[1]) - next[0]);
    height_m[k] = static_cast<float>(south + (y - j) * (north - south));
  }
}

void terrain_slopes(const Terrain& terrain, std::span<float> slope_x, std::span<float> slope_y) {
  const int n = terrain.samples;
  const std::size_t count = static_cast<std::size_t>(n) * n;
  SWELL_CHECK(n >= 2, "samples={}", n);
  SWELL_CHECK(slope_x.size() == count && slope_y.size() == count, "samples={} slopes={}, {}", n,
              slope_x.size(), slope_y.size());
  const auto height = [&](int i, int j) {
    return static_cast<double>(terrain.height_m[static_cast<std::size_t>(j) * n + i]);
  };
  const auto slope = [&](double low, double high, int steps) {
    return static_cast<float>((high - low) / (steps * terrain.spacing_m));
  };
  for (int j = 0; j < n; ++j) {
    const int south = std::max(j - 1, 0), north = std::min(j + 1, n - 1);
    for (int i = 0; i < n; ++i) {
      const int west = std::max(i - 1, 0), east = std::min(i + 1, n - 1);
      const std::size_t k = static_cast<std::size_t>(j) * n + i;
      slope_x[k] = slope(height(west, j), height(east, j), east - west);
      slope_y[k] = slope(height(i, south), height(i, north), north - south);
    }
  }
}

}  // namespace swell::scene
