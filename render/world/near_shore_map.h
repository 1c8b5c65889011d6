// What a shore does to the sea before it, as a map.
#pragma once

#include <glm/glm.hpp>

#include "math/parallel.h"
#include "texture/packed_map.h"

namespace swell::render {

struct WorldState;

// Points a side of NearShoreMap::map.
inline constexpr int kNearShoreSize = 512;

// What a shore does to the sea before it, of a world with shelter: over the terrain's square with
// its apron, kNearShoreSize points a side: the part of the open sea's waves that land takes away,
// in [0, 1], and the distance to the shore over the surf's reach, [-1, 1].
struct NearShoreMap {
  texture::PackedMap2 map;
  glm::dvec2 min_world{0.0};
  double size_m = 0.0;
  double reach_m = 0.0, reach_s = 0.0;  // waves need so long from there to the shore
  double period_s = 1.0;                // of waves that break
};

// The same bits with any workers.
NearShoreMap build_near_shore(const WorldState& world, Workers& workers);

}  // namespace swell::render
