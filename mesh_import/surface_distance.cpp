#include "mesh_import/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <vector>

namespace swell::mesh_import {
namespace {

constexpr int kLeastCells = 4, kMostCells = 48;  // along the longest side

glm::vec3 place(const shapes::FlatVertex& v) {
  return {v.position[0], v.position[1], v.position[2]};
}

float square(glm::vec3 v) { return glm::dot(v, v); }

float square_to_segment(glm::vec3 p, glm::vec3 a, glm::vec3 b) {
  const glm::vec3 along = b - a;
  const float t = glm::dot(p - a, along) / std::max(square(along), 1e-30f);
  return square(a + std::clamp(t, 0.0f, 1.0f) * along - p);
}

// From the plane where the point's foot lies in the triangle, or else from an edge.
float square_to_triangle(glm::vec3 p, const std::array<glm::vec3, 3>& q) {
  const glm::vec3 normal = glm::cross(q[1] - q[0], q[2] - q[0]);
  bool inside = square(normal) > 0.0f;
  for (std::size_t k = 0; k < 3; ++k)
    inside &= glm::dot(glm::cross(q[(k + 1) % 3] - q[k], p - q[k]), normal) >= 0.0f;
  if (inside) {
    const float height = glm::dot(p - q[0], normal);
    return height * height / square(normal);
  }
  return std::min({square_to_segment(p, q[0], q[1]), square_to_segment(p, q[1], q[2]),
                   square_to_segment(p, q[2], q[0])});
}

// The triangles of a surface by the cells of a grid that their boxes touch.
class TriangleGrid {
 public:
  TriangleGrid(std::span<const shapes::FlatVertex> vertices, std::span<const std::uint32_t> indices)
      : vertices_(vertices), indices_(indices) {
    glm::vec3 high(-1e30f);
    low_ = glm::vec3(1e30f);
    for (const std::uint32_t i : indices) {
      low_ = glm::min(low_, place(vertices[i]));
      high = glm::max(high, place(vertices[i]));
    }
    const glm::vec3 size = high - low_;
    const auto triangles = static_cast<float>(indices.size() / 3);
    const int cells =
        std::clamp(static_cast<int>(0.5f * std::sqrt(triangles)), kLeastCells, kMostCells);
    cell_ = std::max({size.x, size.y, size.z, 1e-20f}) / static_cast<float>(cells);
    count_ = glm::ivec3(size / cell_) + 1;
    first_.resize(static_cast<std::size_t>(count_.x) * count_.y * count_.z + 1);
    // Counts, then places.
    for_all_cells([&](std::size_t cell, std::uint32_t) { ++first_[cell + 1]; });
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    list_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for_all_cells([&](std::size_t cell, std::uint32_t t) { list_[next[cell]++] = t; });
  }

  // The square of the distance of p from the surface, or any number up to `enough` if it is less.
  float square_to(glm::vec3 p, float enough) const {
    const glm::ivec3 middle = cell_at(p);
    float best = 1e30f;
    const int rings = std::max({count_.x, count_.y, count_.z});
    for (int ring = 0; ring < rings; ++ring) {
      visit_ring(middle, ring, [&](std::size_t cell) {
        for (std::uint32_t k = first_[cell]; k < first_[cell + 1]; ++k)
          best = std::min(best, square_to_triangle(p, corners(list_[k])));
      });
      const float searched = static_cast<float>(ring) * cell_;
      if (best <= std::max(enough, searched * searched)) break;
    }
    return best;
  }

 private:
  std::array<glm::vec3, 3> corners(std::uint32_t t) const {
    return {place(vertices_[indices_[3 * t]]), place(vertices_[indices_[3 * t + 1]]),
            place(vertices_[indices_[3 * t + 2]])};
  }
  glm::ivec3 cell_at(glm::vec3 p) const {
    return glm::clamp(glm::ivec3(glm::floor((p - low_) / cell_)), glm::ivec3(0), count_ - 1);
  }
  std::size_t number_of(glm::ivec3 c) const {
    return (static_cast<std::size_t>(c.z) * count_.y + c.y) * count_.x + c.x;
  }
  template <class Visit>
  void for_all_cells(const Visit& visit) const {
    for (std::uint32_t t = 0; t < indices_.size() / 3; ++t) {
      const auto q = corners(t);
      const glm::ivec3 from = cell_at(glm::min(glm::min(q[0], q[1]), q[2]));
      const glm::ivec3 to = cell_at(glm::max(glm::max(q[0], q[1]), q[2]));
      for (int z = from.z; z <= to.z; ++z)
        for (int y = from.y; y <= to.y; ++y)
          for (int x = from.x; x <= to.x; ++x) visit(number_of({x, y, z}), t);
    }
  }
  // The cells that are `ring` away along one axis and no more along the others.
  template <class Visit>
  void visit_ring(glm::ivec3 middle, int ring, const Visit& visit) const {
    const glm::ivec3 from = glm::max(middle - ring, glm::ivec3(0));
    const glm::ivec3 to = glm::min(middle + ring, count_ - 1);
    for (int z = from.z; z <= to.z; ++z)
      for (int y = from.y; y <= to.y; ++y) {
        const bool whole = std::abs(z - middle.z) == ring || std::abs(y - middle.y) == ring;
        const int step = whole || ring == 0 ? 1 : 2 * ring;
        for (int x = whole ? from.x : middle.x - ring; x <= to.x; x += step)
          if (x >= from.x) visit(number_of({x, y, z}));
      }
  }

  std::span<const shapes::FlatVertex> vertices_;
  std::span<const std::uint32_t> indices_;
  glm::vec3 low_;
  float cell_ = 1.0f;
  glm::ivec3 count_{1};
  std::vector<std::uint32_t> first_, list_;
};

}  // namespace

float farthest_from(std::span<const shapes::FlatVertex> vertices,
                    std::span<const std::uint32_t> numbers,
                    std::span<const std::uint32_t> indices) {
  if (numbers.empty() || indices.empty()) return 0.0f;
  const TriangleGrid surface(vertices, indices);
  float worst = 0.0f;
  for (const std::uint32_t i : numbers)
    worst = std::max(worst, surface.square_to(place(vertices[i]), worst));
  return std::sqrt(worst);
}

}  // namespace swell::mesh_import
