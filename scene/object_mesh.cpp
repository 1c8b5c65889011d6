#include "scene/object_mesh.h"

#include <array>
#include <cmath>
#include <span>

#include "math/check.h"
#include "math/elementary.h"

namespace swell::scene {
namespace {

struct Paint {
  glm::vec3 tint{1.0f};
  bool painted = true;
};
constexpr Paint kPaint{};
constexpr Paint kWetPaint{glm::vec3(0.45f), true};
constexpr Paint kAntifouling{glm::vec3(0.035f, 0.03f, 0.03f), false};
constexpr Paint kDeck{glm::vec3(0.6f), true};
constexpr Paint kSteel{glm::vec3(0.10f, 0.10f, 0.11f), false};
constexpr Paint kReflector{glm::vec3(0.75f, 0.75f, 0.72f), false};
constexpr Paint kLens{glm::vec3(0.55f, 0.60f, 0.62f), false};

using Corners = std::array<glm::vec3, 3>;

// The interpolated normal m0 + b1 (m1 - m0) + b2 (m2 - m0), whose weights b are products of q - q0
// with the dual basis of the triangle's edges.
ObjectTriangle make_triangle(const Corners& q, const Corners& normal, const Paint& paint) {
  const glm::vec3 e1 = q[1] - q[0], e2 = q[2] - q[0];
  const glm::vec3 across = glm::cross(e1, e2);
  const float area2 = glm::dot(across, across);
  const glm::vec3 dual1 = glm::cross(e2, across) / area2, dual2 = glm::cross(across, e1) / area2;
  ObjectTriangle triangle;
  const glm::vec3 rise1 = normal[1] - normal[0], rise2 = normal[2] - normal[0];
  triangle.normal_along_x = rise1 * dual1.x + rise2 * dual2.x;
  triangle.normal_along_y = rise1 * dual1.y + rise2 * dual2.y;
  triangle.normal_along_z = rise1 * dual1.z + rise2 * dual2.z;
  triangle.normal_at_origin = normal[0] - q[0].x * triangle.normal_along_x -
                              q[0].y * triangle.normal_along_y - q[0].z * triangle.normal_along_z;
  triangle.tint = paint.tint;
  triangle.painted = paint.painted;
  return triangle;
}

void add_triangle(const std::array<std::uint32_t, 3>& vertex, const Corners& normal,
                  const Paint& paint, ObjectMesh& mesh) {
  const Corners q = {mesh.position[vertex[0]], mesh.position[vertex[1]], mesh.position[vertex[2]]};
  mesh.indices.insert(mesh.indices.end(), vertex.begin(), vertex.end());
  mesh.triangles.push_back(make_triangle(q, normal, paint));
}

// A strip between two circles around the z axis, from (r0, z0) up to (r1, z1) along the outside;
// normals (radial, up) at its ends.
struct Strip {
  glm::vec2 low, high;
  glm::vec2 normal_low, normal_high;
  Paint paint;
};

void add_strip(const Strip& strip, int segments, ObjectMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.position.size());
  std::vector<glm::vec2> around;
  for (int i = 0; i < segments; ++i) {
    const SinCos angle = sin_cos_turns(static_cast<double>(i) / segments);
    around.emplace_back(static_cast<float>(angle.cos), static_cast<float>(angle.sin));
  }
  for (const glm::vec2& end : {strip.low, strip.high})
    for (const glm::vec2& a : around) mesh.position.emplace_back(end.x * a, end.y);
  const auto n = static_cast<std::uint32_t>(segments);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    const auto normal = [&](glm::vec2 rise, std::uint32_t k) {
      return glm::vec3(rise.x * around[k], rise.y);
    };
    const glm::vec3 a = normal(strip.normal_low, i), b = normal(strip.normal_low, j);
    const glm::vec3 c = normal(strip.normal_high, j), d = normal(strip.normal_high, i);
    // A circle of radius 0 is a point: one of the two triangles has no area.
    if (strip.low.x > 0.0f)
      add_triangle({first + i, first + j, first + n + j}, {a, b, c}, strip.paint, mesh);
    if (strip.high.x > 0.0f)
      add_triangle({first + i, first + n + j, first + n + i}, {a, c, d}, strip.paint, mesh);
  }
}

// A strip with one normal along its slope.
void add_cone(glm::vec2 low, glm::vec2 high, const Paint& paint, int segments, ObjectMesh& mesh) {
  const glm::vec2 along = high - low;
  const glm::vec2 normal = glm::vec2(along.y, -along.x) / std::sqrt(glm::dot(along, along));
  add_strip({low, high, normal, normal, paint}, segments, mesh);
}

