#include "shapes/mesh_builder.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/elementary.h"

namespace swell::shapes {
namespace {

std::uint32_t add_vertex(glm::vec3 p, MeshBuilder& to) {
  to.mesh.position.push_back((p + to.origin) / to.size);
  return static_cast<std::uint32_t>(to.mesh.position.size() - 1);
}

// Normals are given as the points are; in the box they lie across what has become of its planes.
void add_triangle(const std::array<std::uint32_t, 3>& vertex, const Corners& normal,
                  const Paint& paint, MeshBuilder& to) {
  ObjectMesh& mesh = to.mesh;
  const Corners q = {mesh.position[vertex[0]], mesh.position[vertex[1]], mesh.position[vertex[2]]};
  const auto in_box = [&](glm::vec3 n) {
    const glm::vec3 turned = n * to.size;
    return to.size == glm::vec3(1.0f) ? turned : turned / std::sqrt(glm::dot(turned, turned));
  };
  mesh.indices.insert(mesh.indices.end(), vertex.begin(), vertex.end());
  mesh.triangles.push_back(
      make_triangle(q, {in_box(normal[0]), in_box(normal[1]), in_box(normal[2])}, paint));
}

// A strip with one normal along its slope.
void add_cone(glm::vec2 low, glm::vec2 high, const Paint& paint, MeshBuilder& to) {
  const glm::vec2 along = high - low;
  const glm::vec2 normal = glm::vec2(along.y, -along.x) / std::sqrt(glm::dot(along, along));
  add_strip({low, high, normal, normal, paint}, to);
}

glm::vec3 unit(glm::vec3 v) {
  const float length = std::sqrt(glm::dot(v, v));
  return length > 0.0f ? v / length : glm::vec3(0.0f, 0.0f, 1.0f);
}

}  // namespace

// The interpolated normal m0 + b1 (m1 - m0) + b2 (m2 - m0), whose weights b are products of q - q0
// with the dual basis of the triangle's edges.
ObjectTriangle make_triangle(const Corners& q, const Corners& normal, const Paint& paint) {
  const glm::vec3 e1 = q[1] - q[0], e2 = q[2] - q[0];
  const glm::vec3 across = glm::cross(e1, e2);
  const float area2 = glm::dot(across, across);
  ObjectTriangle triangle;
  triangle.tint = paint.tint;
  triangle.painted = paint.painted;
  triangle.roughness = paint.roughness;
  triangle.metalness = paint.metalness;
  triangle.translucency = paint.translucency;
  triangle.flat_normal =
      glm::dot(across, normal[0] + normal[1] + normal[2]) < 0.0f ? -across : across;
  const glm::vec3 dual1 = glm::cross(e2, across) / area2, dual2 = glm::cross(across, e1) / area2;
  const glm::vec3 rise1 = normal[1] - normal[0], rise2 = normal[2] - normal[0];
  triangle.normal_along_x = rise1 * dual1.x + rise2 * dual2.x;
  triangle.normal_along_y = rise1 * dual1.y + rise2 * dual2.y;
  triangle.normal_along_z = rise1 * dual1.z + rise2 * dual2.z;
  triangle.normal_at_origin = normal[0] - q[0].x * triangle.normal_along_x -
                              q[0].y * triangle.normal_along_y - q[0].z * triangle.normal_along_z;
  return triangle;
}

void add_strip(const Strip& strip, MeshBuilder& to) {
  const auto first = static_cast<std::uint32_t>(to.mesh.position.size());
  std::vector<glm::vec2> around;
  for (int i = 0; i < to.segments; ++i) {
    const SinCos angle = sin_cos_turns(static_cast<double>(i) / to.segments);
    around.emplace_back(static_cast<float>(angle.cos), static_cast<float>(angle.sin));
  }
  for (const glm::vec2& end : {strip.low, strip.high})
    for (const glm::vec2& a : around) add_vertex(glm::vec3(end.x * a, end.y), to);
  const auto n = static_cast<std::uint32_t>(to.segments);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    const auto normal = [&](glm::vec2 rise, std::uint32_t k) {
      return glm::vec3(rise.x * around[k], rise.y);
    };
    const glm::vec3 a = normal(strip.normal_low, i), b = normal(strip.normal_low, j);
    const glm::vec3 c = normal(strip.normal_high, j), d = normal(strip.normal_high, i);
    // A circle of radius 0 is a point: one of the two triangles has no area.
    if (strip.low.x > 0.0f)
      add_triangle({first + i, first + j, first + n + j}, {a, b, c}, strip.paint, to);
    if (strip.high.x > 0.0f)
      add_triangle({first + i, first + n + j, first + n + i}, {a, c, d}, strip.paint, to);
  }
}

void add_turned(std::span<const glm::vec2> profile, const Paint& paint, MeshBuilder& to) {
  for (std::size_t i = 0; i + 1 < profile.size(); ++i)
    add_cone(profile[i], profile[i + 1], paint, to);
}

