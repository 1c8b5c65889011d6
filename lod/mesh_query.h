// Questions to a drawn mesh: what a ray hits, what a box touches, what is nearest, what lies under
// a place. Each goes down the envelopes from the roots and leaves out what cannot matter, so it
// meets O(log n) of them (as many for each triangle of an answer that has several), and gives what
// a test of every triangle would, bit for bit.
//
//   lod::Envelopes envelopes;
//   lod::build_envelopes(mesh, height_m, envelopes);
//   const lod::HeightMesh surface{mesh, envelopes, height_m, roam.domain()};
//   const lod::RayHit hit = lod::intersect_ray(surface, eye_world, direction, 5000.0);
//   if (hit.triangle >= 0) ...
//
// Places are world metres, finite. All may be called from many threads at once; none allocates.
// `visited` in an answer counts the envelopes met.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "lod/envelope.h"
#include "lod/roam.h"

namespace swell::lod {

// A mesh with the heights of one frame. `envelopes` are of this mesh and hold these heights.
struct HeightMesh {
  const Mesh& mesh;
  const Envelopes& envelopes;
  std::span<const float> height_m;  // per vertex
  Domain domain;
};

// Where a vertex is.
glm::dvec3 vertex_world(const HeightMesh& surface, std::size_t vertex);

inline constexpr int kNoTriangle = -1;

// A place in a triangle: the sum of weight[k] times vertex indices[3 triangle + k]. The weights are
// in [0, 1] and add up to 1.
struct RayHit {
  int triangle = kNoTriangle;
  double distance_m = 0.0;
  glm::dvec3 weight{0.0};
  int visited = 0;
};

// The nearest triangle that origin + s direction, 0 <= s <= max_distance_m, passes through, from
// either side; of several at the same distance, the one of the lowest number. The direction has any
// length over 0; distances are metres all the same. No ray slips between two triangles. A ray in
// the very plane of a triangle passes by it; one that begins in a triangle may, by rounding.
RayHit intersect_ray(const HeightMesh& surface, glm::dvec3 origin_world, glm::dvec3 direction,
                     double max_distance_m);

// Finds the triangle of intersect_ray() by testing every one: for meshes of no bintree, whose
// envelopes are not looked at.
RayHit intersect_ray_in_all(const HeightMesh& surface, glm::dvec3 origin_world,
                            glm::dvec3 direction, double max_distance_m);

struct TriangleAt {
  int triangle = kNoTriangle;
  double height_m = 0.0;  // of the triangle there
  glm::dvec3 weight{0.0};
  int visited = 0;
};

// The triangle over or under a place; on an edge the one of the lowest number, outside the domain
// none.
TriangleAt triangle_at(const HeightMesh& surface, glm::dvec2 p_world);

struct NearestVertex {
  std::uint32_t vertex = 0;
  double distance_m = 0.0;
  int visited = 0;
};

// The vertex nearest to a point; of several, the lowest.
NearestVertex nearest_vertex(const HeightMesh& surface, glm::dvec3 p_world);

struct NearestEdge {
  std::array<std::uint32_t, 2> vertex{};  // its ends, the lower first
  glm::dvec3 p_world{0.0};                // its nearest point
  double distance_m = 0.0;
  int visited = 0;
};

// The edge nearest to a point; of several, the one with the lowest first vertex, then second.
NearestEdge nearest_edge(const HeightMesh& surface, glm::dvec3 p_world);

// Finds the triangles that have a point in the box [low, high], its faces included, in ascending
// order. Returns the number of envelopes met. Keeps the vector's capacity.
int find_in_box(const HeightMesh& surface, glm::dvec3 low_world, glm::dvec3 high_world,
                std::vector<int>& triangles);

}  // namespace swell::lod
