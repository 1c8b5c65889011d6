// What a shore does to the sea before it, as a map.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <tuple>

#include "math/parallel.h"
#include "ocean/coast/surf_fronts.h"
#include "texture/packed_map.h"

namespace swell::render {

struct WorldState;

// Points a side of NearShoreMap::map.
inline constexpr int kNearShoreSize = 512;

// What a shore does to the sea before it, of a world with shelter: over the terrain's square with
// its apron, kNearShoreSize points a side: the part of the open sea's waves that land takes away,
// in [0, 1], and the distance to the shore over the surf's reach, [-1, 1]; of fronts that lift the
// water, see below.
struct NearShoreMap {
  texture::PackedMap2 map;
  glm::dvec2 min_world{0.0};
  double size_m = 0.0;
  ocean::SurfZone zone;
  // Fronts that lift the water; none: they are foam alone. Their maps lie over the same square.
  std::optional<ocean::SurfFronts> fronts;
  // The root of the part of their reach over kFrontsFrom, negative on land, and their height over
  // lift_m, in [0, 1].
  texture::PackedMap2 lift;
  float lift_m = 0.0f;
  // The slope of the part [1/reach]: points out to sea.
  texture::PackedMap2 seaward;

  auto fields() { return std::tie(map, min_world, size_m, zone, fronts, lift, lift_m, seaward); }
};

// The same bits with any workers.
NearShoreMap build_near_shore(const WorldState& world, Workers& workers);

}  // namespace swell::render
