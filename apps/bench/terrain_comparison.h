// Land by rays against land of triangles, in whole frames over maps of one land.
#pragma once

#include <functional>
#include <span>

#include "terrain/height_pyramid.h"

namespace swell::apps {

struct TerrainComparison {
  int width_px = 1280, height_px = 720, frames = 12, threads = 2;
};

// A map of 16 bits a post; its heights go from 0 to 600 m.
struct BenchMap {
  int cells = 512;
  double side_m = 16384.0;
  std::span<const std::uint16_t> posts;  // of (cells + 1) x (cells + 1)
};

// Prints a row a map: the time of a frame with 30,000 triangles of land, with 500,000 and by rays,
// and how far the first and the last are from the second [mean of 255]. make_map: the map of so
// many cells a side, which lives until the next. Files of up to 34 MB lie in the temporary folder
// meanwhile.
void compare_terrains(const TerrainComparison& comparison, std::span<const int> cells,
                      const std::function<BenchMap(int cells)>& make_map);

}  // namespace swell::apps
