#include "scene/file/height_table_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "math/parallel.h"
#include "scene/height_frames.h"
#include "terrain/bicubic.h"
#include "texture/image/image_io.h"
#include "texture/square_frames.h"

namespace swell::scene {
namespace {

[[noreturn]] void refuse_picture(const std::string& path, const std::string& what,
                                 const std::string& got, const std::string& allowed) {
  throw std::runtime_error(fmt::format("{}: {}, got {}, allowed {}", path, what, got, allowed));
}

terrain::HeightGrid heights_of(const HeightPictures& pictures, const std::string& path) {
  const texture::ImageF image = texture::read_image(path, {.max_side_px = kMostTableSide});
  if (std::min(image.width, image.height) < 2)
    refuse_picture(path, "table of heights",
                   fmt::format("{} x {} pixels", image.width, image.height),
                   fmt::format("2 to {} a side", kMostTableSide));
  const bool metres = texture::holds_floats(path);
  terrain::HeightGrid heights{{.samples_x = image.width, .samples_y = image.height}};
  heights.height_m.resize(heights.grid.size());
  for (int j = 0; j < image.height; ++j)
    for (int i = 0; i < image.width; ++i) {
      const int y = image.height - 1 - j;
      const double value = image.at(i, y, 0);
      const double height =
          metres ? value : pictures.low_m + value * (pictures.high_m - pictures.low_m);
      if (!(std::abs(height) <= kMostTableHeight_m))
        refuse_picture(path, fmt::format("height at pixel ({}, {})", i, y),
                       fmt::format("{} m", height),
                       fmt::format("{} to {} m", -kMostTableHeight_m, kMostTableHeight_m));
      heights.height_m[heights.grid.index(i, j)] = static_cast<float>(height);
    }
  return heights;
}

// In the corner of a square whose other posts are as low as the lowest.
terrain::HeightGrid in_square(const terrain::HeightGrid& heights) {
  const terrain::Grid& grid = heights.grid;
  const int side = std::max(grid.samples_x, grid.samples_y);
  terrain::HeightGrid square{{.samples_x = side, .samples_y = side}};
  square.height_m.assign(square.grid.size(), *std::ranges::min_element(heights.height_m));
  for (int j = 0; j < grid.samples_y; ++j)
    std::copy_n(heights.height_m.begin() + static_cast<std::ptrdiff_t>(grid.index(0, j)),
                grid.samples_x,
                square.height_m.begin() + static_cast<std::ptrdiff_t>(square.grid.index(0, j)));
  return square;
}

}  // namespace

std::vector<std::string> paths_of(const HeightPictures& pictures) {
  if (pictures.frames == 1) return {pictures.path};
  return texture::paths_of_frames(pictures.path, pictures.frames);
}

std::shared_ptr<const HeightFrames> read_heights(const HeightPictures& pictures) {
  Workers workers(1);
  HeightFrames result;
  for (const std::string& path : paths_of(pictures)) {
    terrain::HeightGrid heights = heights_of(pictures, path);
    if (pictures.bicubic) heights = terrain::refine_bicubic(heights, workers);
    const terrain::Grid& grid = heights.grid;
    if (result.frames.empty()) result.columns = grid.samples_x, result.rows = grid.samples_y;
    if (grid.samples_x != result.columns || grid.samples_y != result.rows)
      refuse_picture(path, "table of heights", "a frame of another size", "that of frame 0");
    const auto side = static_cast<std::size_t>(std::max(grid.samples_x, grid.samples_y));
    if (side * side * static_cast<std::size_t>(pictures.frames) > kMostTablePosts)
      refuse_picture(path, "table of heights",
                     fmt::format("{} frames of {} a side", pictures.frames, side),
                     fmt::format("at most {} posts", kMostTablePosts));
    const double highest = *std::ranges::max_element(heights.height_m);
    result.highest_m = result.frames.empty() ? highest : std::max(result.highest_m, highest);
    result.frames.push_back(terrain::make_height_pyramid(in_square(heights), {}, workers));
  }
  return std::make_shared<const HeightFrames>(std::move(result));
}

}  // namespace swell::scene
