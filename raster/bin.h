// Step 4 of a pass: which tiles does each triangle of a chunk touch?
#pragma once

#include "raster/pass_state.h"

namespace swell::raster {

// Fills chunk.entries, tile_begin and members from chunk.triangles.
void bin_triangles(const TileGrid& grid, Chunk& chunk);

}  // namespace swell::raster
