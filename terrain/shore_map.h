// Where the shore is: the distance to the still water line and the height of the ground, on a
// square of points. One map for all that lives along a shore: surf, shelter, wet sand, trees and
// reeds.
//
// The line is where the ground passes through the sea's level, z = 0. Distances are those to the
// points where it crosses the rows and columns of the map, exactly (two passes of lower envelopes,
// rows first, then columns, and the other way round).
// Source: Felzenszwalb, Huttenlocher, Distance Transforms of Sampled Functions, Theory of Computing
// 8, 2012.
#pragma once

#include <glm/glm.hpp>
#include <tuple>
#include <vector>

#include "math/parallel.h"
#include "terrain/height_grid.h"

namespace swell::terrain {

// Cells a side of a shore map at most.
inline constexpr int kShoreMapCells = 1024;

struct ShorePoint {
  float signed_distance_m = 0.0f;  // to the water line: positive in the sea, negative on land
  float height_m = 0.0f;           // of the ground: minus the depth, or the bank's height
  glm::vec2 towards_shore{0.0f};   // unit vector from the sea to the land; 0 where nothing says it
};

// Read-only after it is made, by any number of threads. 8 bytes a point.
class ShoreMap {
 public:
  ShoreMap() = default;  // to be read into
  // Maps a square of heights with its apron. The map has cells as large as the heights' own or,
  // where those are more than kShoreMapCells a side, so many. Without a water line all distances
  // are the square's diagonal, positive if it is sea. 0.1 s of one core; the same bits with any
  // workers.
  ShoreMap(const HeightGrid& land, Workers& workers);
  // Takes known values of the points of a square: surf in [0, 1], or none.
  ShoreMap(const Grid& grid, std::vector<float> signed_distance_m, std::vector<float> height_m,
           std::vector<float> surf);

  // Bilinear; beyond the map that of its border.
  ShorePoint sample(double x, double y) const;
  float surf_at(double x, double y) const;  // likewise

  const Grid& grid() const { return grid_; }
  // The values of point (i, j) are at grid().index(i, j).
  const std::vector<float>& signed_distance_m() const { return distance_m_; }
  const std::vector<float>& height_m() const { return height_m_; }
  // surf() is the part of the surf fronts that run in there; empty: all of them everywhere.
  const std::vector<float>& surf() const { return surf_; }
  // Whether there are both land and sea.
  bool has_line() const { return has_line_; }

  auto fields() { return std::tie(grid_, distance_m_, height_m_, surf_, has_line_); }

 private:
  Grid grid_;
  std::vector<float> distance_m_, height_m_, surf_;
  bool has_line_ = false;
};

}  // namespace swell::terrain
