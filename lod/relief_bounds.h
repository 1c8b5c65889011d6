// Bounds of the slopes and heights of a surface that does not move, for every part of a domain.
//
// A pyramid of square cells: level q has 2^q x 2^q of them, each with the ranges in it. A diamond
// asks for the four corners of its subtree's box (cut to the domain) at the level where the box
// reaches over two cells a side at most:
//   h = half_size(level): boxes are 6h or 4h wide, cells 8h (even levels) or 4h (odd levels),
//   so q = (level + 1) / 2 - 2, rounded down, and from 0 to the finest.
// A child's box lies in its parent's and its cells in its parent's cells, so ranges nest.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

namespace swell::lod {

// Largest values of dz/dx, -dz/dx, dz/dy and -dz/dy, and of z and -z, as whole numbers of units.
struct ReliefCell {
  std::array<std::int8_t, 4> slope{};
  std::array<std::int16_t, 2> height{};
  static constexpr bool kPlainBytes = true;
};

class ReliefBounds {
 public:
  ReliefBounds() = default;  // to be read into
  // Bounds the bilinear surface through samples x samples (>= 2) heights, spacing_m > 0 apart, row
  // j northwards, that span the whole domain. Takes 12 MB at most.
  ReliefBounds(std::span<const float> height_m, int samples, double spacing_m);

  // Cell (i, j) of level q is number relief_level_begin(q) + (j << q) + i.
  std::span<const ReliefCell> cells() const { return cells_; }
  int levels() const { return levels_; }
  float slope_unit() const { return slope_unit_; }
  float height_unit_m() const { return height_unit_m_; }

  auto fields() { return std::tie(levels_, slope_unit_, height_unit_m_, cells_); }

 private:
  int levels_ = 1;
  float slope_unit_ = 0.0f, height_unit_m_ = 0.0f;
  std::vector<ReliefCell> cells_;
};

constexpr int relief_level_begin(int q) { return 0x55555555 & ((1 << (2 * q)) - 1); }

constexpr int relief_level_of(int diamond_level, int levels) {
  const int q = (diamond_level + 1) / 2 - 2;
  return q < 0 ? 0 : q < levels ? q : levels - 1;
}

}  // namespace swell::lod
