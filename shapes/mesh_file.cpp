#include "shapes/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "math/elementary.h"
#include "shapes/flat_mesh.h"
#include "shapes/mesh_builder.h"
#include "shapes/run_importer.h"

namespace swell::shapes {
namespace {

constexpr double kThinnest = 1e-3;  // of the largest of its sizes a box is at least as wide
constexpr double kSmallest_m = 0.05, kLargest_m = 2000.0;

glm::dvec3 place(const FlatVertex& v) { return {v.position[0], v.position[1], v.position[2]}; }

void set_box(const FlatMesh& flat, MeshOfFile& mesh) {
  mesh.low = glm::dvec3(1e30), mesh.high = glm::dvec3(-1e30);
  for (const std::uint32_t index : flat.levels[0].indices) {
    mesh.low = glm::min(mesh.low, place(flat.vertices[index]));
    mesh.high = glm::max(mesh.high, place(flat.vertices[index]));
  }
  const glm::dvec3 size = mesh.high - mesh.low;
  const double least = kThinnest * std::max({size.x, size.y, size.z});
  const glm::dvec3 more = 0.5 * glm::max(glm::dvec3(least) - size, glm::dvec3(0.0));
  mesh.low -= more, mesh.high += more;
}

// An affine function of the position that has these values at the corners: what it is at the
// origin, and along x, y and z.
glm::dvec4 plane_through(const std::array<glm::dvec3, 3>& q, const glm::dvec3& value) {
  const glm::dvec3 e1 = q[1] - q[0], e2 = q[2] - q[0], across = glm::cross(e1, e2);
  const double area2 = glm::dot(across, across);
  if (!(area2 > 0.0)) return {value[0], 0.0, 0.0, 0.0};
  const glm::dvec3 along = ((value[1] - value[0]) * glm::cross(e2, across) +
                            (value[2] - value[0]) * glm::cross(across, e1)) /
                           area2;
  return {value[0] - glm::dot(along, q[0]), along};
}

// What is put together of three corners.
struct Triangle {
  std::array<glm::dvec3, 3> q;       // in the mesh's box
  std::array<glm::dvec3, 3> normal;  // there
  std::array<glm::dvec2, 3> uv;
};

Triangle triangle_of(const FlatMesh& flat, const MeshOfFile& mesh, const std::uint32_t* vertex) {
  const glm::dvec3 size = mesh.high - mesh.low, middle = 0.5 * (mesh.low + mesh.high);
  Triangle t;
  for (std::size_t k = 0; k < 3; ++k) {
    const FlatVertex& v = flat.vertices[vertex[k]];
    t.q[k] = (place(v) - glm::dvec3(middle.x, middle.y, mesh.low.z)) / size;
    const glm::dvec3 n = glm::dvec3(v.normal[0], v.normal[1], v.normal[2]) * size;
    t.normal[k] = n / std::max(glm::length(n), 1e-30);
    t.uv[k] = {v.uv[0], v.uv[1]};
  }
  return t;
}

ObjectTriangle shading_of(const Triangle& t, const FlatMaterial& material) {
  ObjectTriangle result;
  const glm::dvec3 across = glm::cross(t.q[1] - t.q[0], t.q[2] - t.q[0]);
  const double length = glm::length(across);
  const bool turned = glm::dot(across, t.normal[0] + t.normal[1] + t.normal[2]) < 0.0;
  result.flat_normal = glm::vec3((turned ? -across : across) / std::max(length, 1e-30));
  for (int c = 0; c < 3; ++c) {
    const glm::dvec4 plane = plane_through(t.q, {t.normal[0][c], t.normal[1][c], t.normal[2][c]});
    result.normal_at_origin[c] = static_cast<float>(plane[0]);
    result.normal_along_x[c] = static_cast<float>(plane[1]);
    result.normal_along_y[c] = static_cast<float>(plane[2]);
    result.normal_along_z[c] = static_cast<float>(plane[3]);
  }
  // A sliver's slopes are more than floats hold apart: it is flat.
  const auto steep = [](glm::vec3 v) { return !(glm::dot(v, v) < 1e8f); };
  if (steep(result.normal_along_x) || steep(result.normal_along_y) ||
      steep(result.normal_along_z)) {
    result.normal_at_origin = result.flat_normal;
    result.normal_along_x = result.normal_along_y = result.normal_along_z = glm::vec3(0.0f);
  }
  result.painted = material.painted != 0;
  result.tint = result.painted
                    ? glm::vec3(1.0f)
                    : glm::vec3(material.colour[0], material.colour[1], material.colour[2]);
  result.roughness = material.roughness;
  result.metalness = material.metalness;
  return result;
}

double area_of(glm::dvec2 a, glm::dvec2 b) { return 0.5 * std::abs(a.x * b.y - a.y * b.x); }

// Shares of the picture and of the box are compared by their areas.
TriangleTexture texture_of(const Triangle& t, const FlatMaterial& material,
                           const std::vector<FlatTexture>& textures) {
  TriangleTexture result;
  if (material.texture < 0) return result;
  const FlatTexture& texture = textures[static_cast<std::size_t>(material.texture)];
  const double texels =
      area_of(t.uv[1] - t.uv[0], t.uv[2] - t.uv[0]) * texture.width * texture.height;
  const double units = 0.5 * glm::length(glm::cross(t.q[1] - t.q[0], t.q[2] - t.q[0]));
  result.log2_texels_per_unit =
      static_cast<float>(0.5 * log(std::max(texels, 1e-12) / std::max(units, 1e-12)) / log(2.0));
  result.texture = material.texture;
  result.u = glm::vec4(plane_through(t.q, {t.uv[0].x, t.uv[1].x, t.uv[2].x}));
  result.v = glm::vec4(plane_through(t.q, {t.uv[0].y, t.uv[1].y, t.uv[2].y}));
  for (const glm::vec4& plane : {result.u, result.v})
    if (!(glm::dot(plane, plane) < 1e16f)) result.texture = -1;
  return result;
}

ObjectMesh mesh_of_level(const FlatMesh& flat, const MeshOfFile& whole, const FlatLevel& level) {
  constexpr std::uint32_t kNone = ~0u;
  ObjectMesh mesh;
  mesh.error = level.error;
  std::vector<std::uint32_t> number(flat.vertices.size(), kNone);
  const bool is_textured = !flat.textures.empty();
  mesh.triangles.reserve(level.material.size());
  for (std::size_t i = 0; i < level.material.size(); ++i) {
    const std::uint32_t* const vertex = &level.indices[3 * i];
    const Triangle t = triangle_of(flat, whole, vertex);
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t& n = number[vertex[k]];
      if (n == kNone) {
        n = static_cast<std::uint32_t>(mesh.position.size());
        mesh.position.push_back(glm::vec3(t.q[k]));
      }
      mesh.indices.push_back(n);
    }
    const FlatMaterial& material = flat.materials[level.material[i]];
    mesh.triangles.push_back(shading_of(t, material));
    if (is_textured) mesh.textured.push_back(texture_of(t, material, flat.textures));
  }
  return mesh;
}

}  // namespace

