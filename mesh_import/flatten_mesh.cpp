#include "mesh_import/flatten_mesh.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "mesh_import/surface_distance.h"

namespace swell::mesh_import {
namespace {

using shapes::FlatLevel;
using shapes::FlatVertex;

constexpr float kCosCrease = 0.76604444f;  // of 40 degrees
// Around a vertex with more triangles than this they are flat: whoever has so many is no surface.
constexpr std::uint32_t kMostAround = 64;

glm::vec3 vec3(const std::array<float, 3>& a) { return {a[0], a[1], a[2]}; }

// Numbers of the places of corners, one for all at the same place; returns how many.
std::size_t number_places(const std::vector<FlatVertex>& corners, std::vector<unsigned>& place) {
  std::vector<std::array<float, 3>> positions;
  positions.reserve(corners.size());
  for (const FlatVertex& c : corners) positions.push_back(c.position);
  place.resize(corners.size());
  return meshopt_generateVertexRemap(place.data(), nullptr, corners.size(), positions.data(),
                                     corners.size(), sizeof positions[0]);
}

// The corners at each place: those of place i are list[first[i]] to list[first[i + 1]].
struct CornersAt {
  std::vector<std::uint32_t> first, list;

  CornersAt(const std::vector<unsigned>& place, std::size_t places)
      : first(places + 1), list(place.size()) {
    for (const unsigned p : place) ++first[p + 1];
    for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::uint32_t i = 0; i < place.size(); ++i) list[next[place[i]]++] = i;
  }
};

// As long as its triangle is large.
glm::vec3 across(const std::vector<FlatVertex>& corners, std::size_t triangle) {
  const glm::vec3 a = vec3(corners[3 * triangle].position);
  return glm::cross(vec3(corners[3 * triangle + 1].position) - a,
                    vec3(corners[3 * triangle + 2].position) - a);
}

bool is_thin(glm::vec3 normal) {
  const float square = glm::dot(normal, normal);
  return !(square > 0.0f) || !std::isfinite(square);
}

}  // namespace

void add_normals(LooseMesh& mesh) {
  if (std::ranges::find(mesh.has_normals, false) == mesh.has_normals.end()) return;
  const std::size_t triangles = mesh.material.size();
  std::vector<glm::vec3> flat(triangles), unit(triangles, glm::vec3(0.0f, 0.0f, 1.0f));
  for (std::size_t i = 0; i < triangles; ++i) {
    flat[i] = across(mesh.corners, i);
    if (is_thin(flat[i])) continue;
    unit[i] = flat[i] / std::sqrt(glm::dot(flat[i], flat[i]));
  }
  std::vector<unsigned> place;
  const CornersAt at(place, number_places(mesh.corners, place));
  for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
    const std::size_t triangle = i / 3;
    if (mesh.has_normals[triangle]) continue;
    glm::vec3 normal = unit[triangle];
    const std::uint32_t begin = at.first[place[i]], end = at.first[place[i] + 1];
    if (end - begin <= kMostAround) {
      glm::vec3 sum(0.0f);
      for (std::uint32_t k = begin; k < end; ++k) {
        const std::size_t other = at.list[k] / 3;
        if (glm::dot(unit[other], unit[triangle]) > kCosCrease) sum += flat[other];
      }
      if (!is_thin(sum)) normal = sum / std::sqrt(glm::dot(sum, sum));
    }
    mesh.corners[i].normal = {normal.x, normal.y, normal.z};
  }
}

