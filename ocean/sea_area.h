// Where the sea has waves.
#pragma once

#include <glm/glm.hpp>

namespace swell::ocean {

// The sea in the world: endless, or waves displace the surface inside a rectangle (fading to flat
// over the last tenth), and the flat sea with the same wave normals goes on to the horizon.
struct SeaArea {
  glm::dvec2 centre_m{0.0};
  glm::dvec2 size_m{0.0};  // both 0: endless

  bool is_endless() const { return size_m == glm::dvec2(0.0); }
};

}  // namespace swell::ocean
