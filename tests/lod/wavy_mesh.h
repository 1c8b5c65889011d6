// Random triangulations with random heights, all in small multiples of 2^-10: sums and products of
// a few of them are exact.
#pragma once

#include <cmath>
#include <vector>

#include "camera_walk.h"
#include "lod/mesh_query.h"
#include "lod/roam.h"
#include "math/random.h"

namespace swell::lod {

// Numbers in [0, 1), a pure function of the seed.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : seed_(seed) {}
  double uniform() { return random_uniform(seed_, counter_++); }
  double between(double low, double high) { return low + (high - low) * uniform(); }
  // A multiple of 1/64.
  double coarse(double low, double high) { return std::floor(64.0 * between(low, high)) / 64.0; }
  glm::dvec3 direction() {
    for (;;) {
      const glm::dvec3 d{between(-1, 1), between(-1, 1), between(-1, 1)};
      if (glm::dot(d, d) > 0.01 && glm::dot(d, d) < 1.0) return d;
    }
  }

 private:
  std::uint64_t seed_, counter_ = 0;
};

struct WavyMesh {
  Domain domain;
  Mesh mesh;
  std::vector<float> height_m;
  Envelopes envelopes;

  HeightMesh surface() const { return {mesh, envelopes, height_m, domain}; }
  int triangles() const { return static_cast<int>(mesh.level.size()); }
  glm::dvec2 centre() const { return domain.min_world + 0.5 * domain.size_m; }
  std::array<glm::dvec3, 3> corners(int triangle) const {
    std::array<glm::dvec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = vertex_world(surface(), mesh.indices[3 * static_cast<std::size_t>(triangle) + k]);
    return p;
  }
};

// About `triangles` of them, smallest around a random place; heights within +-height_m.
inline WavyMesh make_wavy_mesh(std::uint64_t seed, int triangles, double height_m = 8.0) {
  WavyMesh wavy;
  wavy.domain = {{-512.0, 256.0}, 1024.0, 10};
  Roam roam(wavy.domain, triangles);
  Dice dice(seed);
  AdaptRequest request;
  const glm::dvec2 eye =
      wavy.centre() + glm::dvec2{dice.between(-500, 500), dice.between(-500, 500)};
  request.view = make_view({eye, 40.0}, 0.0, -1.5, 2.8, 0.1f, 64, 64);
  request.triangle_budget = triangles;
  roam.adapt(request);
  roam.extract_mesh(wavy.mesh);
  for (std::size_t v = 0; v < wavy.mesh.lattice.size(); ++v)
    wavy.height_m.push_back(static_cast<float>(dice.coarse(-height_m, height_m)));
  build_envelopes(wavy.mesh, wavy.height_m, wavy.envelopes);
  return wavy;
}

// The part of a convex polygon where side(p) >= 0.
template <class Side>
std::vector<glm::dvec3> clipped(const std::vector<glm::dvec3>& polygon, Side side) {
  std::vector<glm::dvec3> inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    if (side(a) >= 0.0) inside.push_back(a);
    if (side(a) * side(b) < 0.0) inside.push_back(glm::mix(a, b, side(a) / (side(a) - side(b))));
  }
  return inside;
}

}  // namespace swell::lod
