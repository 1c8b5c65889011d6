#include "render/shadows/self_shadows.h"

#include <algorithm>
#include <cmath>

#include "render/frame/parts.h"
#include "render/view/object_levels.h"
#include "render/view/objects_drawn.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

// Objects that look smaller do not shade themselves; the shadow comes in up to twice the size.
constexpr float kLeastSize_px = 32.0f;
constexpr std::size_t kMostObjects = 16;  // the largest ones
constexpr int kLeastSide = 32, kMostSide = 256;
constexpr float kPointsPerPixel = 0.7f;
constexpr float kMostError = 0.75f;  // of the mesh, in spaces between points

float radius_of(const scene::FloatingObject& object) {
  return 0.5f * static_cast<float>(glm::length(object.size_m));
}

glm::vec3 middle_of(const scene::FloatingObject& object, const scene::ObjectPose& pose,
                    const View& view) {
  const glm::dvec3 middle(object.middle_m, (0.5 - object.draught) * object.size_m.z);
  return glm::vec3(pose.position_world + pose.world_from_object * middle - view.eye_world);
}

// The largest objects of the window, largest first: their numbers and sizes.
void list_largest(const WorldState& world, const View& view, const ObjectGeometry& objects,
                  std::vector<SunDepth>& list) {
  list.clear();
  for (const ObjectInstance& instance : objects.in_window().instances) {
    const scene::FloatingObject& object = world.scene.objects[instance.object];
    if (!scene::kObjectKinds[object.kind].shades_itself) continue;
    const float radius_m = radius_of(object);
    const glm::vec3 middle = middle_of(object, objects.poses[instance.object], view);
    const float size_px = 2.0f * radius_m * most_px_per_m(middle, radius_m, view);
    if (size_px <= kLeastSize_px) continue;
    SunDepth map;
    map.object = instance.object;
    map.size_px = size_px;
    map.middle_rel = middle;
    list.push_back(map);
  }
  const auto larger = [](const SunDepth& a, const SunDepth& b) {
    return a.size_px != b.size_px ? a.size_px > b.size_px : a.object < b.object;
  };
  const std::size_t count = std::min(list.size(), kMostObjects);
  std::partial_sort(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(count), list.end(),
                    larger);
  list.resize(count);
}

// A power of two, so that it changes seldom as an object comes near.
int side_of(float size_px) {
  int side = kLeastSide;
  while (side < kMostSide && static_cast<float>(side) < kPointsPerPixel * size_px) side *= 2;
  return side;
}

void fill_depth(const WorldState& world, const ObjectGeometry& objects, const SunDepth& map,
                std::span<float> depth_m) {
  std::ranges::fill(depth_m, SunDepth::kNothing_m);
  const scene::FloatingObject& object = world.scene.objects[map.object];
  const scene::ObjectPose& pose = objects.poses[map.object];
  const ObjectShadows& shadows = objects.shadows;
  const shapes::ObjectMesh& mesh =
      outline_mesh(world, objects, map.object, kMostError / map.points_per_m);
  const glm::mat3 sun_from_world =
      glm::transpose(glm::mat3(shadows.right, shadows.up, shadows.sun));
  const glm::mat3 axes = sun_from_world * glm::mat3(pose.world_from_object);
  const auto placed = [&](const glm::vec3& position) {
    const glm::vec3 q = position - glm::vec3(0.0f, 0.0f, 0.5f);
    const glm::vec3 p = axes * (q * glm::vec3(object.size_m));
    return glm::vec3((glm::vec2(p) - map.first_m) * map.points_per_m, p.z);
  };
  // A vertex has six triangles: those of a small mesh are placed once.
  std::array<glm::vec3, 1024> found;
  const bool is_small = mesh.position.size() <= found.size();
  if (is_small) std::ranges::transform(mesh.position, found.begin(), placed);
  const auto corner = [&](std::uint32_t index) {
    return is_small ? found[index] : placed(mesh.position[index]);
  };
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    add_triangle(
        {corner(mesh.indices[i]), corner(mesh.indices[i + 1]), corner(mesh.indices[i + 2])},
        map.side, depth_m);
}

void raise(int x, int y, float z, int side, std::span<float> depth_m) {
  if (x < 0 || y < 0 || x >= side || y >= side) return;
  float& at = depth_m[static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
                      static_cast<std::size_t>(x)];
  at = std::max(at, z);
}

