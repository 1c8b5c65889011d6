// Heights on a square as rays read them: 16 bits a post, and a pyramid of maxima over them.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "math/parallel.h"
#include "terrain/height_grid.h"

namespace swell::terrain {

// Posts (i, j) at grid.point(i, j), code after code: base_m + step_m * code. The surface between
// four posts is bilinear, and never above the highest of them.
//
// The posts at the corners of larger blocks follow, every 2^l-th along each axis for level l, and
// the last in place of those beyond it: neighbours lie side by side on any level. Level l has
// s = side >> l blocks and s + 1 posts a side; they are numbered from grid.size() on, coarser
// levels first.
//
// A block of level l covers 2^l x 2^l cells; level l has s = side >> l of them a side and block
// (i, j) is number s * s + j * s + i. Blocks begin with level 1: a cell's posts are read anyway. A
// maximum is that of the block's posts, or one more: it is even in smooth blocks, whose surface is
// off a cell between their corners by no more than kSmooth of their width.
struct HeightPyramid {
  static constexpr double kSmooth = 0.0625;

  Grid grid;
  float base_m = 0.0f, step_m = 1.0f;
  int side = 1;                            // cells a side, up to a power of two
  int levels = 0;                          // log2(side)
  std::vector<std::uint16_t> posts = {};   // and one more
  std::vector<std::uint16_t> maxima = {};  // likewise
  // Cells [begin, end) along both axes where there is nothing, none if they are equal.
  int hole_begin = 0, hole_end = 0;
};

// Cells [begin, end) along both axes of a grid.
struct CellSquare {
  int begin = 0, end = 0;
};

// From the codes of the posts of a square grid of 2 to 16385 posts a side; row by row. 3.7 bytes a
// post if there are 2^n + 1 a side, and up to 8.7 if there are a few more.
HeightPyramid make_height_pyramid(const Grid& grid, float base_m, float step_m,
                                  std::vector<std::uint16_t> posts, CellSquare hole,
                                  Workers& workers);

// From heights, to the nearest of 2^16 steps between the lowest and the highest.
HeightPyramid make_height_pyramid(const HeightGrid& heights, CellSquare hole, Workers& workers);

// Bilinear height at a point; beyond the grid that of its border.
double height_at(const HeightPyramid& pyramid, glm::dvec2 p_world);

// At least the height of every point with low <= p <= high; beyond the grid that of its border.
float highest_over(const HeightPyramid& pyramid, glm::dvec2 low, glm::dvec2 high);

// Unit normal, upwards, of the surface at a point; beyond the grid that of its border. The same
// bits everywhere.
glm::vec3 normal_at(const HeightPyramid& pyramid, glm::dvec2 p_world);

}  // namespace swell::terrain
