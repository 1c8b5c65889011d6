// Where rays meet the ground that is asked for: height_at() of a grid, bilinear between its samples
// (terrain/height_rays.h finds the ground that pictures of few bits a sample show).
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "terrain/height_grid.h"

namespace swell::terrain {

// The steepest slope in any direction of cells that reach between two heights; 0 if none does.
double steepest_between(const HeightGrid& ground, double low_m, double high_m);

// Looks at a grid with 2 samples a side or more, which has to outlive it, unchanged. Any number of
// threads may ask at once.
class GroundRays {
 public:
  explicit GroundRays(const HeightGrid& ground);  // 4 bytes for 3 cells, 5 ns a cell

  // The first distance at which origin + s along, 0 <= s <= farthest_m, comes upon the ground from
  // above; `along` is of length 1. Nothing for a ray that begins below it. On the grid exact but
  // for rounding, some 1e-9 m; beyond it (the apron) bumps less than half a sample's spacing wide
  // may be missed. 0.1 to 1 us.
  std::optional<double> meet(glm::dvec3 origin_world, glm::dvec3 along, double farthest_m) const;

 private:
  // A ray over the grid: u and v in samples.
  struct Walk;

  std::optional<double> meet_in_block(const Walk& walk, int level, glm::ivec2 block) const;
  std::optional<double> meet_in_cell(const Walk& walk, glm::ivec2 cell) const;
  std::optional<double> march(const Walk& walk) const;
  float highest(int level, glm::ivec2 block) const;

  const HeightGrid* ground_;
  glm::ivec2 cells_;
  int levels_ = 0;  // of blocks, level 0: cells
  std::vector<std::vector<float>>
      most_;  // from level 1 on: the highest sample of each block, by rows
};

}  // namespace swell::terrain
