// What the shapes of objects are put together from: strips around an axis, boxes, balls, sheets.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <initializer_list>
#include <span>

#include "shapes/object_mesh.h"

namespace swell::shapes {

// What a triangle's surface is like.
struct Paint {
  glm::vec3 tint{1.0f};
  bool painted = true;
  float roughness = 0.42f, metalness = 0.0f;
  float translucency = 0.0f;
};

using Corners = std::array<glm::vec3, 3>;

// A mesh that grows. What is added is given in lengths of any unit, from `origin`; the box of the
// finished mesh has the size `size` in that unit.
struct MeshBuilder {
  int segments = 8;  // of round parts
  glm::vec3 size{1.0f};
  glm::vec3 origin{0.0f};
  ObjectMesh mesh{};
};

// The triangle of corners q of the mesh's box with these normals there.
ObjectTriangle make_triangle(const Corners& q, const Corners& normal, const Paint& paint);

// A strip between two circles around the z axis, from (radius, z) up along the outside; normals
// (radial, up) at its ends.
struct Strip {
  glm::vec2 low, high;
  glm::vec2 normal_low, normal_high;
  Paint paint;
};
void add_strip(const Strip& strip, MeshBuilder& to);

// A chain of cones through points (radius, z), from the bottom up.
void add_turned(std::span<const glm::vec2> profile, const Paint& paint, MeshBuilder& to);
void add_turned(std::initializer_list<glm::vec2> profile, const Paint& paint, MeshBuilder& to);

// An ellipsoid of revolution.
void add_ball(float radius, float z_low, float z_high, const Paint& paint, MeshBuilder& to);

void add_box(glm::vec3 low, glm::vec3 high, const Paint& paint, MeshBuilder& to);

// A sheet through rows of `columns` points, smooth inside. Its front is where rows run up and
// columns to the right.
void add_sheet(std::span<const glm::vec3> points, int columns, const Paint& paint, MeshBuilder& to);

// A flat convex piece, its corners against the clock as seen from its front.
void add_polygon(std::span<const glm::vec3> corners, const Paint& paint, MeshBuilder& to);

// Makes what was added since the part before one part, which has this waterline (or none).
void end_part(const MeshPart& waterline, MeshBuilder& to);

}  // namespace swell::shapes
