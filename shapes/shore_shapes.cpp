#include "shapes/shore_shapes.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/elementary.h"
#include "math/random.h"

namespace swell::shapes {
namespace {

constexpr Paint kTimber{};
constexpr Paint kStone{glm::vec3(0.30f, 0.29f, 0.27f), false, 0.9f};
constexpr Paint kBand{glm::vec3(1.0f), true, 0.55f};
constexpr Paint kWhite{glm::vec3(0.72f, 0.72f, 0.70f), false, 0.55f};
constexpr Paint kIron{glm::vec3(0.045f, 0.05f, 0.05f), false, 0.4f};
constexpr Paint kPane{glm::vec3(0.10f, 0.12f, 0.12f), false, 0.06f};

// A tint that differs from piece to piece.
Paint weathered(const Paint& paint, std::uint64_t piece, float by) {
  const auto at = static_cast<float>(2.0 * random_uniform(71, piece) - 1.0);
  Paint result = paint;
  result.tint *= 1.0f + by * at;
  return result;
}

// --- Of the rock

struct Facet {
  glm::vec3 out;
  float distance;
};

// A ball with pieces broken off.
std::vector<Facet> facets_of_rock() {
  std::vector<Facet> facets;
  for (std::uint64_t i = 0; i < 14; ++i) {
    const double z = 2.0 * random_uniform(72, 3 * i) - 1.0;
    const SinCos around = sin_cos_turns(random_uniform(72, 3 * i + 1));
    const double r = std::sqrt(1.0 - z * z);
    facets.push_back({glm::vec3(r * around.cos, r * around.sin, z),
                      static_cast<float>(0.62 + 0.25 * random_uniform(72, 3 * i + 2))});
  }
  return facets;
}

glm::vec3 point_of_rock(glm::vec3 direction, std::span<const Facet> facets) {
  float radius = 1.0f;
  for (const Facet& f : facets) {
    const float cosine = glm::dot(direction, f.out);
    if (cosine > 0.05f) radius = std::min(radius, f.distance / cosine);
  }
  return radius * direction;
}

}  // namespace

// Posts stand in pairs; the deck is of planks across, side by side: gaps would be less than a pixel
// wide from most places, and dotted.
void add_pier(MeshBuilder& to) {
  const bool fine = to.segments >= 12;
  constexpr float kHalfWidth = 18.0f, kTop = 2.1f, kLow = -4.9f;
  constexpr int kPairs = 9;
  to.size = {3.0f, 2.0f * kHalfWidth, kTop - kLow};
  to.origin = {0.0f, 0.0f, -kLow};
  to.segments = fine ? 8 : 4;
  const int planks = fine ? 45 : 1;
  const float step = 2.0f * kHalfWidth / static_cast<float>(planks);
  for (int i = 0; i < planks; ++i) {
    const float y = -kHalfWidth + static_cast<float>(i) * step;
    add_box({-1.5f, y, kTop - 0.12f}, {1.5f, y + step, kTop},
            weathered(kTimber, static_cast<std::uint64_t>(i), 0.25f), to);
  }
  for (const float x : {-1.1f, 1.1f})
    add_box({x - 0.1f, -kHalfWidth + 0.1f, kTop - 0.42f},
            {x + 0.1f, kHalfWidth - 0.1f, kTop - 0.13f}, kTimber, to);
  end_part({}, to);
  constexpr float kRadius = 0.16f;
  for (int i = 0; i < kPairs; ++i) {
    const float y =
        -kHalfWidth + 1.0f + static_cast<float>(i) * (2.0f * kHalfWidth - 2.0f) / (kPairs - 1);
    for (const float x : {-1.1f, 1.1f}) {
      to.origin = {x, y, -kLow};
      Paint wet = weathered(kTimber, 100u + static_cast<std::uint64_t>(2 * i) + (x > 0.0f), 0.2f);
      add_turned({{kRadius, 0.55f}, {kRadius, kTop - 0.4f}}, wet, to);
      wet.tint *= 0.35f;  // weed, up to where the water mostly wets it
      wet.tint.g *= 1.15f;
      add_turned({{kRadius, kLow}, {kRadius, 0.55f}}, wet, to);
      end_part({.middle = glm::vec2(x, y) / glm::vec2(to.size),
                .half = glm::vec2(kRadius) / glm::vec2(to.size),
                .top = -kLow / to.size.z + 0.03f},
               to);
    }
  }
}

void add_lighthouse(MeshBuilder& to) {
  using V = glm::vec2;
  to.size = {8.0f, 8.0f, 26.0f};
  to.origin = glm::vec3(0.0f);
  add_turned({V(4.0f, 0.0f), V(3.9f, 1.6f), V(3.2f, 1.6f), V(3.2f, 2.4f), V(2.6f, 2.4f)}, kStone,
             to);
  const auto radius = [](float z) { return 2.6f - 0.75f * (z - 2.4f) / 16.6f; };
  constexpr int kBands = 5;
  for (int i = 0; i < kBands; ++i) {
    const float low = 2.4f + 16.6f * static_cast<float>(i) / kBands;
    const float high = 2.4f + 16.6f * static_cast<float>(i + 1) / kBands;
    add_turned({V(radius(low), low), V(radius(high), high)}, i % 2 == 0 ? kBand : kWhite, to);
  }
  // The gallery with its parapet, the lantern, its roof.
  add_turned({V(1.85f, 18.4f), V(2.7f, 19.0f), V(2.7f, 20.1f), V(2.6f, 20.1f), V(2.6f, 19.25f),
              V(1.3f, 19.25f)},
             kIron, to);
  add_turned({V(1.45f, 19.25f), V(1.45f, 19.9f)}, kWhite, to);
  add_turned({V(1.4f, 19.9f), V(1.4f, 22.0f)}, kPane, to);
  add_turned({V(1.4f, 22.0f), V(1.75f, 22.0f), V(1.75f, 22.2f), V(1.1f, 23.2f), V(0.25f, 23.9f),
              V(0.25f, 24.3f), V(0.06f, 24.4f), V(0.05f, 26.0f), V(0.0f, 26.0f)},
             kBand, to);
  if (to.segments < 12) return;
  // Windows up the tower, and the bars of the lantern.
  for (const float z : {5.5f, 9.5f, 13.5f, 17.0f})
    add_box({-0.3f, -radius(z) - 0.03f, z - 0.5f}, {0.3f, -radius(z) + 0.4f, z + 0.5f}, kIron, to);
  add_box({-0.5f, -3.22f, 1.6f}, {0.5f, -2.4f, 4.0f}, kIron, to);
  for (int i = 0; i < 8; ++i) {
    const SinCos a = sin_cos_turns(i / 8.0);
    const glm::vec3 at(1.42 * a.sin, 1.42 * a.cos, 19.9);
    add_box(at - glm::vec3(0.04f, 0.04f, 0.0f), at + glm::vec3(0.04f, 0.04f, 2.1f), kIron, to);
  }
}

void add_rock(MeshBuilder& to) {
  const std::vector<Facet> facets = facets_of_rock();
  const int columns = to.segments, rows = std::max(columns / 2, 4);
  std::vector<glm::vec3> points;
  glm::vec3 low(10.0f), high(-10.0f);
  for (int i = 0; i <= rows; ++i) {
    const SinCos up = sin_cos_turns(0.5 * i / rows);
    for (int j = 0; j <= columns; ++j) {
      const SinCos around = sin_cos_turns(static_cast<double>(j % columns) / columns);
      const double r = i == 0 || i == rows ? 0.0 : up.sin;
      points.push_back(point_of_rock(glm::vec3(r * around.cos, r * around.sin, -up.cos), facets));
      low = glm::min(low, points.back()), high = glm::max(high, points.back());
    }
  }
  to.size = high - low;
  to.origin = -glm::vec3(0.5f * (low.x + high.x), 0.5f * (low.y + high.y), low.z);
  add_sheet(points, columns + 1, {}, to);
  for (std::size_t i = 0; i < to.mesh.triangles.size(); ++i) {
    ObjectTriangle& t = to.mesh.triangles[i];
    t.tint = weathered({}, 200 + i, 0.05f).tint;
    // Weed and wet stone below, dry stone above.
    float z = 0.0f;
    for (std::size_t k = 0; k < 3; ++k) z += to.mesh.position[to.mesh.indices[3 * i + k]].z / 3.0f;
    if (z < 0.46f) t.tint *= glm::vec3(0.42f, 0.46f, 0.36f);
  }
}

}  // namespace swell::shapes
