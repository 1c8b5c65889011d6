// The shapes of objects as triangles.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "scene/objects.h"
#include "texture/mip_image.h"

namespace swell::shapes {

// What a shader needs of a triangle. Across a triangle a smooth normal, interpolated between its
// corners, is an affine function of the position (x, y, z):
// at_origin + x along_x + y along_y + z along_z, not of unit length.
struct ObjectTriangle {
  glm::vec3 normal_at_origin{0.0f};
  glm::vec3 normal_along_x{0.0f}, normal_along_y{0.0f}, normal_along_z{0.0f};
  glm::vec3 flat_normal{0.0f};  // of the triangle itself, on the side that the others point to
  glm::vec3 tint{1.0f};         // linear RGB reflectance, times the object's colour if painted
  float roughness = 0.42f, metalness = 0.0f;  // the object's if painted
  float translucency = 0.0f;                  // part of the light on its back that it lets through
  bool painted = true;
};

// What lies on a textured triangle: its coordinates are affine functions of the position as the
// normal is, (at_origin, along_x, along_y, along_z).
struct TriangleTexture {
  glm::vec4 u{0.0f}, v{0.0f};
  std::int32_t texture = -1;          // of the mesh; -1: none
  float log2_texels_per_unit = 0.0f;  // of the box, along the triangle
};

// Triangles of a mesh whose outline stands before the sun by itself, and where they cut the water.
struct MeshPart {
  std::uint32_t first_triangle = 0, triangles = 0;
  // The plan at the waterline: its middle and half its sizes, right and ahead; 0: it has none.
  glm::vec2 middle{0.0f}, half{0.0f};
  bool is_round = true;
  float top = 1.0f;  // of what hides the sky from the water around
};

// In a box of size 1: x (right) and y (ahead) in [-1/2, 1/2], z (up) in [0, 1].
struct ObjectMesh {
  std::vector<glm::vec3> position;
  std::vector<std::uint32_t> indices;     // 3 per triangle
  std::vector<ObjectTriangle> triangles;  // one per triangle
  std::vector<TriangleTexture> textured;  // the same, or empty
  std::shared_ptr<const std::vector<texture::MipImage>> textures;
  std::vector<MeshPart> parts;  // empty: it is one part
  // How far its outline lies from that of the finest level at most, in parts of the largest side.
  float error = 0.0f;
};

// The segments of the levels of what is built in, finest first.
inline constexpr std::array<int, 3> kLevelSegments = {24, 8, 4};

// Surfaces without a hole to see, outside out; sails are seen from both sides. Round parts have
// `segments` sides, in [4, 32]; the error is that against 24 of them. At most 2048 triangles. Not
// of kMesh or kImplicit (shapes/mesh_file.h).
ObjectMesh make_object_mesh(scene::ObjectKind kind, scene::TopMark top_mark, int segments);

// Gives a part whose triangles are known the plan that they have at a height, if they pass it.
void set_waterline(const ObjectMesh& mesh, float z, MeshPart& part);

// The parts of the mesh that the object has, with their waterlines at its draught.
std::vector<MeshPart> mesh_parts(const scene::FloatingObject& object, const ObjectMesh& mesh);

}  // namespace swell::shapes