// The points nearest to an edge.
void add_edge(const glm::vec3& a, const glm::vec3& b, int side, std::span<float> depth_m) {
  const glm::vec3 along = b - a;
  const int steps = static_cast<int>(std::ceil(std::max(std::abs(along.x), std::abs(along.y)))) + 1;
  const glm::vec3 step = along / static_cast<float>(steps);
  for (int k = 0; k <= steps; ++k) {
    const glm::vec3 p = a + static_cast<float>(k) * step;
    raise(static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y)), p.z, side,
          depth_m);
  }
}

}  // namespace

void add_triangle(const std::array<glm::vec3, 3>& corner, int side, std::span<float> depth_m) {
  const auto& [a, b, c] = corner;
  const glm::vec3 across = glm::cross(b - a, c - a);
  const glm::vec2 rise = -glm::vec2(across) / across.z;  // of z along x and y
  const float low = std::min({a.y, b.y, c.y}), high = std::max({a.y, b.y, c.y});
  const int last = std::min(static_cast<int>(std::floor(high)), side - 1);
  std::array<float, 3> along_y;  // of each edge's x
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::vec3 edge = corner[(k + 1) % 3] - corner[k];
    along_y[k] = edge.y == 0.0f ? 0.0f : edge.x / edge.y;
  }
  for (int y = std::max(static_cast<int>(std::ceil(low)), 0); y <= last && across.z != 0.0f; ++y) {
    const auto row = static_cast<float>(y);
    float left = static_cast<float>(side), right = -1.0f;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec3 &p = corner[k], &q = corner[(k + 1) % 3];
      const bool crosses = (p.y <= row) != (q.y <= row);
      const float x = p.x + (row - p.y) * along_y[k];
      left = std::min(left, crosses ? x : left), right = std::max(right, crosses ? x : right);
    }
    const int x0 = std::max(static_cast<int>(std::ceil(left)), 0);
    const int x1 = std::min(static_cast<int>(std::floor(right)), side - 1);
    const float z = a.z + (row - a.y) * rise.y - a.x * rise.x;
    float* const at = depth_m.data() + static_cast<std::ptrdiff_t>(y) * side;
    for (int x = x0; x <= x1; ++x) at[x] = std::max(at[x], z + static_cast<float>(x) * rise.x);
  }
  // Masts and rails are thinner than the space between points.
  float longest2 = 0.0f;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::vec2 edge(corner[(k + 1) % 3] - corner[k]);
    longest2 = std::max(longest2, glm::dot(edge, edge));
  }
  constexpr float kThin = 1.5f;
  if (across.z * across.z >= kThin * kThin * longest2) return;
  for (std::size_t k = 0; k < 3; ++k) add_edge(corner[k], corner[(k + 1) % 3], side, depth_m);
}

void find_self_shadows(const WorldState& world, const ShadowOptions& options, const View& view,
                       ObjectGeometry& objects, const StageRun& run) {
  ObjectShadows& shadows = objects.shadows;
  shadows.own.clear();
  if (options.sun_direction.z <= 0.0f || options.without.has(Part::kShadows) ||
      options.without.has(Part::kSelfShadows))
    return;
  list_largest(world, view, objects, shadows.own);
  std::size_t points = 0;
  for (SunDepth& map : shadows.own) {
    map.side = side_of(map.size_px);
    map.strength = std::min(map.size_px / kLeastSize_px - 1.0f, 1.0f);
    // Two rows around hold nothing.
    const float radius_m = radius_of(world.scene.objects[map.object]);
    const float inside = 0.5f * static_cast<float>(map.side) - 2.5f;
    map.points_per_m = inside / radius_m;
    map.first_m = -0.5f * static_cast<float>(map.side - 1) / map.points_per_m;
    points += static_cast<std::size_t>(map.side) * static_cast<std::size_t>(map.side);
  }
  shadows.own_depth_m.resize(std::max(shadows.own_depth_m.size(), points));
  std::span<float> left = shadows.own_depth_m;
  for (SunDepth& map : shadows.own) {
    const std::size_t count =
        static_cast<std::size_t>(map.side) * static_cast<std::size_t>(map.side);
    map.depth_m = left.first(count);
    left = left.subspan(count);
  }
  run.for_each(shadows.own.size(), [&](std::size_t i, int) {
    const SunDepth& map = shadows.own[i];
    const std::size_t begin =
        static_cast<std::size_t>(map.depth_m.data() - shadows.own_depth_m.data());
    fill_depth(world, objects, map,
               std::span(shadows.own_depth_m).subspan(begin, map.depth_m.size()));
  });
  for (ObjectDraws& draws : objects.draws)
    for (ObjectInstance& instance : draws.instances) {
      const auto own = std::ranges::find(shadows.own, instance.object, &SunDepth::object);
      if (own != shadows.own.end()) instance.self_shadow = &*own;
    }
}

}  // namespace swell::render
