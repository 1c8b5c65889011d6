// Rivers and lakes as scenes describe them: bodies of water at levels of their own.
#pragma once

#include <glm/glm.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace swell::ocean {

// What is wrong with rivers or lakes, as "KEY, got WHAT, allowed WHAT" in one line.
struct RiverError : std::runtime_error {
  RiverError(const std::string& of_key, const std::string& has, const std::string& may)
      : std::runtime_error(of_key + ", got " + has + ", allowed " + may),
        key(of_key),
        got(has),
        allowed(may) {}

  std::string key, got, allowed;
};

// A river, from its source to its mouth. Lists have a value for each point, or one for all.
struct River {
  std::string name = {};                 // by which others join it
  std::string from = {};                 // the river that it leaves or the lake; empty: a source
  std::string into = {};                 // the river that it joins or the lake; empty: the sea
  std::vector<glm::dvec2> path_m = {};   // its middle: east, north; two points or more
  std::vector<double> width_m = {20.0};  // of the water, [1, 2000]
  std::vector<double> depth_m = {1.5};   // in the middle, [0.1, 100]
  std::vector<double> surface_m = {};    // heights of the surface; never rising downstream
  double speed_mps = 0.8;                // of a source: the mean at its first point, [0, 10]

  bool operator==(const River&) const = default;
};

// A lake: all that lies below its level, inside an outline or as far as water runs from a place.
struct Lake {
  std::string name = {};
  double level_m = 0.0;
  std::vector<glm::dvec2> outline_m = {};  // three points or more; empty: fill to the level
  glm::dvec2 position_m{0.0};              // of a lake that is filled: a place in it
  double depth_m = 0.0;  // the ground inside the outline is dug so deep; 0: it stays

  bool operator==(const Lake&) const = default;
};

}  // namespace swell::ocean
