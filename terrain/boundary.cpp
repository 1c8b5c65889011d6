#include "terrain/boundary.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "terrain/apron.h"
#include "terrain/terrain.h"
#include "texture/image/image_io.h"

namespace swell::terrain {
namespace {

struct Channel {
  const char* name;
  float low, high;
  const char* allowed;
};
constexpr std::array<Channel, 4> kChannels = {{
    {"distance to the water line", -1e6f, 1e6f, "-1000000 to 1000000 m"},
    {"depth", 0.0f, 12000.0f, "0 to 12000 m"},
    {"height of the bank", 0.0f, 12000.0f, "0 to 12000 m"},
    {"part of surf", 0.0f, 1.0f, "0 to 1"},
}};

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& got,
                         const std::string& allowed) {
  throw TerrainError(
      fmt::format("{}: water boundary, got {}, allowed {}", path.string(), got, allowed));
}

void check_form(const std::filesystem::path& path, const texture::ImageF& image) {
  if (image.channels != static_cast<int>(kChannels.size()))
    refuse(path, fmt::format("{} channels", image.channels),
           "4: distance to the water line, depth, height of the bank, part of surf");
  if (image.width != image.height || image.width < 2)
    refuse(path, fmt::format("{} x {} pixels", image.width, image.height),
           fmt::format("a square of 2 to {} a side", kShoreMapCells + 1));
}

void check_values(const std::filesystem::path& path, const texture::ImageF& image) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (std::size_t c = 0; c < kChannels.size(); ++c) {
        const Channel& channel = kChannels[c];
        const float value = image.at(x, y, static_cast<int>(c));
        if (!(value >= channel.low && value <= channel.high))
          throw TerrainError(fmt::format("{}: {} at pixel ({}, {}), got {}, allowed {}",
                                         path.string(), channel.name, x, y, value,
                                         channel.allowed));
      }
}

}  // namespace

texture::ImageF boundary_image(const ShoreMap& shore) {
  const Grid& grid = shore.grid();
  texture::ImageF image{grid.samples_x, grid.samples_y, 4, {}};
  image.pixels.reserve(4 * grid.size());
  for (int j = grid.samples_y - 1; j >= 0; --j)
    for (int i = 0; i < grid.samples_x; ++i) {
      const std::size_t k = grid.index(i, j);
      const float height_m = shore.height_m()[k];
      const float surf = shore.surf().empty() ? 1.0f : shore.surf()[k];
      const std::array<float, 4> pixel = {shore.signed_distance_m()[k], std::fmax(-height_m, 0.0f),
                                          std::fmax(height_m, 0.0f), surf};
      image.pixels.insert(image.pixels.end(), pixel.begin(), pixel.end());
    }
  return image;
}

ShoreMap read_boundary(const std::filesystem::path& path, const HeightGrid& land) {
  if (path.extension() != ".exr") refuse(path, "no EXR file", "files whose names end in .exr");
  const texture::ImageF image = texture::read_image(path, {.max_side_px = kShoreMapCells + 1});
  check_form(path, image);
  check_values(path, image);
  const Grid square = square_with_apron(land);
  const Grid grid{square.min_world, square.size_m() / (image.width - 1), image.width, image.width};
  std::vector<float> distance_m(grid.size()), height_m(grid.size()), surf(grid.size());
  for (int j = 0; j < image.height; ++j)
    for (int i = 0; i < image.width; ++i) {
      const std::size_t k = grid.index(i, j);
      const float* const pixel = &image.pixels[4 * grid.index(i, image.height - 1 - j)];
      distance_m[k] = pixel[0];
      height_m[k] = pixel[2] - pixel[1];
      surf[k] = pixel[3];
    }
  return {grid, std::move(distance_m), std::move(height_m), std::move(surf)};
}

texture::Image8 bank_normals(const ShoreMap& boundary) {
  const Grid& grid = boundary.grid();
  std::vector<float> east(grid.size()), north(grid.size());
  sample_slopes({grid, boundary.height_m()}, east, north);
  texture::Image8 image{grid.samples_x, grid.samples_y, 3, {}};
  image.pixels.reserve(3 * grid.size());
  for (int j = grid.samples_y - 1; j >= 0; --j)
    for (int i = 0; i < grid.samples_x; ++i) {
      const std::size_t k = grid.index(i, j);
      const float length = std::sqrt(east[k] * east[k] + north[k] * north[k] + 1.0f);
      for (const float part : {-east[k], -north[k], 1.0f})
        image.pixels.push_back(
            static_cast<std::uint8_t>(std::floor(127.5f * (1.0f + part / length) + 0.5f)));
    }
  return image;
}

HeightGrid ground_of_boundary(const ShoreMap& boundary, const HeightGrid& land) {
  const int cells = land.grid.samples_x - 1;
  const double size_m = land.grid.size_m();
  const int finer = static_cast<int>(std::ceil(size_m / boundary.grid().spacing_m - 1e-6));
  HeightGrid ground{land.grid};
  if (finer > cells) ground.grid = {land.grid.min_world, size_m / finer, finer + 1, finer + 1};
  ground.height_m.reserve(ground.grid.size());
  for (int j = 0; j < ground.grid.samples_y; ++j)
    for (int i = 0; i < ground.grid.samples_x; ++i) {
      const glm::dvec2 p = ground.grid.point(i, j);
      ground.height_m.push_back(boundary.sample(p.x, p.y).height_m);
    }
  return ground;
}

}  // namespace swell::terrain
