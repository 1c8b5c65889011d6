// What trees do to the land that they stand on: the colour of their crowns from afar, their shade
// and litter near by.
#pragma once

#include <glm/glm.hpp>

#include "render/packets/square_map.h"
#include "render/tile/inputs.h"

namespace swell::terrain {
struct Grid;
}

namespace swell::render {

struct Canopy {
  SquareMap cover;           // Forest::cover; no map: there are no trees
  glm::vec3 crowns{0.0f};    // their colour from afar
  float near_log2_m = 0.0f;  // log2 of a pixel's size: up to there trees are drawn
  float per_log2 = 1.0f;     // and this much of them is colour for each doubling after that
};

Canopy make_canopy(const MaterialInputs& in, const terrain::Grid& square, glm::dvec2 eye);

}  // namespace swell::render
