// Where the sea has waves.
#pragma once

#include <glm/glm.hpp>

namespace swell::ocean {

// The sea in the world: endless, or waves displace the surface inside a rectangle (fading to flat
// over the last tenth), and the flat sea with the same wave normals goes on to the horizon.
struct SeaArea {
  glm::dvec2 centre_m{0.0};
  glm::dvec2 size_m{0.0};  // 0: endless along that axis

  bool is_endless() const { return size_m == glm::dvec2(0.0); }

  // The rectangle's size: of an endless axis more than any place is away.
  glm::dvec2 limits_m() const {
    constexpr double kNoLimit_m = 1e30;
    return {size_m.x > 0.0 ? size_m.x : kNoLimit_m, size_m.y > 0.0 ? size_m.y : kNoLimit_m};
  }
};

}  // namespace swell::ocean
