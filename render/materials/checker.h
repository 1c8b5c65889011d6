// Squares laid over the ground or an object, as on a chessboard: what is measured in pictures is
// known from them.
#pragma once

#include <glm/glm.hpp>

namespace swell::render {

inline constexpr float kDarkSquare = 0.06f, kLightSquare = 0.8f;  // reflectances, of the ground

// Squares of one size, parallel to the world's axes, one with a corner at the origin.
struct Checker {
  float per_m = 0.0f;   // squares a metre; 0: there are none
  glm::vec2 eye{0.0f};  // the eye's place in a pair of them, in squares, [0, 2)
};

inline Checker make_checker(double side_m, glm::dvec2 eye_m) {
  if (side_m <= 0.0) return {};
  const glm::dvec2 pairs = eye_m / (2.0 * side_m);
  return {static_cast<float>(1.0 / side_m), glm::vec2(2.0 * glm::fract(pairs))};
}

}  // namespace swell::render