MeshOfFile load_mesh(const std::string& file, scene::UpAxis up) {
  return mesh_of(read_flat_mesh(run_importer(file, up)));
}

MeshOfFile mesh_of(const FlatMesh& flat) {
  MeshOfFile mesh;
  set_box(flat, mesh);
  std::vector<texture::MipImage> textures;
  for (const FlatTexture& t : flat.textures)
    textures.push_back(
        texture::make_mip_image(static_cast<int>(t.width), static_cast<int>(t.height), t.texels));
  const auto shared = std::make_shared<const std::vector<texture::MipImage>>(std::move(textures));
  for (const FlatLevel& level : flat.levels) {
    mesh.levels.push_back(mesh_of_level(flat, mesh, level));
    mesh.levels.back().textures = shared;
  }
  return mesh;
}

void fit_object(const MeshOfFile& mesh, scene::FloatingObject& object) {
  const glm::dvec3 size_m = object.scale * (mesh.high - mesh.low);
  const double largest_m = std::max({size_m.x, size_m.y, size_m.z});
  if (!(largest_m >= kSmallest_m && largest_m <= kLargest_m))
    throw std::runtime_error(
        fmt::format("a shape of {:.3g} x {:.3g} x {:.3g} m, allowed {} to {} m at the scale {}",
                    size_m.x, size_m.y, size_m.z, kSmallest_m, kLargest_m, object.scale));
  object.size_m = size_m;
  object.middle_m = glm::dvec2(0.0);
  if (!object.at_file_origin) return;
  object.middle_m = object.scale * 0.5 * glm::dvec2(mesh.low + mesh.high);
  object.draught = -object.scale * mesh.low.z / size_m.z;
}

}  // namespace swell::shapes
