// Step 4 of a pass: which tiles does each triangle of a chunk touch?
#pragma once

#include "raster/pass_state.h"

namespace swell::raster {

// Adds to chunk.entries the tiles of chunk.triangles[index]. `samples` is the pass's: with samples
// a triangle is listed in every tile in whose pixels it may cover one, which includes every tile
// where it covers a centre.
void list_tiles(const TileGrid& grid, Viewport viewport, int samples, std::uint32_t index,
                Chunk& chunk);

// Adds the tiles of the chunk's small triangle n.
inline void list_small(const TileGrid& grid, std::int32_t place, std::uint32_t n, Chunk& chunk) {
  constexpr std::int32_t kBetween = kBetweenCentres | kBetweenSamples;
  const auto tile = static_cast<std::uint32_t>(place & ~(kBetween | kTwoColumns | kTwoRows));
  const auto between = static_cast<std::uint32_t>(place & kBetween);
  const Member member{Member::kSmall | between | n};
  chunk.entries.push_back({tile, member});
  if ((place & (kTwoColumns | kTwoRows)) == 0) return;
  const auto below = tile + static_cast<std::uint32_t>(grid.tiles_x);
  if ((place & kTwoColumns) != 0) chunk.entries.push_back({tile + 1, member});
  if ((place & kTwoRows) != 0) chunk.entries.push_back({below, member});
  if ((place & kTwoColumns) != 0 && (place & kTwoRows) != 0)
    chunk.entries.push_back({below + 1, member});
}

// Fills tile_begin and members from entries.
void sort_by_tile(const TileGrid& grid, Chunk& chunk);

}  // namespace swell::raster
