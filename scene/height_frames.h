// The pictures of a table of heights (scene/height_table.h).
#pragma once

#include <vector>

#include "terrain/height_pyramid.h"

namespace swell::scene {

// Frames [m], one at least, of one number of posts, which lie at whole numbers. A table that is no
// square lies in the corner of one: columns and rows are those of its posts.
struct HeightFrames {
  std::vector<terrain::HeightPyramid> frames;
  int columns = 0, rows = 0;
  double highest_m = 0.0;  // of all frames
};

}  // namespace swell::scene
