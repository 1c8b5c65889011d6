// The sea floor: what waves near a coast have to know of a height grid, and beaches of one slope.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "math/parallel.h"
#include "terrain/height_grid.h"

namespace swell::terrain {

// A sea floor is a HeightGrid that has passed this. Throws std::invalid_argument, naming the value,
// unless the grid has 1 to 2^26 samples, a positive finite spacing and corner, as many heights as
// samples, and none beyond +-1e6 m or NaN.
void check_sea_floor(const HeightGrid& floor);

// Metres below mean sea level: > 0 in the water, <= 0 on land. At a sample, and bilinear as
// height_at(); p_world is finite.
inline double depth_of_sample(const HeightGrid& floor, std::size_t sample) {
  return -static_cast<double>(floor.height_m[sample]);
}
inline double depth_at(const HeightGrid& floor, glm::dvec2 p_world) {
  return -height_at(floor, p_world);
}

// Asks depth_m(p_world) for the depth at each point of the grid, row by row. Errors as
// check_sea_floor.
HeightGrid make_sea_floor(const Grid& grid, FunctionRef<double(glm::dvec2)> depth_m);

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
HeightGrid make_plane_beach(const Grid& grid, const PlaneBeach& beach);

}  // namespace swell::terrain
