// Where the sea has waves.
#pragma once

#include <glm/glm.hpp>

namespace swell::ocean {

// The sea in the world: waves displace the surface inside the rectangle (fading to flat over the
// last tenth), and the flat sea with the same wave normals goes on to the horizon.
struct SeaArea {
  glm::dvec2 centre_m{0.0};
  glm::dvec2 size_m{3000.0, 2000.0};
};

}  // namespace swell::ocean
