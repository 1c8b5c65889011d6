// The labels of a tile, from its visibility buffer and what its shader has left.
#pragma once

#include <cstdint>
#include <span>

#include "render/labels/labels.h"
#include "render/labels/shaded_labels.h"
#include "render/picture/label_tables.h"

namespace swell::render {

struct Shading;
struct WorldState;

// What the labels of all tiles of a picture are made from.
struct LabelSources {
  const LabelTables& tables;
  const Shading& shading;  // of the window
  const WorldState& world;
};

// A tile: its visibility buffer, both empty where it shows nothing but sky; and what its shader has
// left, if tables.from_shading.
struct LabelTile {
  int number = 0;
  std::span<const float> depth = {};
  std::span<const std::uint32_t> primitive = {};
  const ShadedLabels* shaded = nullptr;
  std::span<const std::uint8_t> in_water = {};  // 1 where the eye looks through water; or none
};

// What is not stored follows from the depth.
constexpr bool needs_depth(LabelSet set) {
  return set.has(Label::kDepth) || set.has(Label::kDistance) || set.has(Label::kPosition);
}

// Sizes what tables.set names for pictures of this size, and empties the rest; capacity is kept.
void resize_labels(LabelSet set, raster::Viewport viewport, Labels& labels);

// Fills the tile's pixels of what tables.set names; `labels` has the window's size.
void fill_label_tile(const LabelSources& in, const LabelTile& tile, Labels& labels);

}  // namespace swell::render