void join_vertices(const LooseMesh& mesh, shapes::FlatMesh& flat) {
  std::vector<unsigned> remap(mesh.corners.size());
  const std::size_t vertices =
      meshopt_generateVertexRemap(remap.data(), nullptr, mesh.corners.size(), mesh.corners.data(),
                                  mesh.corners.size(), sizeof(FlatVertex));
  flat.vertices.resize(vertices);
  meshopt_remapVertexBuffer(flat.vertices.data(), mesh.corners.data(), mesh.corners.size(),
                            sizeof(FlatVertex), remap.data());
  FlatLevel level;
  for (std::size_t i = 0; i < mesh.material.size(); ++i) {
    if (is_thin(across(mesh.corners, i))) continue;
    level.indices.insert(level.indices.end(), remap.begin() + static_cast<std::ptrdiff_t>(3 * i),
                         remap.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
    level.material.push_back(mesh.material[i]);
  }
  if (level.material.empty()) throw Refused("a file whose triangles have no area");
  flat.levels = {std::move(level)};
  flat.materials = mesh.materials;
}

namespace {

// The triangles of each material.
std::vector<std::vector<unsigned>> by_material(const FlatLevel& level, std::size_t materials) {
  std::vector<std::vector<unsigned>> indices(materials);
  for (std::size_t i = 0; i < level.material.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      indices[level.material[i]].push_back(level.indices[3 * i + k]);
  return indices;
}

// About a quarter of the triangles. Where edges of the surface are in the way, by vertices that
// move together. `error` becomes at least how far that moves the surface, in parts of the mesh's
// largest side.
std::vector<unsigned> simplified(const std::vector<unsigned>& indices,
                                 const std::vector<FlatVertex>& vertices, float& error) {
  constexpr float kMostError = 0.05f;  // of the mesh's size
  constexpr std::size_t kFewest = 6;   // indices of two triangles
  if (indices.size() <= kFewest) return indices;
  const std::size_t wanted = std::max(indices.size() / 12 * 3, kFewest);
  const float* const positions = vertices[0].position.data();
  std::vector<unsigned> result(indices.size());
  float moved = 0.0f;
  std::size_t left =
      meshopt_simplify(result.data(), indices.data(), indices.size(), positions, vertices.size(),
                       sizeof(FlatVertex), wanted, kMostError, 0, &moved);
  if (left > 2 * wanted)
    left = meshopt_simplifySloppy(result.data(), indices.data(), indices.size(), positions,
                                  vertices.size(), sizeof(FlatVertex), wanted, kMostError, &moved);
  result.resize(left);
  error = std::max(error, moved);
  return result;
}

// How far the coarse level lies from vertices of the fine one, in units of the file. Of very fine
// ones some stand for all: what they lose is small.
float distance_between(const FlatLevel& fine, const FlatLevel& coarse,
                       const std::vector<FlatVertex>& vertices) {
  constexpr std::size_t kMostPlaces = 40'000;
  std::vector<std::uint32_t> numbers = fine.indices;
  std::ranges::sort(numbers);
  numbers.erase(std::ranges::unique(numbers).begin(), numbers.end());
  const std::size_t step = numbers.size() / kMostPlaces + 1;
  std::vector<std::uint32_t> some;
  for (std::size_t i = 0; i < numbers.size(); i += step) some.push_back(numbers[i]);
  return farthest_from(vertices, some, coarse.indices);
}

}  // namespace

void add_levels(shapes::FlatMesh& flat) {
  constexpr std::size_t kFewTriangles = 400;
  const float* const positions = flat.vertices[0].position.data();
  while (flat.levels.size() < shapes::kMostMeshLevels &&
         flat.levels.back().material.size() > kFewTriangles) {
    const auto parts = by_material(flat.levels.back(), flat.materials.size());
    FlatLevel next;
    float moved = 0.0f;
    for (std::uint32_t m = 0; m < parts.size(); ++m) {
      if (parts[m].empty()) continue;
      const std::vector<unsigned> indices = simplified(parts[m], flat.vertices, moved);
      next.indices.insert(next.indices.end(), indices.begin(), indices.end());
      next.material.resize(next.indices.size() / 3, m);
    }
    const std::size_t before = flat.levels.back().material.size();
    if (next.material.empty() || 4 * next.material.size() > 3 * before) return;
    // The library's error is a mean, which a thin part hardly tells on.
    const float scale = meshopt_simplifyScale(positions, flat.vertices.size(), sizeof(FlatVertex));
    const float apart = distance_between(flat.levels.back(), next, flat.vertices);
    moved = std::max(moved, apart / std::max(scale, 1e-20f));
    next.error = flat.levels.back().error + moved;
    flat.levels.push_back(std::move(next));
  }
}

}  // namespace swell::mesh_import
