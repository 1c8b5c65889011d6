#include "shapes/object_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "math/check.h"
#include "math/enum_table.h"
#include "shapes/boat_shapes.h"
#include "shapes/mesh_builder.h"
#include "shapes/shore_shapes.h"

namespace swell::shapes {
namespace {

using scene::ObjectKind;
using scene::TopMark;

constexpr Paint kPaint{};
constexpr Paint kWetPaint{glm::vec3(0.45f), true};
constexpr Paint kBuoyBottomPaint{glm::vec3(0.035f, 0.03f, 0.03f), false};
constexpr Paint kDeck{glm::vec3(0.6f), true};
constexpr Paint kSteel{glm::vec3(0.10f, 0.10f, 0.11f), false};
constexpr Paint kReflector{glm::vec3(0.75f, 0.75f, 0.72f), false};
constexpr Paint kLens{glm::vec3(0.55f, 0.60f, 0.62f), false};

void add_top_mark(TopMark mark, MeshBuilder& to) {
  using V = glm::vec2;
  constexpr float kLow = 0.83f;
  switch (mark) {
    case TopMark::kCan:
      add_turned({V(0.0f, kLow), V(0.14f, kLow), V(0.14f, 1.0f), V(0.0f, 1.0f)}, kPaint, to);
      break;
    case TopMark::kCone:
      add_turned({V(0.0f, kLow), V(0.17f, kLow), V(0.0f, 1.0f)}, kPaint, to);
      break;
    case TopMark::kSphere:
      add_ball(0.18f, kLow, 1.0f, kPaint, to);
      break;
  }
}

// With fewer sides a buoy is to be seen from afar, and its pole is stout enough not to fall between
// the pixels.
constexpr int kSlimSegments = 12;

// Floats at a fifth of its height. Proportions of a steel pillar buoy.
void add_buoy(TopMark mark, MeshBuilder& to) {
  using V = glm::vec2;
  const auto turned = [&](std::initializer_list<V> profile, const Paint& paint) {
    add_turned(profile, paint, to);
  };
  // Hull, dark below the water, wet above, with a deck.
  turned({V(0.0f, 0.0f), V(0.30f, 0.0f), V(0.46f, 0.05f), V(0.5f, 0.09f), V(0.5f, 0.19f)},
         kBuoyBottomPaint);
  turned({V(0.5f, 0.19f), V(0.5f, 0.225f)}, kWetPaint);
  turned({V(0.5f, 0.225f), V(0.5f, 0.265f), V(0.47f, 0.28f)}, kPaint);
  turned({V(0.47f, 0.28f), V(0.25f, 0.285f)}, kDeck);
  // Tower with a reflecting band, then the platform.
  turned({V(0.25f, 0.285f), V(0.178f, 0.49f)}, kPaint);
  turned({V(0.178f, 0.49f), V(0.167f, 0.52f)}, kReflector);
  turned({V(0.167f, 0.52f), V(0.125f, 0.64f)}, kPaint);
  turned({V(0.125f, 0.64f), V(0.21f, 0.64f), V(0.21f, 0.652f), V(0.0f, 0.652f)}, kSteel);
  // Lantern, its cap, the pole.
  const float pole = to.segments < kSlimSegments ? 0.06f : 0.022f;
  turned({V(0.062f, 0.652f), V(0.062f, 0.715f)}, kLens);
  turned({V(0.062f, 0.715f), V(0.085f, 0.715f), V(0.085f, 0.725f), V(pole, 0.74f), V(pole, 0.84f)},
         kSteel);
  add_top_mark(mark, to);
}

// A box whose sides are cut into slices: what stands in water is seen bent, the further down the
// more.
void add_sliced_box(int slices, MeshBuilder& to) {
  constexpr std::array<glm::vec2, 4> kPlan = {
      {{-0.5f, -0.5f}, {0.5f, -0.5f}, {0.5f, 0.5f}, {-0.5f, 0.5f}}};
  const auto height = [&](int slice) {
    return static_cast<float>(slice) / static_cast<float>(slices);
  };
  const auto at = [&](std::size_t corner, float z) { return glm::vec3(kPlan[corner % 4], z); };
  add_polygon(std::array{at(3, 0.0f), at(2, 0.0f), at(1, 0.0f), at(0, 0.0f)}, kPaint, to);
  add_polygon(std::array{at(0, 1.0f), at(1, 1.0f), at(2, 1.0f), at(3, 1.0f)}, kPaint, to);
  for (int k = 0; k < slices; ++k)
    for (std::size_t i = 0; i < 4; ++i) {
      const float low = height(k), high = height(k + 1);
      add_polygon(std::array{at(i, low), at(i + 1, low), at(i + 1, high), at(i, high)}, kPaint, to);
    }
}

// Calls visit(p) where edges of the part's triangles pass a height.
template <class Visit>
void for_cuts(const ObjectMesh& mesh, const MeshPart& part, float z, const Visit& visit) {
  const std::size_t first = 3u * part.first_triangle;
  for (std::size_t i = first; i < first + 3u * part.triangles; i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec3 a = mesh.position[mesh.indices[i + k]];
      const glm::vec3 b = mesh.position[mesh.indices[i + (k + 1) % 3]];
      if ((a.z < z) == (b.z < z)) continue;
      visit(glm::vec2(a) + (z - a.z) / (b.z - a.z) * glm::vec2(b - a));
    }
  }
}

// What stands on a hull hides little of the sky: its sides are as high as they commonly are.
float hull_top(const scene::FloatingObject& object) {
  constexpr double kOfBreadth = 0.4;
  const double breadth_m = std::min(object.size_m.x, object.size_m.y);
  const double top = object.draught + kOfBreadth * breadth_m / object.size_m.z;
  return static_cast<float>(std::min(top, 1.0));
}

// The plan of a part at the waterline: its middle, half its sizes, whether it is round, and its
// top.
using SetPlan = void (*)(const scene::FloatingObject& object, const ObjectMesh& mesh,
                         MeshPart& part);

void set_buoy_plan(const scene::FloatingObject&, const ObjectMesh&, MeshPart& part) {
  part.half = glm::vec2(0.5f), part.top = 0.28f;
}

void set_ball_plan(const scene::FloatingObject& object, const ObjectMesh&, MeshPart& part) {
  const auto below = static_cast<float>(object.draught);
  part.half = glm::vec2(0.5f * std::max(2.0f * std::sqrt(below * (1.0f - below)), 1e-3f));
}

void set_box_plan(const scene::FloatingObject&, const ObjectMesh&, MeshPart& part) {
  part.half = glm::vec2(0.5f), part.is_round = false;
}

void set_hull_plan(const scene::FloatingObject& object, const ObjectMesh& mesh, MeshPart& part) {
  set_waterline(mesh, static_cast<float>(object.draught), part);
  part.top = hull_top(object);
}

// How a kind's triangles are built. `eight` and `four` are ObjectMesh::error with 8 segments and
// with 4, seen from any side, at common sizes; a box's is how far refraction bends its sides
// between their ends. A kind of a file is not built: its file's levels have errors of their own.
struct KindShape {
  void (*build)(TopMark top_mark, MeshBuilder& to) = nullptr;
  float eight = 0.0f, four = 0.0f;
  SetPlan set_plan = set_hull_plan;
};

constexpr auto kKindShapes = enum_table<ObjectKind, KindShape>({
    {ObjectKind::kBuoy, {add_buoy, 0.020f, 0.066f, set_buoy_plan}},
    {ObjectKind::kSphere,
     {[](TopMark, MeshBuilder& to) { add_ball(0.5f, 0.0f, 1.0f, kPaint, to); }, 0.064f, 0.200f,
      set_ball_plan}},
    {ObjectKind::kBox,
     {[](TopMark, MeshBuilder& to) { add_sliced_box(to.segments < kSlimSegments ? 1 : 8, to); },
      0.020f, 0.020f, set_box_plan}},
    {ObjectKind::kBoat, {[](TopMark, MeshBuilder& to) { add_boat(to); }, 0.021f, 0.060f}},
    {ObjectKind::kSailboat, {[](TopMark, MeshBuilder& to) { add_sailboat(to); }, 0.015f, 0.041f}},
    {ObjectKind::kPier, {[](TopMark, MeshBuilder& to) { add_pier(to); }, 0.006f, 0.006f}},
    {ObjectKind::kLighthouse,
     {[](TopMark, MeshBuilder& to) { add_lighthouse(to); }, 0.034f, 0.047f}},
    {ObjectKind::kRock, {[](TopMark, MeshBuilder& to) { add_rock(to); }, 0.120f, 0.190f}},
    {ObjectKind::kMesh, {}},
    {ObjectKind::kImplicit, {}},
});

}  // namespace

