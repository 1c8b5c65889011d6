// The shapes of floating objects as triangles.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/objects.h"

namespace swell::scene {

// What a shader needs of a triangle. Across a triangle a smooth normal, interpolated between its
// corners, is an affine function of the position (x, y, z):
// at_origin + x along_x + y along_y + z along_z, not of unit length.
struct ObjectTriangle {
  glm::vec3 normal_at_origin{0.0f};
  glm::vec3 normal_along_x{0.0f}, normal_along_y{0.0f}, normal_along_z{0.0f};
  glm::vec3 tint{1.0f};  // linear RGB reflectance, times the object's colour if painted
  bool painted = true;
};

// In a box of size 1: x (right) and y (ahead) in [-1/2, 1/2], z (up) in [0, 1].
struct ObjectMesh {
  std::vector<glm::vec3> position;
  std::vector<std::uint32_t> indices;     // 3 per triangle
  std::vector<ObjectTriangle> triangles;  // one per triangle
};

inline constexpr int kMaxObjectTriangles = 2048;

// Surfaces without a hole to see, outside out. Round parts have `segments` sides, in [4, 32].
ObjectMesh make_object_mesh(ObjectKind kind, TopMark top_mark, int segments);

}  // namespace swell::scene
