// Where planar maps show anything, so that lookups elsewhere need not be made.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raster/pass.h"
#include "render/tile/inputs.h"
#include "texture/packed_map.h"

namespace swell::render {

// Rows [begin, end) of an image.
struct RowRange {
  int begin = 0, end = 0;
  bool empty() const { return begin >= end; }
};

// How many of PlanarMap's columns an image has.
int columns_of(const texture::RgbaImage& image);

// Finds the rows of a drawn tile of an image that show anything: `primitive` is the tile's buffer.
// rows: by row of tiles and column of texels, columns_of(image) a row of tiles; those of the tile
// are empty before.
void find_tile_rows(const texture::RgbaImage& image, const raster::TileGrid& grid, int tile,
                    std::span<const std::uint32_t> primitive, std::span<RowRange> rows);

// Joins what tiles showed to PlanarMap::shown_rows. Empty where most of the image shows something:
// it is not worth asking.
void find_shown_rows(const texture::RgbaImage& image, std::span<const RowRange> tile_rows,
                     std::vector<std::uint32_t>& shown);

}  // namespace swell::render
