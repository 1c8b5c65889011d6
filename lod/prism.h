// The prism of an envelope in metres, as queries of a mesh test it.
#pragma once

#include <algorithm>
#include <array>
#include <glm/glm.hpp>

#include "lod/envelope.h"
#include "lod/mesh_query.h"
#include "math/check.h"

namespace swell::lod {

// Queries prune by tests that rounding may tip. Each gives way by this part of the largest number
// in it, a thousand times what rounding does.
inline constexpr double kSlack = 0x1p-42;

inline void check_heights(const HeightMesh& surface) {
  SWELL_CHECK(surface.height_m.size() == surface.mesh.lattice.size(), "{} vertices, {} heights",
              surface.mesh.lattice.size(), surface.height_m.size());
}

// Domain::point(), step_m worked out before: boxes hold their vertices to the bit.
inline glm::dvec2 lattice_world(const Domain& domain, double step_m, glm::ivec2 p) {
  return lattice_point(domain.min_world, step_m, glm::dvec2(p));
}

struct Box {
  glm::dvec3 low, high;
};

inline Box box_of(const HeightMesh& surface, double step_m, const Envelope& e) {
  return {{lattice_world(surface.domain, step_m, e.low()), e.height.low_m},
          {lattice_world(surface.domain, step_m, e.high()), e.height.high_m}};
}

// Distance to the box, squared; never above that to a point in it, to the bit.
inline double distance2_to(const Box& box, glm::dvec3 p) {
  const glm::dvec3 d = glm::max(glm::max(box.low - p, p - box.high), glm::dvec3(0.0));
  return (d.x * d.x + d.y * d.y) + d.z * d.z;
}

inline double distance2(glm::dvec3 a, glm::dvec3 b) {
  const glm::dvec3 d = a - b;
  return (d.x * d.x + d.y * d.y) + d.z * d.z;
}

// The way along side k of a triangle of the bintree: a multiple of 45 degrees, parts -1, 0 or 1.
inline glm::ivec2 side_direction(const Envelope& e, std::size_t k) {
  return glm::sign(e.corner[(k + 1) % 3] - e.corner[k]);
}

// A triangle of the mesh.
inline std::array<glm::dvec3, 3> corners_of(const HeightMesh& surface, int triangle) {
  const std::uint32_t* v = &surface.mesh.indices[3 * static_cast<std::size_t>(triangle)];
  return {vertex_world(surface, v[0]), vertex_world(surface, v[1]), vertex_world(surface, v[2])};
}

}  // namespace swell::lod
