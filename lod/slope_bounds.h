// Bounds of the slopes of a height field that does not move, for every part of a domain.
//
// A pyramid of square cells: level q has 2^q x 2^q of them, each with the range of both slopes in
// it, rounded outwards to 1/127 of the steepest slope of all. A diamond asks for the four corners
// of its subtree's box (cut to the domain) at the level where the box reaches over two cells a side
// at most:
//   h = half_size(level): boxes are 6h or 4h wide, cells 8h (even levels) or 4h (odd levels),
//   so q = (level + 1) / 2 - 2, rounded down, and from 0 to the finest.
// A child's box lies in its parent's and its cells in its parent's cells, so ranges nest.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace swell::lod {

class SlopeBounds {
 public:
  // Of samples x samples (>= 2) heights, spacing_m > 0 apart, row j northwards, that span the whole
  // domain: the slopes of the bilinear surface through them. 6 MB at most.
  SlopeBounds(std::span<const float> height_m, int samples, double spacing_m);

  // Cell (i, j) of level q is word slope_level_begin(q) + (j << q) + i. Its four signed bytes, from
  // the lowest, bound dz/dx, -dz/dx, dz/dy and -dz/dy from above, in units of unit().
  std::span<const std::uint32_t> cells() const { return cells_; }
  int levels() const { return levels_; }
  float unit() const { return unit_; }

 private:
  int levels_ = 1;
  float unit_ = 0.0f;
  std::vector<std::uint32_t> cells_;
};

constexpr int slope_level_begin(int q) { return 0x55555555 & ((1 << (2 * q)) - 1); }

constexpr int slope_level_of(int diamond_level, int levels) {
  const int q = (diamond_level + 1) / 2 - 2;
  return q < 0 ? 0 : q < levels ? q : levels - 1;
}

}  // namespace swell::lod
