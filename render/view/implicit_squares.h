// Which squares of a picture a part of an implicit surface may show in: bounds of its terms over
// what the squares' rays pass.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "render/view/implicit_rays.h"

namespace swell::render {

// Squares side by side in 8 columns and 8 rows; square (i, j) is bit 8 j + i of a mask.
inline constexpr int kSquares = 8;

// The points that the squares' rays pass between two depths, in floats relative to the middle of a
// part's box: those of square (i, j) are middle + s along + s' across + s'' down with s, s', s'' in
// [-1, 1]; middle and along grow by their steps from square to square.
struct SquareBeams {
  glm::vec3 middle, middle_dx, middle_dy;
  glm::vec3 along, along_dx, along_dy;
  glm::vec3 across, down;
};

// Those of `squares` where all terms of the part, and its table, may be at least 0; never leaves
// out one where they are, nor one where the rays' rounding makes them so.
std::uint64_t squares_showing(const PosedImplicit& implicit, const RayPart& part,
                              const SquareBeams& beams, std::uint64_t squares);

}  // namespace swell::render
