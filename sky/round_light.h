// Light that the air of a round earth scatters once or more: for twilight, when all light comes
// from far away. Each order is gathered along whole rays, in 96 directions.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "math/parallel.h"
#include "sky/air_paths.h"

namespace swell::sky {

// The first columns of the tables are gathered, as far as rays from under a low sun go; those
// beyond are as the last of them.
inline constexpr int kRoundSines = 32;

// As the tables of Atmosphere.
struct RoundLight {
  std::vector<glm::vec3> multiple, uneven, haze;
};
RoundLight scatter_on_round_earth(const Atmosphere& atmosphere, Workers& workers);

}  // namespace swell::sky