ObjectMesh make_object_mesh(ObjectKind kind, TopMark top_mark, int segments) {
  SWELL_CHECK(segments >= 4 && segments <= 32, "segments={}", segments);
  const KindShape& shape = kKindShapes[kind];
  SWELL_CHECK(shape.build != nullptr, "kind={}", scene::kObjectKinds[kind].name);
  MeshBuilder builder{.segments = segments};
  shape.build(top_mark, builder);
  builder.mesh.error = segments >= kLevelSegments[0] ? 0.0f
                       : segments >= 8               ? shape.eight
                                                     : shape.four;
  return std::move(builder.mesh);
}

// The box around where the triangles pass the height. It is round unless something lies near a
// corner, at the root of 2 from the middle.
void set_waterline(const ObjectMesh& mesh, float z, MeshPart& part) {
  constexpr float kFar = 1e9f, kRound = 1.3f;
  glm::vec2 low(kFar), high(-kFar);
  for_cuts(mesh, part, z, [&](glm::vec2 p) { low = glm::min(low, p), high = glm::max(high, p); });
  if (!(low.x < high.x && low.y < high.y)) return;
  part.middle = 0.5f * (low + high), part.half = 0.5f * (high - low);
  for_cuts(mesh, part, z, [&](glm::vec2 p) {
    const glm::vec2 from_middle = (p - part.middle) / part.half;
    if (glm::dot(from_middle, from_middle) > kRound * kRound) part.is_round = false;
  });
}

std::vector<MeshPart> mesh_parts(const scene::FloatingObject& object, const ObjectMesh& mesh) {
  if (!mesh.parts.empty()) return mesh.parts;
  MeshPart whole{.triangles = static_cast<std::uint32_t>(mesh.triangles.size())};
  kKindShapes[object.kind].set_plan(object, mesh, whole);
  return {whole};
}

}  // namespace swell::shapes
