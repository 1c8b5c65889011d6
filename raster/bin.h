// Step 4 of a pass: which tiles does each triangle of a chunk touch?
#pragma once

#include "raster/pass_state.h"

namespace swell::raster {

// Fills chunk.entries, tile_begin and members from chunk.triangles. `samples` is the pass's: with
// samples a triangle is listed in every tile in whose pixels it may cover one, which includes every
// tile where it covers a centre.
void bin_triangles(const TileGrid& grid, Viewport viewport, int samples, Chunk& chunk);

}  // namespace swell::raster
