#include "lod/mesh_query.h"

#include "lod/prism.h"
#include "math/check.h"
#include "math/elementary.h"

namespace swell::lod {
namespace {

void check_query(const HeightMesh& surface, glm::dvec3 p) {
  check_heights(surface);
  SWELL_CHECK(std::isfinite(p.x + p.y + p.z), "({}, {}, {})", p.x, p.y, p.z);
}

// Twice the area of the triangle (origin, a, b).
double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

// ---- nearest ----

// Goes down the nearer half first, as long as it is not farther than the best so far.
// Best: distance2 and void test(int triangle).
template <class Best>
struct NearestSearch {
  const HeightMesh& surface;
  double step_m;
  glm::dvec3 p;
  Best best;
  int visited = 0;

  void visit(const std::array<Envelope, 2>& pair) {
    visited += 2;
    const std::array<double, 2> d2 = {distance2_to(box_of(surface, step_m, pair[0]), p),
                                      distance2_to(box_of(surface, step_m, pair[1]), p)};
    const std::size_t first = d2[1] < d2[0] ? 1 : 0;
    for (const std::size_t i : {first, 1 - first}) {
      if (d2[i] > best.distance2 * (1.0 + kSlack)) continue;
      if (pair[i].is_leaf())
        best.test(pair[i].first_leaf);
      else
        visit(halves_of(surface.envelopes, pair[i]));
    }
  }
};

struct BestVertex {
  const HeightMesh& surface;
  glm::dvec3 p;
  double distance2 = kInfinity<double>;
  std::uint32_t vertex = 0;

  void test(int triangle) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = surface.mesh.indices[3 * static_cast<std::size_t>(triangle) + k];
      const double d2 = lod::distance2(vertex_world(surface, v), p);
      if (d2 > distance2 || (d2 == distance2 && v >= vertex)) continue;
      distance2 = d2;
      vertex = v;
    }
  }
};

struct BestEdge {
  const HeightMesh& surface;
  glm::dvec3 p;
  double distance2 = kInfinity<double>;
  std::array<std::uint32_t, 2> ends{};
  glm::dvec3 nearest{0.0};

  void test(int triangle) {
    const std::uint32_t* v = &surface.mesh.indices[3 * static_cast<std::size_t>(triangle)];
    for (std::size_t k = 0; k < 3; ++k)
      test_edge({std::min(v[k], v[(k + 1) % 3]), std::max(v[k], v[(k + 1) % 3])});
  }

  void test_edge(std::array<std::uint32_t, 2> edge) {
    const glm::dvec3 a = vertex_world(surface, edge[0]), b = vertex_world(surface, edge[1]);
    const double along = glm::dot(p - a, b - a) / glm::dot(b - a, b - a);
    const glm::dvec3 q = a + std::clamp(along, 0.0, 1.0) * (b - a);
    const double d2 = lod::distance2(q, p);
    if (d2 > distance2 || (d2 == distance2 && edge >= ends)) return;
    distance2 = d2;
    ends = edge;
    nearest = q;
  }
};

template <class Best>
NearestSearch<Best> find_nearest(const HeightMesh& surface, glm::dvec3 p) {
  check_query(surface, p);
  NearestSearch<Best> search{surface, surface.domain.step_m(), p, Best{surface, p}};
  search.visit(roots_of(surface.envelopes, surface.domain.lattice_bits));
  return search;
}

// ---- boxes ----

// Do the projections of the triangle and of a box around the origin on `axis` lie apart?
bool are_apart(const std::array<glm::dvec3, 3>& v, glm::dvec3 half, glm::dvec3 axis) {
  const glm::dvec3 at(glm::dot(v[0], axis), glm::dot(v[1], axis), glm::dot(v[2], axis));
  const double reach = glm::dot(half, glm::abs(axis));
  return std::min(std::min(at.x, at.y), at.z) > reach ||
         std::max(std::max(at.x, at.y), at.z) < -reach;
}

// Two convex bodies touch unless they lie apart along a face's normal or a product of two edges.
// Source: Akenine-Moller, Fast 3D Triangle-Box Overlap Testing, 2001.
bool touch(std::array<glm::dvec3, 3> v, const Box& box) {
  const glm::dvec3 half = 0.5 * (box.high - box.low);
  for (glm::dvec3& p : v) p -= box.low + half;
  const std::array<glm::dvec3, 3> edge = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};
  if (are_apart(v, half, glm::cross(edge[0], edge[1]))) return false;
  for (int k = 0; k < 3; ++k) {
    glm::dvec3 axis(0.0);
    axis[k] = 1.0;
    if (are_apart(v, half, axis)) return false;
    for (const glm::dvec3& e : edge)
      if (are_apart(v, half, glm::cross(axis, e))) return false;
  }
  return true;
}

struct BoxSearch {
  const HeightMesh& surface;
  double step_m;
  Box box;
  std::vector<int>& triangles;
  int visited = 0;

