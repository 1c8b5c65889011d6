// Lakes that fill the ground up to their level.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "ocean/inland/river.h"
#include "terrain/height_grid.h"

namespace swell::ocean {

// Which cells of the land are filled.
struct LakeFill {
  terrain::Grid grid;
  std::vector<std::uint8_t> lake;     // per sample: the number of its lake + 1, 0: dry; empty: none
  std::vector<double> level_m;        // of the lakes
  glm::dvec2 low{1e30}, high{-1e30};  // a box around them

  auto fields() { return std::tie(grid, lake, level_m, low, high); }

  // The level of the lake that one of the four samples around p, or one next to them, is in.
  std::optional<double> level_near(glm::dvec2 p) const;
  bool touches(glm::dvec2 corner, double size_m) const;
};

// Fills lakes without an outline from their places, and checks the others' rims. Throws RiverError:
// a lake above its rim (water that would leave the land, or an outline over lower land), a dry
// place.
LakeFill fill_lakes(std::span<const Lake> lakes, const terrain::HeightGrid& land);

}  // namespace swell::ocean
