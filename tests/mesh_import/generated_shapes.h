// Shapes of polygons, by a number.
#pragma once

#include <algorithm>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "math/elementary.h"

namespace swell {

// Faces of flat convex polygons, against the clock from outside.
struct PolygonShape {
  std::vector<glm::vec3> points;
  std::vector<std::vector<std::size_t>> faces;
};

// Rows of `columns` points that close around; open at its ends.
inline void add_rings(int rows, int columns, PolygonShape& shape) {
  const auto at = [&](int i, int j) { return static_cast<std::size_t>(i * columns + j % columns); };
  for (int i = 0; i + 1 < rows; ++i)
    for (int j = 0; j < columns; ++j)
      shape.faces.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
}

// Two polygons and quadrangles between them.
inline PolygonShape prism(int sides, float height) {
  PolygonShape shape;
  for (const float z : {0.0f, height})
    for (int i = 0; i < sides; ++i) {
      const SinCos a = sin_cos_turns(static_cast<double>(i) / sides);
      shape.points.emplace_back(a.cos, a.sin, z);
    }
  add_rings(2, sides, shape);
  std::vector<std::size_t> low, high;
  for (std::size_t i = 0; i < static_cast<std::size_t>(sides); ++i) {
    low.push_back(static_cast<std::size_t>(sides) - 1 - i);
    high.push_back(static_cast<std::size_t>(sides) + i);
  }
  shape.faces.push_back(low);
  shape.faces.push_back(high);
  return shape;
}

inline PolygonShape pyramid(int sides) {
  PolygonShape shape;
  shape.points.emplace_back(0.0f, 0.0f, 2.0f);
  std::vector<std::size_t> floor;
  for (int i = 0; i < sides; ++i) {
    const SinCos a = sin_cos_turns(static_cast<double>(i) / sides);
    shape.points.emplace_back(a.cos, a.sin, -1.0f);
    const auto k = static_cast<std::size_t>(i);
    shape.faces.push_back({0, 1 + k, 1 + (k + 1) % static_cast<std::size_t>(sides)});
    floor.insert(floor.begin(), 1 + k);
  }
  shape.faces.push_back(floor);
  return shape;
}

// A ring of triangles, as its quadrangles would not be flat.
inline PolygonShape torus(int around, int across) {
  PolygonShape shape;
  for (int i = 0; i <= around; ++i)
    for (int j = 0; j < across; ++j) {
      const SinCos a = sin_cos_turns(static_cast<double>(i % around) / around);
      const SinCos b = sin_cos_turns(static_cast<double>(j) / across);
      const double r = 3.0 + b.cos;
      shape.points.emplace_back(r * a.cos, r * a.sin, b.sin);
    }
  PolygonShape quadrangles;
  add_rings(around + 1, across, quadrangles);
  for (const auto& q : quadrangles.faces) {
    shape.faces.push_back({q[0], q[2], q[1]});
    shape.faces.push_back({q[0], q[3], q[2]});
  }
  return shape;
}

// A sheet without a back.
inline PolygonShape sheet(int side) {
  PolygonShape shape;
  const auto n = static_cast<std::size_t>(side);
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t j = 0; j <= n; ++j)
      shape.points.emplace_back(static_cast<float>(j), static_cast<float>(i),
                                0.25f * static_cast<float>(i));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      shape.faces.push_back(
          {i * (n + 1) + j, i * (n + 1) + j + 1, (i + 1) * (n + 1) + j + 1, (i + 1) * (n + 1) + j});
  return shape;
}

inline PolygonShape shape_number(int n) {
  PolygonShape shape;
  switch (n % 5) {
    case 0:
      shape = prism(3 + n / 5, 1.5f);
      break;
    case 1:
      shape = torus(8 + n, 5 + n / 4);
      break;
    case 2:
      shape = pyramid(3 + n / 3);
      break;
    case 3:
      shape = sheet(1 + n / 4);
      break;
    default:
      shape = prism(4, 0.1f * static_cast<float>(1 + n));
      break;
  }
  const glm::vec3 stretch(1.0f + 0.25f * static_cast<float>(n % 3), 1.0f, 1.0f);
  const glm::vec3 shift(0.5f * static_cast<float>(n % 4), -1.0f, 0.25f * static_cast<float>(n % 7));
  for (glm::vec3& p : shape.points) p = p * stretch + shift;
  return shape;
}

// Each face as a fan.
inline std::vector<std::size_t> fans_of(const PolygonShape& shape) {
  std::vector<std::size_t> corners;
  for (const auto& face : shape.faces)
    for (std::size_t k = 2; k < face.size(); ++k)
      corners.insert(corners.end(), {face[0], face[k - 1], face[k]});
  return corners;
}

}  // namespace swell
