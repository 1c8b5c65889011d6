// Heights on a regular grid: the one form in which land and sea floor are kept, asked and passed
// on.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <tuple>
#include <vector>

#include "math/lattice.h"

namespace swell::terrain {

// samples_x x samples_y points; point (i, j) is at min_world + spacing_m (i, j).
struct Grid {
  glm::dvec2 min_world{0.0};  // x east, y north, in metres
  double spacing_m = 1.0;
  int samples_x = 0, samples_y = 0;
  static constexpr bool kPlainBytes = true;

  std::size_t size() const {
    return static_cast<std::size_t>(samples_x) * static_cast<std::size_t>(samples_y);
  }
  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(samples_x) +
           static_cast<std::size_t>(i);
  }
  glm::dvec2 point(int i, int j) const {
    return lattice_point(min_world, spacing_m, glm::dvec2(i, j));
  }
  // From the first sample of a row to its last: the side of a square.
  double size_m() const { return spacing_m * (samples_x - 1); }
  glm::dvec2 extent_m() const { return spacing_m * glm::dvec2(samples_x - 1, samples_y - 1); }
  bool holds(glm::dvec2 p_world) const {  // border included; NaN is nowhere
    const glm::dvec2 high = min_world + extent_m();
    return p_world.x >= min_world.x && p_world.y >= min_world.y && p_world.x <= high.x &&
           p_world.y <= high.y;
  }
};

// The ground around a map (terrain/apron.h): it goes on and sinks to the floor over this width.
struct Apron {
  double width_m = 0.0;  // 0: none, the height of the border goes on
  double floor_m = 0.0;  // from there on
  static constexpr bool kPlainBytes = true;
  bool operator==(const Apron&) const = default;
};

// Heights above mean sea level in metres: positive on land, negative under water.
struct HeightGrid {
  Grid grid;
  std::vector<float> height_m = {};         // sample (i, j) at grid.index(i, j)
  float lowest_m = 0.0f, highest_m = 0.0f;  // of the samples; set by build_terrain()
  Apron apron = {};                         // likewise (terrain/terrain.h)

  auto fields() { return std::tie(grid, height_m, lowest_m, highest_m, apron); }
};

// Bilinear height at a world point. Beyond the grid there is its apron, or without one the height
// of the border. The grid has a sample or more; NaN counts as the lower border, or as far away.
double height_at(const HeightGrid& heights, glm::dvec2 p_world);

// Its slopes dH/dx and dH/dy in the cell there; beyond the grid those of the cell at the border.
glm::dvec2 slope_at(const HeightGrid& heights, glm::dvec2 p_world);

// height_at() of many points. p_world and height_m have the same length and do not overlap. May run
// on several threads at once.
void sample_heights(const HeightGrid& heights, std::span<const glm::dvec2> p_world,
                    std::span<float> height_m);

// Samples height_at() at the points of another grid.
HeightGrid resample(const HeightGrid& heights, const Grid& grid);

// dH/dx and dH/dy at every sample, laid out as height_m: central differences, one-sided at the
// border. Both arrays hold grid.size() elements; the grid has two samples a side or more.
void sample_slopes(const HeightGrid& heights, std::span<float> slope_x, std::span<float> slope_y);

}  // namespace swell::terrain
