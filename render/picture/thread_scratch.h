// What the picture and the planar maps are shaded with: a thread's memory.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "render/labels/shaded_labels.h"
#include "render/picture/crossed_tile.h"
#include "render/tile/edges.h"
#include "render/tile/scratch.h"

namespace swell::render {

static_assert(ShadedLabels::kMostPixels == kMaxTilePixels);

struct ThreadScratch {
  ShadeScratch shade;
  ShadedLabels labels;
  EdgeScratch edges;
  std::unique_ptr<CrossedScratch> crossed;  // once a frame has needed it
  std::array<std::uint8_t, kMaxTilePixels> in_water;
  alignas(64) std::array<float, kMaxTilePixels> depth;
  alignas(64) std::array<std::uint32_t, kMaxTilePixels> primitive;
};

}  // namespace swell::render
