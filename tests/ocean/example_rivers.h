// Rivers that several tests look at.
#pragma once

#include <vector>

#include "ocean/inland/river.h"

namespace swell::ocean {

inline River straight(double width_m, double speed_mps) {
  River river;
  river.name = "main";
  river.path_m = {{-600.0, 0.0}, {600.0, 0.0}};
  river.width_m = {width_m};
  river.surface_m = {1.0, 0.0};
  river.speed_mps = speed_mps;
  return river;
}

// A river with bends and of several widths.
inline River winding() {
  River river;
  river.name = "main";
  river.path_m = {{-500, 0}, {-300, 60}, {-100, -40}, {100, 50}, {300, -30}, {500, 0}};
  river.width_m = {24, 30, 20, 26, 34, 30};
  river.surface_m = {5, 4, 3, 2, 1, 0};
  river.speed_mps = 1.2;
  return river;
}

// One that joins it from the left, or from the right.
inline River tributary(bool left) {
  River river;
  river.name = "tributary";
  river.into = "main";
  river.path_m = left ? std::vector<glm::dvec2>{{-220, 300}, {-180, 150}, {-100, -40}}
                      : std::vector<glm::dvec2>{{-220, -300}, {-180, -180}, {-100, -40}};
  river.width_m = {12};
  river.surface_m = {9, 6, 3};
  river.speed_mps = 1.5;
  return river;
}

// An arm that leaves the river and comes back to it, around an island.
inline River arm() {
  River river;
  river.name = "arm";
  river.from = river.into = "main";
  river.path_m = {{75, 45}, {130, 120}, {220, 100}, {290, -25}};
  river.width_m = {14};
  river.surface_m = {2.2, 2, 1.6, 1};
  return river;
}

}  // namespace swell::ocean
