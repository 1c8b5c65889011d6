// What stands in a river: outlines in plan that its water flows around.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace swell::ocean {

// An outline: (x / a)^n + (y / b)^n = 1 along its own axes, with n = 2, an ellipse, or n = 4, a box
// with rounded corners.
struct Obstacle {
  glm::dvec2 middle{0.0};      // world
  glm::dvec2 ahead{0.0, 1.0};  // unit
  glm::dvec2 half_m{1.0};      // half its size across and along `ahead`, more than 0
  bool is_round = true;        // an ellipse
};

// Returns how far p is from the middle in sizes: 1 on the outline, less inside.
double sizes_from(const Obstacle& obstacle, glm::dvec2 p);

// Returns metres from the outline to p along the line through the middle, negative inside: at
// least as many as to the nearest place of the outline.
double metres_outside(const Obstacle& obstacle, glm::dvec2 p);

// Points of the outline, all around.
std::vector<glm::dvec2> outline_of(const Obstacle& obstacle);

// Returns an obstacle which holds all that is nearer than by_m; by_m >= 0. Of an ellipse it is one
// that touches the line at that distance in four places (Kurzhanski, Valyi, Ellipsoidal Calculus
// for Estimation and Control, 1997), and a box takes a twentieth more.
Obstacle widened(const Obstacle& obstacle, double by_m);

}  // namespace swell::ocean