void add_turned(std::initializer_list<glm::vec2> profile, const Paint& paint, MeshBuilder& to) {
  add_turned(std::span(profile.begin(), profile.size()), paint, to);
}

void add_ball(float radius, float z_low, float z_high, const Paint& paint, MeshBuilder& to) {
  const int rings = std::max(to.segments / 2, 3);
  const auto point = [&](int i) {
    const SinCos angle = sin_cos_turns(0.5 * i / rings);
    const float r = i == 0 || i == rings ? 0.0f : static_cast<float>(angle.sin);
    return glm::vec2(r, -static_cast<float>(angle.cos));
  };
  const float half = 0.5f * (z_high - z_low), middle = 0.5f * (z_high + z_low);
  const auto place = [&](glm::vec2 p) { return glm::vec2(radius * p.x, middle + half * p.y); };
  // Normals of a sphere that is stretched along z.
  const auto normal = [&](glm::vec2 p) {
    const glm::vec2 n(p.x / radius, p.y / half);
    return n / std::sqrt(glm::dot(n, n));
  };
  for (int i = 0; i < rings; ++i)
    add_strip({place(point(i)), place(point(i + 1)), normal(point(i)), normal(point(i + 1)), paint},
              to);
}

void add_box(glm::vec3 low, glm::vec3 high, const Paint& paint, MeshBuilder& to) {
  const glm::vec3 half = 0.5f * (high - low), middle = 0.5f * (high + low);
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      glm::vec3 out(0.0f), u(0.0f), v(0.0f);
      out[axis] = side;
      u[(axis + 1) % 3] = 1.0f;
      v[(axis + 2) % 3] = side;
      const auto first = static_cast<std::uint32_t>(to.mesh.position.size());
      for (const glm::vec2& corner : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
        add_vertex(half * (out + corner.x * u + corner.y * v) + middle, to);
      add_triangle({first, first + 1, first + 2}, {out, out, out}, paint, to);
      add_triangle({first, first + 2, first + 3}, {out, out, out}, paint, to);
    }
  }
}

void add_sheet(std::span<const glm::vec3> points, int columns, const Paint& paint,
               MeshBuilder& to) {
  const int rows = static_cast<int>(points.size()) / columns;
  const auto at = [&](int row, int column) { return points[row * columns + column]; };
  const auto normal = [&](int row, int column) {
    const glm::vec3 up = at(std::min(row + 1, rows - 1), column) - at(std::max(row - 1, 0), column);
    const glm::vec3 right =
        at(row, std::min(column + 1, columns - 1)) - at(row, std::max(column - 1, 0));
    return unit(glm::cross(right, up));
  };
  const auto first = static_cast<std::uint32_t>(to.mesh.position.size());
  for (const glm::vec3& p : points) add_vertex(p, to);
  for (int row = 0; row + 1 < rows; ++row) {
    for (int column = 0; column + 1 < columns; ++column) {
      const auto vertex = [&](int i, int j) {
        return first + static_cast<std::uint32_t>((row + i) * columns + column + j);
      };
      const auto add = [&](std::array<glm::ivec2, 3> corner) {
        const auto p = [&](int k) { return at(row + corner[k].x, column + corner[k].y); };
        const glm::vec3 across = glm::cross(p(1) - p(0), p(2) - p(0));
        if (!(glm::dot(across, across) > 1e-14f)) return;  // at a point where rows meet
        Corners n;
        std::array<std::uint32_t, 3> v;
        for (std::size_t k = 0; k < 3; ++k) {
          n[k] = normal(row + corner[k].x, column + corner[k].y);
          // A fold has two sides: this one takes its own normal.
          if (glm::dot(n[k], across) <= 0.0f) n[k] = unit(across);
          v[k] = vertex(corner[k].x, corner[k].y);
        }
        add_triangle(v, n, paint, to);
      };
      add({glm::ivec2(0, 0), {0, 1}, {1, 1}});
      add({glm::ivec2(0, 0), {1, 1}, {1, 0}});
    }
  }
}

void add_polygon(std::span<const glm::vec3> corners, const Paint& paint, MeshBuilder& to) {
  const auto first = static_cast<std::uint32_t>(to.mesh.position.size());
  for (const glm::vec3& p : corners) add_vertex(p, to);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const glm::vec3 across = glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    if (!(glm::dot(across, across) > 1e-14f)) continue;
    const glm::vec3 n = unit(across);
    const auto v = first + static_cast<std::uint32_t>(i);
    add_triangle({first, v, v + 1}, {n, n, n}, paint, to);
  }
}

void end_part(const MeshPart& waterline, MeshBuilder& to) {
  MeshPart part = waterline;
  if (!to.mesh.parts.empty())
    part.first_triangle = to.mesh.parts.back().first_triangle + to.mesh.parts.back().triangles;
  part.triangles = static_cast<std::uint32_t>(to.mesh.triangles.size()) - part.first_triangle;
  to.mesh.parts.push_back(part);
}

}  // namespace swell::shapes
