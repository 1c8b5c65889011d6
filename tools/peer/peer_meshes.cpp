#include "tools/peer/peer_meshes.h"

#include <numeric>
#include <vector>

namespace swell::apps {

PeerMesh::PeerMesh(const Gl& gl) : gl_(gl) {
  gl.GenVertexArrays(1, &array_);
  gl.GenBuffers(1, &indices_);
  gl.GenBuffers(static_cast<GLsizei>(attributes_.size()), attributes_.data());
}

void PeerMesh::begin() {
  gl_.BindVertexArray(array_);
  attribute_count_ = 0;
}

void PeerMesh::add_attribute(int components, const void* data, std::size_t vertices) {
  const auto place = static_cast<GLuint>(attribute_count_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, attributes_[attribute_count_++]);
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices * sizeof(float)) * components,
                 data, GL_STREAM_DRAW);
  gl_.VertexAttribPointer(place, components, GL_FLOAT, GL_FALSE, 0, nullptr);
  gl_.EnableVertexAttribArray(place);
}

void PeerMesh::set_indices(const void* data, std::size_t count) {
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(count * sizeof(std::uint32_t)),
                 data, GL_STREAM_DRAW);
  index_count_ = static_cast<GLsizei>(count);
}

void PeerMesh::take(const render::Surface& surface) {
  begin();
  add_attribute(2, surface.offset.data(), surface.offset.size());
  add_attribute(1, surface.height_m.data(), surface.height_m.size());
  set_indices(surface.mesh.indices.data(), surface.mesh.indices.size());
}

// The peer draws no pictures on meshes: each is its mean colour.
static glm::vec3 mean_of_texture(const shapes::ObjectTriangle& triangle,
                                 const shapes::ObjectMesh& mesh) {
  if (mesh.textured.empty()) return glm::vec3(1.0f);
  const auto number = static_cast<std::size_t>(&triangle - mesh.triangles.data());
  const std::int32_t texture = mesh.textured[number].texture;
  if (texture < 0) return glm::vec3(1.0f);
  return texture::sample((*mesh.textures)[static_cast<std::size_t>(texture)], 0.5f, 0.5f, 1e9f);
}

void PeerMesh::take(const render::ObjectDraws& objects) {
  const std::size_t corners = objects.indices.size();
  std::vector<glm::vec3> place, normal, albedo;
  std::vector<glm::vec3> finish;
  std::vector<float> waterline_rel_m;
  for (std::size_t i = 0; i < corners; ++i) {
    const std::uint32_t vertex = objects.indices[i];
    const shapes::ObjectTriangle& triangle = *objects.primitives[i / 3].triangle;
    const render::ObjectInstance& object = *objects.primitives[i / 3].object;
    const glm::vec3 p = objects.p_rel[vertex], q = p - object.bottom_rel;
    // To the mesh's coordinates, the normal there, and back.
    const glm::vec3 n = triangle.normal_at_origin +
                        triangle.normal_along_x * glm::dot(q, object.right) +
                        triangle.normal_along_y * glm::dot(q, object.ahead) +
                        triangle.normal_along_z * glm::dot(q, object.up);
    place.push_back(p);
    normal.push_back(n.x * object.right + n.y * object.ahead + n.z * object.up);
    albedo.push_back((triangle.painted ? triangle.tint * object.colour : triangle.tint) *
                     mean_of_texture(triangle, *object.mesh));
    const glm::vec2 own(triangle.roughness, triangle.metalness);
    const glm::vec2 its = triangle.painted ? glm::vec2(object.roughness, object.metalness) : own;
    finish.emplace_back(its, triangle.translucency);
    waterline_rel_m.push_back(objects.waterline_rel_m[vertex]);
  }
  std::vector<std::uint32_t> indices(corners);
  std::iota(indices.begin(), indices.end(), 0u);
  begin();
  add_attribute(3, place.data(), corners);
  add_attribute(1, waterline_rel_m.data(), corners);
  add_attribute(3, normal.data(), corners);
  add_attribute(3, albedo.data(), corners);
  add_attribute(3, finish.data(), corners);
  set_indices(indices.data(), corners);
}

void PeerMesh::draw() const {
  gl_.BindVertexArray(array_);
  gl_.DrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
}

}  // namespace swell::apps
