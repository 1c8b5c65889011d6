#include "render/picture/shown_rows.h"

#include <algorithm>

namespace swell::render {
namespace {

constexpr int kColumns = 1 << PlanarMap::kColumnsLog2;

RowRange join(RowRange a, RowRange b) {
  if (a.empty() || b.empty()) return a.empty() ? b : a;
  return {std::min(a.begin, b.begin), std::max(a.end, b.end)};
}

// A block of the softest level, in texels. A sample reads two neighbouring blocks of its level: of
// the softest at most half a block beyond what they show, of others three quarters of such a block
// beyond what texels do.
struct SoftestBlock {
  int width, height;
};

SoftestBlock softest_block(const texture::RgbaImage& image) {
  const int size = 1 << (image.levels - 1), half = std::max(size / 2, 1);
  return image.blur_axis == texture::BlurAxis::kY ? SoftestBlock{half, size}
                                                  : SoftestBlock{size, half};
}

RowRange in_reach(RowRange rows, int block) {
  constexpr int kSharp = 2;  // what a sample of texels reads beyond its own
  const int begin = rows.begin / block * block, end = (rows.end + block - 1) / block * block;
  return {std::min(begin - block / 2, rows.begin - 3 * block / 4) - kSharp,
          std::max(end + block / 2, rows.end + 3 * block / 4) + kSharp};
}

}  // namespace

int columns_of(const texture::RgbaImage& image) { return (image.width + kColumns - 1) / kColumns; }

void find_tile_rows(const texture::RgbaImage& image, const raster::TileGrid& grid, int tile,
                    std::span<const std::uint32_t> primitive, std::span<RowRange> rows) {
  const raster::PixelBox box = raster::tile_box({image.width, image.height}, grid, tile);
  const int row_of_tiles = tile / grid.tiles_x;
  for (int x = 0; x < box.width_px; x += kColumns) {
    RowRange& found = rows[row_of_tiles * columns_of(image) + (box.x0_px + x) / kColumns];
    for (int y = 0; y < box.height_px; ++y) {
      const auto row = primitive.subspan(static_cast<std::size_t>(y) * grid.tile_size_px + x,
                                         std::min(kColumns, box.width_px - x));
      if (std::ranges::any_of(row, [](std::uint32_t p) { return p != raster::kNoPrimitive; }))
        found = join(found, {box.y0_px + y, box.y0_px + y + 1});
    }
  }
}

void find_shown_rows(const texture::RgbaImage& image, std::span<const RowRange> tile_rows,
                     std::vector<std::uint32_t>& shown) {
  const SoftestBlock block = softest_block(image);
  const int columns = columns_of(image), beside = std::max(block.width / kColumns, 1);
  const auto rows_of_tiles = static_cast<int>(tile_rows.size()) / columns;
  shown.resize(static_cast<std::size_t>(columns));
  int row_count = 0;
  for (int column = 0; column < columns; ++column) {
    RowRange rows;
    for (int y = 0; y < rows_of_tiles; ++y)
      for (int x = std::max(column - beside, 0); x <= std::min(column + beside, columns - 1); ++x)
        rows = join(rows, tile_rows[y * columns + x]);
    if (!rows.empty()) rows = in_reach(rows, block.height);
    rows = {std::max(rows.begin, 0), std::min(rows.end, image.height)};
    row_count += rows.end - rows.begin;
    shown[column] = static_cast<std::uint32_t>(rows.begin | rows.end << 16);
  }
  if (row_count > columns * image.height / 2) shown.clear();
}

}  // namespace swell::render
