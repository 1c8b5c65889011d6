// What a mesh covers, seen from far away: an oracle of its own for levels of detail.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "shapes/object_mesh.h"

namespace swell {

// Square pictures of `side` points; the mesh's largest side takes 1 / 1.8 of it.
struct Outlines {
  int side;
  glm::dvec3 size_m;  // of the mesh's box

  double largest_m() const { return std::max({size_m.x, size_m.y, size_m.z}); }
  double points_per_m() const { return side / (1.8 * largest_m()); }

  // Which points see the mesh along a direction: those that it covers, or all that it comes nearer
  // than `reach` along the axes (0.5: a needle between points is seen, too).
  std::vector<char> covered(const shapes::ObjectMesh& mesh, glm::dvec3 along, double reach) const {
    const glm::dvec3 right = glm::normalize(
        glm::cross(along, std::abs(along.z) > 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1)));
    const glm::dvec3 up = glm::cross(right, along);
    std::vector<char> points(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      std::array<glm::dvec2, 3> corner;
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 q(mesh.position[mesh.indices[i + k]]);
        const glm::dvec3 p = (q - glm::dvec3(0.0, 0.0, 0.5)) * size_m;
        corner[k] = 0.5 * side + points_per_m() * glm::dvec2(glm::dot(p, right), glm::dot(p, up));
      }
      cover(corner, reach, points);
    }
    return points;
  }

  // The largest distance, in parts of the mesh's largest side, of a point of `a` from those of `b`.
  double farthest(const std::vector<char>& a, const std::vector<char>& b) const {
    double worst = 0.0;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        if (a[at(x, y)] && !b[at(x, y)]) worst = std::max(worst, nearest(b, x, y, worst));
    return worst / (points_per_m() * largest_m());
  }

 private:
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
           static_cast<std::size_t>(x);
  }

  void cover(const std::array<glm::dvec2, 3>& corner, double reach,
             std::vector<char>& points) const {
    const auto edge = [](glm::dvec2 a, glm::dvec2 b, glm::dvec2 p) {
      return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    };
    const double area = edge(corner[0], corner[1], corner[2]);
    glm::dvec2 low = corner[0], high = corner[0];
    for (const glm::dvec2& c : corner) low = glm::min(low, c), high = glm::max(high, c);
    for (int y = static_cast<int>(low.y); y <= static_cast<int>(high.y); ++y)
      for (int x = static_cast<int>(low.x); x <= static_cast<int>(high.x); ++x) {
        const glm::dvec2 p(x + 0.5, y + 0.5);
        bool inside = area != 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
          const glm::dvec2 &a = corner[k], &b = corner[(k + 1) % 3];
          const double margin = reach * (std::abs(b.x - a.x) + std::abs(b.y - a.y));
          inside &= edge(a, b, p) * (area > 0.0 ? 1.0 : -1.0) >= -margin;
        }
        if (inside) points[at(x, y)] = 1;
      }
  }

  // In rings around a point, until one is found; `least`: no ring nearer than this matters.
  double nearest(const std::vector<char>& points, int x, int y, double least) const {
    double found = 2.0 * side;
    for (int ring = 1; ring < side && ring <= found; ++ring)
      for (int i = -ring; i <= ring; ++i)
        for (const auto& [u, v] : {std::array{x + i, y - ring}, std::array{x + i, y + ring},
                                   std::array{x - ring, y + i}, std::array{x + ring, y + i}})
          if (u >= 0 && v >= 0 && u < side && v < side && points[at(u, v)]) {
            found = std::min(found, std::hypot(u - x, v - y));
            if (found <= least) return found;
          }
    return found;
  }
};

// How far the outlines of two meshes lie from each other at most, from all around, in parts of the
// largest side; right to two points of the pictures.
inline double outline_distance(const shapes::ObjectMesh& a, const shapes::ObjectMesh& b,
                               const Outlines& outlines, int directions) {
  double worst = 0.0;
  for (int i = 0; i < directions; ++i) {
    // Evenly around, from level to 60 degrees up.
    const double turn = 2.4 * i, z = 0.86 * i / directions, level = std::sqrt(1.0 - z * z);
    const glm::dvec3 along(level * std::cos(turn), level * std::sin(turn), -z);
    const auto distance = [&](const shapes::ObjectMesh& from, const shapes::ObjectMesh& to) {
      return outlines.farthest(outlines.covered(from, along, 0.0),
                               outlines.covered(to, along, 0.5));
    };
    worst = std::max({worst, distance(a, b), distance(b, a)});
  }
  return worst;
}

}  // namespace swell
