// Where the points of a regular lattice lie: the one expression for it, so that all who place a
// point get the same bits.
#pragma once

#include <glm/glm.hpp>

namespace swell {

// Point (i, j) of a lattice with its corner (0, 0) at `corner` and steps of step_m, both in metres,
// along both axes or along each; the result is in the corner's space.
inline glm::dvec2 lattice_point(glm::dvec2 corner, double step_m, glm::dvec2 ij) {
  return corner + step_m * ij;
}
inline glm::dvec2 lattice_point(glm::dvec2 corner, glm::dvec2 step_m, glm::dvec2 ij) {
  return corner + step_m * ij;
}

}  // namespace swell
