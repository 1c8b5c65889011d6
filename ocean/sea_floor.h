// The depth of the water on a regular grid: what waves near a coast have to know.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "math/parallel.h"

namespace swell::ocean {

// samples_x x samples_y points; point (i, j) is at min_world + spacing_m (i, j).
struct FloorGrid {
  glm::dvec2 min_world{0.0};  // x east, y north, in metres
  double spacing_m = 1.0;
  int samples_x = 0, samples_y = 0;

  std::size_t size() const {
    return static_cast<std::size_t>(samples_x) * static_cast<std::size_t>(samples_y);
  }
  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(samples_x) +
           static_cast<std::size_t>(i);
  }
  glm::dvec2 point(int i, int j) const { return min_world + spacing_m * glm::dvec2(i, j); }
};

struct SeaFloor {
  FloorGrid grid;
  // Below mean sea level, > 0 in the water, <= 0 on land; sample (i, j) at grid.index(i, j).
  std::vector<float> depth_m;
};

// Throws std::invalid_argument, naming the value, unless the grid has 1 to 2^26 samples, a positive
// finite spacing and corner, as many depths as samples, and no depth beyond +-1e6 m or NaN.
void check_sea_floor(const SeaFloor& floor);

// Bilinear depth and its gradient (depth_m per metre). Beyond the grid the depth of its border
// goes on. The floor has passed check_sea_floor; p_world is finite.
double depth_at(const SeaFloor& floor, glm::dvec2 p_world);
glm::dvec2 depth_gradient_at(const SeaFloor& floor, glm::dvec2 p_world);

// Asks depth_m(p_world) for the depth at each point of the grid, row by row. Errors as
// check_sea_floor.
SeaFloor make_sea_floor(const FloorGrid& grid, FunctionRef<double(glm::dvec2)> depth_m);

// From heights above mean sea level (terrain: positive on land), row by row.
SeaFloor make_sea_floor_from_heights(const FloorGrid& grid, std::span<const float> height_m);

inline constexpr double kShortestStretch_m = 1e-3;

// A beach of one slope along a coast line. Source: Elykov, Belago, Kuzikovsky, Nekrasov, 2000, the
// figure of the waves at a beach.
struct PlaneBeach {
  // Two points or more, each at least kShortestStretch_m from the one before; the sea is on the
  // left when walking from the first to the last. The first and last stretch go on for ever. A line
  // may cross itself: the nearest stretch decides.
  std::vector<glm::dvec2> coast;
  double slope = 0.02;        // metres of depth per metre of distance from the coast line, > 0
  double max_depth_m = 50.0;  // > 0; the floor is flat from there on
};

// Distance in metres from p_world to the coast line, positive on the sea's side.
double distance_to_coast(std::span<const glm::dvec2> coast, glm::dvec2 p_world);

// depth = slope x distance to the coast line, at most max_depth_m. Errors as check_sea_floor, and
// for a bad beach.
SeaFloor make_plane_beach(const FloorGrid& grid, const PlaneBeach& beach);

}  // namespace swell::ocean
