// Tiles that the waterline crosses: shaded once as from the air and once as from the water, each
// pixel kept of the one that its ray begins in.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "raster/pass.h"
#include "render/labels/shaded_labels.h"
#include "render/tile/scratch.h"

namespace swell::render {

struct Crossing;
struct Target;

// A tile's pixels as seen from the air, while it is shaded from the water. A thread's.
struct CrossedScratch {
  std::array<std::uint32_t, kMaxTilePixels> rgba;
  std::array<float, 3 * kMaxTilePixels> linear;
  ShadedLabels labels;
};

// Copies a tile of the picture; of the target's linear light if it has any.
void keep_tile(const raster::PixelBox& box, const Target& target, CrossedScratch& scratch);

// Puts back the pixels that begin in air, also those of `labels` (a tile's of tile_size_px), if
// any.
void put_back_dry(const Crossing& line, const raster::PixelBox& box, int tile_size_px,
                  const CrossedScratch& scratch, Target& target, ShadedLabels* labels);

// Darkens two pixels on either side of the line: water that creeps up the glass before the eye. For
// all tiles, whether the line crosses them or not.
void draw_meniscus(const Crossing& line, const raster::PixelBox& box, Target& target);

}  // namespace swell::render
