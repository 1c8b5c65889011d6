// Where a ray passes through a triangle.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

namespace swell {

struct Ray {
  glm::dvec3 origin, along;  // along: of any length over 0
  int main_axis;             // that it runs along most
};

inline Ray make_ray(glm::dvec3 origin, glm::dvec3 along) {
  const glm::dvec3 size = glm::abs(along);
  const int main_axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  return {origin, along, main_axis};
}

// At origin + s along: the sum of weight[k] times corner k. The weights are in [0, 1] and add up
// to 1.
struct RayCrossing {
  double s;
  glm::dvec3 weight;
};

// Where the line of the ray, which goes on behind its origin, passes through the triangle, from
// either side. No ray slips between two triangles with a side in common. A ray in the very plane of
// a triangle passes by it.
//
// Along the ray, as seen from its end: corners move to (x, y), the ray stands at (0, 0). It passes
// inside if the areas it spans with the sides have one sign. Each is a difference of two products,
// whose sign rounding may take away but not turn.
// Source: Woop, Benthin, Wald, Watertight Ray/Triangle Intersection, 2013.
inline std::optional<RayCrossing> cross_triangle(const Ray& ray,
                                                 const std::array<glm::dvec3, 3>& corner) {
  const int z = ray.main_axis, x = (z + 1) % 3, y = (z + 2) % 3;
  std::array<glm::dvec2, 3> p;
  glm::dvec3 s;
  for (int k = 0; k < 3; ++k) {
    const glm::dvec3 from = corner[static_cast<std::size_t>(k)] - ray.origin;
    s[k] = from[z] / ray.along[z];
    p[static_cast<std::size_t>(k)] = {from[x] - ray.along[x] * s[k], from[y] - ray.along[y] * s[k]};
  }
  const auto area_of = [](glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; };
  const glm::dvec3 area(area_of(p[1], p[2]), area_of(p[2], p[0]), area_of(p[0], p[1]));
  const bool is_inside = (area.x >= 0.0 && area.y >= 0.0 && area.z >= 0.0) ||
                         (area.x <= 0.0 && area.y <= 0.0 && area.z <= 0.0);
  const double sum = area.x + area.y + area.z;
  if (!is_inside || sum == 0.0) return std::nullopt;
  const glm::dvec3 weight = area / sum;
  return RayCrossing{glm::dot(weight, s), weight};
}

}  // namespace swell