  void visit(const Envelope& e) {
    ++visited;
    if (!may_touch(e)) return;
    if (!e.is_leaf())
      for (const Envelope& half : halves_of(surface.envelopes, e)) visit(half);
    else if (touch(corners_of(surface, e.first_leaf), box))
      triangles.push_back(e.first_leaf);
  }

  // The heights overlap, and no side of the triangle has all the box on its outer side.
  bool may_touch(const Envelope& e) const {
    const double slack_z = kSlack * (std::abs(box.low.z) + std::abs(box.high.z));
    if (static_cast<double>(e.height.low_m) > box.high.z + slack_z ||
        static_cast<double>(e.height.high_m) < box.low.z - slack_z)
      return false;
    const Box around = box_of(surface, step_m, e);
    for (int k = 0; k < 2; ++k) {
      const double slack = kSlack * (std::abs(box.low[k]) + std::abs(box.high[k]));
      if (around.low[k] > box.high[k] + slack || around.high[k] < box.low[k] - slack) return false;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec2 side = side_direction(e, k);
      const glm::dvec2 corner = lattice_world(surface.domain, step_m, e.corner[k]);
      const glm::dvec2 inmost(side.y > 0.0 ? box.low.x : box.high.x,
                              side.x > 0.0 ? box.high.y : box.low.y);
      const glm::dvec2 from = inmost - corner;
      const double slack = kSlack * (std::abs(inmost.x) + std::abs(inmost.y) + std::abs(corner.x) +
                                     std::abs(corner.y));
      if (cross(side, from) < -slack) return false;
    }
    return true;
  }
};

// ---- places ----

// The half that holds lattice point p; the first if both do. The cut runs from the middle to the
// apex, and the half at corner[0] is on its right.
const Envelope& half_at(const Envelope& whole, const std::array<Envelope, 2>& half, glm::dvec2 p) {
  const glm::ivec2 middle = half[0].corner[1];
  const double left =
      cross(glm::dvec2(glm::sign(whole.corner[1] - middle)), p - glm::dvec2(middle));
  const bool first_is_right = whole.level % 2 == 0;
  return half[first_is_right ? left > 0.0 : left < 0.0];
}

}  // namespace

glm::dvec3 vertex_world(const HeightMesh& surface, std::size_t vertex) {
  return {surface.domain.point(surface.mesh.lattice[vertex]), surface.height_m[vertex]};
}

TriangleAt triangle_at(const HeightMesh& surface, glm::dvec2 p_world) {
  check_query(surface, {p_world, 0.0});
  const int n = 1 << surface.domain.lattice_bits;
  const glm::dvec2 p = (p_world - surface.domain.min_world) / surface.domain.step_m();
  TriangleAt at;
  if (!(p.x >= 0.0 && p.y >= 0.0 && p.x <= n && p.y <= n)) return at;

  // Down to the leaf.
  const std::array<Envelope, 2> root = roots_of(surface.envelopes, surface.domain.lattice_bits);
  Envelope e = root[p.y > p.x];
  for (at.visited = 1; !e.is_leaf(); ++at.visited)
    e = half_at(e, halves_of(surface.envelopes, e), p);
  at.triangle = e.first_leaf;

  // Shares of its area.
  const glm::dvec2 a = glm::dvec2(e.corner[0]) - p, b = glm::dvec2(e.corner[1]) - p,
                   c = glm::dvec2(e.corner[2]) - p;
  const glm::dvec3 area = glm::max(glm::dvec3(cross(b, c), cross(c, a), cross(a, b)), 0.0);
  at.weight = area / (area.x + area.y + area.z);
  const std::uint32_t* v = &surface.mesh.indices[3 * static_cast<std::size_t>(at.triangle)];
  at.height_m = glm::dot(at.weight, glm::dvec3(surface.height_m[v[0]], surface.height_m[v[1]],
                                               surface.height_m[v[2]]));
  return at;
}

NearestVertex nearest_vertex(const HeightMesh& surface, glm::dvec3 p_world) {
  const auto search = find_nearest<BestVertex>(surface, p_world);
  return {search.best.vertex, std::sqrt(search.best.distance2), search.visited};
}

NearestEdge nearest_edge(const HeightMesh& surface, glm::dvec3 p_world) {
  const auto search = find_nearest<BestEdge>(surface, p_world);
  return {search.best.ends, search.best.nearest, std::sqrt(search.best.distance2), search.visited};
}

int find_in_box(const HeightMesh& surface, glm::dvec3 low_world, glm::dvec3 high_world,
                std::vector<int>& triangles) {
  check_query(surface, low_world);
  check_query(surface, high_world);
  triangles.clear();
  BoxSearch search{surface, surface.domain.step_m(), {low_world, high_world}, triangles};
  for (const Envelope& root : roots_of(surface.envelopes, surface.domain.lattice_bits))
    search.visit(root);
  return search.visited;
}

}  // namespace swell::lod
