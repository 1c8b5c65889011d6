// Which triangle a ray hits.
#include <limits>

#include "lod/mesh_query.h"
#include "lod/prism.h"
#include "math/check.h"
#include "math/ray_triangle.h"

namespace swell::lod {
namespace {

// What is left of the ray after cutting it.
struct Span {
  double begin_m, end_m;

  // Keeps the part where value + s slope >= 0.
  void cut(double value, double slope) {
    if (slope > 0.0) {
      begin_m = std::max(begin_m, -value / slope);
    } else if (slope < 0.0) {
      end_m = std::min(end_m, -value / slope);
    } else if (value < 0.0) {
      end_m = -1.0;
    }
  }
  bool is_empty() const { return begin_m > end_m; }
};

struct RaySearch {
  const HeightMesh& surface;
  double step_m;
  Ray ray;  // along: of length 1
  double max_m;
  RayHit hit = {};

  // The part of the ray in the envelope's prism, a little widened.
  Span span_in(const Envelope& e) const {
    Span span{0.0, max_m};
    const glm::dvec2 o(ray.origin), d(ray.along);
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec2 side = side_direction(e, k);
      const glm::dvec2 from = o - lattice_world(surface.domain, step_m, e.corner[k]);
      const double slack = kSlack * (std::abs(from.x) + std::abs(from.y));
      span.cut(side.x * from.y - side.y * from.x + slack, side.x * d.y - side.y * d.x);
    }
    const double above = ray.origin.z - static_cast<double>(e.height.low_m);
    const double below = static_cast<double>(e.height.high_m) - ray.origin.z;
    const double slack = kSlack * (std::abs(above) + std::abs(below));
    span.cut(above + slack, ray.along.z);
    span.cut(below + slack, -ray.along.z);
    return span;
  }

  void visit(const Envelope& e) {
    if (e.is_leaf()) return test(e.first_leaf);
    const std::array<Envelope, 2> half = halves_of(surface.envelopes, e);
    visit_nearer_first(half);
  }

  void visit_nearer_first(const std::array<Envelope, 2>& pair) {
    const std::array<Span, 2> span = {span_in(pair[0]), span_in(pair[1])};
    hit.visited += 2;
    const std::size_t first = span[1].begin_m < span[0].begin_m ? 1 : 0;
    for (const std::size_t i : {first, 1 - first})
      if (!span[i].is_empty() && is_near(span[i].begin_m)) visit(pair[i]);
  }

  bool is_near(double begin_m) const {
    return hit.triangle == kNoTriangle || begin_m <= hit.distance_m * (1.0 + kSlack);
  }

  void test(int triangle) {
    const auto crossing = cross_triangle(ray, corners_of(surface, triangle));
    if (!crossing) return;
    const double distance_m = crossing->s;
    const bool is_first = hit.triangle == kNoTriangle || distance_m < hit.distance_m ||
                          (distance_m == hit.distance_m && triangle < hit.triangle);
    if (distance_m < 0.0 || distance_m > max_m || !is_first) return;
    hit = {triangle, distance_m, crossing->weight, hit.visited};
  }
};

RaySearch make_search(const HeightMesh& surface, glm::dvec3 origin_world, glm::dvec3 direction,
                      double max_distance_m) {
  check_heights(surface);
  const double length = glm::length(direction);
  SWELL_CHECK(std::isfinite(length) && length > 0.0, "direction=({}, {}, {})", direction.x,
              direction.y, direction.z);
  SWELL_CHECK(std::isfinite(origin_world.x + origin_world.y + origin_world.z),
              "origin=({}, {}, {})", origin_world.x, origin_world.y, origin_world.z);
  SWELL_CHECK(max_distance_m >= 0.0, "max_distance_m={}", max_distance_m);
  return {surface, surface.domain.step_m(), make_ray(origin_world, direction / length),
          std::min(max_distance_m, std::numeric_limits<double>::max())};
}

}  // namespace

RayHit intersect_ray(const HeightMesh& surface, glm::dvec3 origin_world, glm::dvec3 direction,
                     double max_distance_m) {
  RaySearch search = make_search(surface, origin_world, direction, max_distance_m);
  search.visit_nearer_first(roots_of(surface.envelopes, surface.domain.lattice_bits));
  return search.hit;
}

RayHit intersect_ray_in_all(const HeightMesh& surface, glm::dvec3 origin_world,
                            glm::dvec3 direction, double max_distance_m) {
  RaySearch search = make_search(surface, origin_world, direction, max_distance_m);
  for (std::size_t t = 0; t < surface.mesh.level.size(); ++t) search.test(static_cast<int>(t));
  return search.hit;
}

}  // namespace swell::lod