// A chain of cones through points (radius, z), from the bottom up.
void add_turned(std::span<const glm::vec2> profile, const Paint& paint, int segments,
                ObjectMesh& mesh) {
  for (std::size_t i = 0; i + 1 < profile.size(); ++i)
    add_cone(profile[i], profile[i + 1], paint, segments, mesh);
}

void add_ball(float radius, float z_low, float z_high, int segments, ObjectMesh& mesh) {
  const int rings = std::max(segments / 2, 3);
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
    add_strip(
        {place(point(i)), place(point(i + 1)), normal(point(i)), normal(point(i + 1)), kPaint},
        segments, mesh);
}

void add_box(ObjectMesh& mesh) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      glm::vec3 out(0.0f), u(0.0f), v(0.0f);
      out[axis] = side;
      u[(axis + 1) % 3] = 1.0f;
      v[(axis + 2) % 3] = side;
      const auto first = static_cast<std::uint32_t>(mesh.position.size());
      for (const glm::vec2& corner : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
        mesh.position.push_back(0.5f * (out + corner.x * u + corner.y * v) +
                                glm::vec3(0.0f, 0.0f, 0.5f));
      add_triangle({first, first + 1, first + 2}, {out, out, out}, kPaint, mesh);
      add_triangle({first, first + 2, first + 3}, {out, out, out}, kPaint, mesh);
    }
  }
}

void add_top_mark(TopMark mark, int segments, ObjectMesh& mesh) {
  using V = glm::vec2;
  constexpr float kLow = 0.83f;
  switch (mark) {
    case TopMark::kCan:
      add_turned(std::array{V(0.0f, kLow), V(0.14f, kLow), V(0.14f, 1.0f), V(0.0f, 1.0f)}, kPaint,
                 segments, mesh);
      break;
    case TopMark::kCone:
      add_turned(std::array{V(0.0f, kLow), V(0.17f, kLow), V(0.0f, 1.0f)}, kPaint, segments, mesh);
      break;
    case TopMark::kSphere:
      add_ball(0.18f, kLow, 1.0f, segments, mesh);
      break;
  }
}

// With fewer sides a buoy is to be seen from afar, and its pole is stout enough not to fall between
// the pixels.
constexpr int kSlimSegments = 12;

// Floats at a fifth of its height. Proportions of a steel pillar buoy.
void add_buoy(TopMark mark, int segments, ObjectMesh& mesh) {
  using V = glm::vec2;
  const auto turned = [&](std::initializer_list<V> profile, const Paint& paint) {
    add_turned(std::span(profile.begin(), profile.size()), paint, segments, mesh);
  };
  // Hull, dark below the water, wet above, with a deck.
  turned({V(0.0f, 0.0f), V(0.30f, 0.0f), V(0.46f, 0.05f), V(0.5f, 0.09f), V(0.5f, 0.19f)},
         kAntifouling);
  turned({V(0.5f, 0.19f), V(0.5f, 0.225f)}, kWetPaint);
  turned({V(0.5f, 0.225f), V(0.5f, 0.265f), V(0.47f, 0.28f)}, kPaint);
  turned({V(0.47f, 0.28f), V(0.25f, 0.285f)}, kDeck);
  // Tower with a reflecting band, then the platform.
  turned({V(0.25f, 0.285f), V(0.178f, 0.49f)}, kPaint);
  turned({V(0.178f, 0.49f), V(0.167f, 0.52f)}, kReflector);
  turned({V(0.167f, 0.52f), V(0.125f, 0.64f)}, kPaint);
  turned({V(0.125f, 0.64f), V(0.21f, 0.64f), V(0.21f, 0.652f), V(0.0f, 0.652f)}, kSteel);
  // Lantern, its cap, the pole.
  const float pole = segments < kSlimSegments ? 0.06f : 0.022f;
  turned({V(0.062f, 0.652f), V(0.062f, 0.715f)}, kLens);
  turned({V(0.062f, 0.715f), V(0.085f, 0.715f), V(0.085f, 0.725f), V(pole, 0.74f), V(pole, 0.84f)},
         kSteel);
  add_top_mark(mark, segments, mesh);
}

}  // namespace

ObjectMesh make_object_mesh(ObjectKind kind, TopMark top_mark, int segments) {
  SWELL_CHECK(segments >= 4 && segments <= 32, "segments={}", segments);
  ObjectMesh mesh;
  switch (kind) {
    case ObjectKind::kBuoy:
      add_buoy(top_mark, segments, mesh);
      break;
    case ObjectKind::kSphere:
      add_ball(0.5f, 0.0f, 1.0f, segments, mesh);
      break;
    case ObjectKind::kBox:
      add_box(mesh);
      break;
  }
  return mesh;
}

}  // namespace swell::scene
