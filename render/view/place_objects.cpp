// Stage 3: objects, where they are.
#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "render/view/render_view.h"

namespace swell::render {
namespace {

constexpr float kNearSize_px = 24.0f;  // objects at least this large are drawn with many triangles
// Of a file's mesh: triangles for each square pixel that an object of its size takes.
constexpr float kTrianglesPerPx2 = 0.15f;
constexpr float kShadowPart = 0.25f;  // an outline is that of an object so many times smaller

// How an object lies relative to the eye.
struct Placement {
  glm::mat3 rel_from_unit;
  glm::vec3 bottom_rel;
  float waterline_rel_m;
};

Placement placement_of(const scene::FloatingObject& object, const scene::ObjectPose& pose,
                       const View& view) {
  const glm::dvec3 waterline = pose.position_world - view.eye_world;
  const glm::dmat3& axes = pose.world_from_object;
  const glm::dmat3 scaled(axes[0] * object.size_m.x, axes[1] * object.size_m.y,
                          axes[2] * object.size_m.z);
  const glm::dvec3 bottom =
      waterline + axes * glm::dvec3(object.middle_m, 0.0) - object.draught * scaled[2];
  return {glm::mat3(scaled), glm::vec3(bottom),
          static_cast<float>(pose.water_m - view.eye_world.z)};
}

ObjectInstance instance_of(const scene::FloatingObject& object, const scene::ObjectPose& pose,
                           const Placement& placement) {
  ObjectInstance instance;
  const glm::dmat3& axes = pose.world_from_object;
  instance.right = glm::vec3(axes[0] / object.size_m.x);
  instance.ahead = glm::vec3(axes[1] / object.size_m.y);
  instance.up = glm::vec3(axes[2] / object.size_m.z);
  instance.bottom_rel = placement.bottom_rel;
  instance.waterline_rel_m = placement.waterline_rel_m;
  instance.colour = object.colour;
  instance.roughness = static_cast<float>(object.roughness);
  instance.metalness = static_cast<float>(object.metalness);
  if (object.checker_m > 0.0) {
    instance.squares_per_m = static_cast<float>(1.0 / object.checker_m);
    instance.squares_per_unit = glm::vec3(object.size_m / object.checker_m);
  }
  const double volume = object.size_m.x * object.size_m.y * object.size_m.z;
  instance.log2_units_per_m = static_cast<float>(-log(volume) / (3.0 * log(2.0)));
  return instance;
}

// Whether the view may show any of the object or of its mirror image.
bool in_view(const scene::FloatingObject& object, const Placement& placement, float drop_per_m2,
             const std::array<glm::vec4, 5>& planes) {
  const glm::vec3 size(object.size_m);
  const float radius = std::sqrt(0.25f * (size.x * size.x + size.y * size.y) + size.z * size.z);
  glm::vec3 centre = placement.bottom_rel;
  centre.z -= (centre.x * centre.x + centre.y * centre.y) * drop_per_m2;
  // The image of what stands over the water lies as far below it.
  const float away = std::abs(placement.bottom_rel.z - placement.waterline_rel_m);
  const float reach = std::max(2.0f * radius, radius + 2.0f * away);
  return std::ranges::all_of(planes, [&](const glm::vec4& plane) {
    return glm::dot(glm::vec3(plane), centre) + plane.w >= -reach;
  });
}

// Calls body(i, first, count) for the pieces of parts that numbers [begin, end) are of, counted
// through all parts: of part i those from its own number `first` on.
template <class First, class Count, class Body>
void for_pieces(const std::vector<ObjectPart>& parts, std::size_t begin, std::size_t end,
                First first_of, Count count_of, const Body& body) {
  auto part = std::ranges::upper_bound(parts, begin, {}, first_of) - 1;
  for (; begin < end; ++part) {
    const std::size_t first = begin - (*part).*first_of;
    const std::size_t count = std::min((*part).*count_of - first, end - begin);
    body(static_cast<std::size_t>(part - parts.begin()), first, count);
    begin += count;
  }
}

// Vertices [begin, end), counted through all parts.
void write_vertices(const World::State& world, const View& view, std::size_t begin, std::size_t end,
                    ObjectGeometry& out) {
  for_pieces(out.parts, begin, end, &ObjectPart::first_vertex, &ObjectPart::vertices,
             [&](std::size_t i, std::size_t first, std::size_t count) {
               const ObjectInstance& instance = out.instances[i];
               const Placement placement = placement_of(world.scene.objects[instance.object],
                                                        out.poses[instance.object], view);
               const std::size_t at = out.parts[i].first_vertex + first;
               for (std::size_t k = 0; k < count; ++k)
                 out.p_rel[at + k] = placement.rel_from_unit * instance.mesh->position[first + k] +
                                     placement.bottom_rel;
               // Each object is mirrored in, and squeezed towards, the level of its own waterline,
               // so that its images meet it there on any wave.
               std::fill_n(out.waterline_rel_m.begin() + static_cast<std::ptrdiff_t>(at), count,
                           placement.waterline_rel_m);
             });
}

// The same of triangles.
void write_triangles(std::size_t begin, std::size_t end, ObjectGeometry& out) {
  for_pieces(out.parts, begin, end, &ObjectPart::first_triangle, &ObjectPart::triangles,
             [&](std::size_t i, std::size_t first, std::size_t count) {
               const ObjectInstance& instance = out.instances[i];
               const ObjectPart& part = out.parts[i];
               const std::size_t at = part.first_triangle + first;
               for (std::size_t k = 0; k < 3 * count; ++k)
                 out.indices[3 * at + k] =
                     part.first_vertex + instance.mesh->indices[3 * first + k];
               for (std::size_t k = 0; k < count; ++k)
                 out.primitives[at + k] = {&instance.mesh->triangles[first + k], &instance};
             });
}

// Which objects the view may show, and where what they are drawn with goes.
void list_instances(const World::State& world, const View& view, FrameViews views,
                    ObjectGeometry& geometry) {
  const float drop_per_m2 = views.front()->drop_per_m2;
  const bool submerged =
      std::ranges::any_of(views, [](const RenderView* shown) { return shown->eye.submerged; });
  const std::vector<scene::FloatingObject>& objects = world.scene.objects;
  const std::array<glm::vec4, 5> planes = frustum_planes(view);
  geometry.instances.clear();
  geometry.parts.clear();
  geometry.meshes.assign(objects.size(), nullptr);
  ObjectPart part;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Placement placement = placement_of(objects[i], geometry.poses[i], view);
    // Through the surface an eye under water sees them far from where they are.
    if (!submerged && !in_view(objects[i], placement, drop_per_m2, planes)) continue;
    const scene::ObjectMesh& mesh = drawn_mesh(world, i, placement.bottom_rel, view);
    geometry.meshes[i] = &mesh;
    geometry.instances.push_back(instance_of(objects[i], geometry.poses[i], placement));
    geometry.instances.back().object = static_cast<std::uint32_t>(i);
    geometry.instances.back().mesh = &mesh;
    part.first_triangle += part.triangles;
    part.first_vertex += part.vertices;
    part.triangles = static_cast<std::uint32_t>(mesh.triangles.size());
    part.vertices = static_cast<std::uint32_t>(mesh.position.size());
    geometry.parts.push_back(part);
  }
  const std::size_t triangles = part.first_triangle + part.triangles;
  const std::size_t vertices = part.first_vertex + part.vertices;
  geometry.primitives.resize(triangles);
  geometry.indices.resize(3 * triangles);
  geometry.p_rel.resize(vertices);
  geometry.waterline_rel_m.resize(vertices);
}

}  // namespace

float drawn_size_px(const scene::FloatingObject& object, glm::vec3 p_rel, const View& view) {
  const float distance_m = std::sqrt(glm::dot(p_rel, p_rel));
  const float px_at_1_m = 0.5f * static_cast<float>(view.height_px) / view.tan_half_y;
  if (object.kind < scene::ObjectKind::kBoat)
    return px_at_1_m * static_cast<float>(object.size_m.z) / std::max(distance_m, view.near_m);
  // Its nearest point.
  const auto size_m =
      static_cast<float>(std::max({object.size_m.x, object.size_m.y, object.size_m.z}));
  return px_at_1_m * size_m / std::max(distance_m - 0.5f * size_m, view.near_m);
}

namespace {

const scene::ObjectMesh& mesh_of_size(const World::State& world, std::size_t object,
                                      float size_px) {
  const std::vector<scene::ObjectMesh>& levels = world.objects.of_object[object]->levels;
  if (world.scene.objects[object].kind != scene::ObjectKind::kMesh)
    return levels[size_px >= kNearSize_px ? 0 : 1];
  const float wanted = kTrianglesPerPx2 * size_px * size_px;
  std::size_t level = levels.size() - 1;
  while (level > 0 && static_cast<float>(levels[level].triangles.size()) < wanted) --level;
  return levels[level];
}

}  // namespace

const scene::ObjectMesh& drawn_mesh(const World::State& world, std::size_t object, glm::vec3 p_rel,
                                    const View& view) {
  return mesh_of_size(world, object, drawn_size_px(world.scene.objects[object], p_rel, view));
}

const scene::ObjectMesh& shadow_mesh(const World::State& world, std::size_t object, glm::vec3 p_rel,
                                     const View& view) {
  const scene::FloatingObject& what = world.scene.objects[object];
  const float part = what.kind < scene::ObjectKind::kBoat ? 1.0f : kShadowPart;
  return mesh_of_size(world, object, part * drawn_size_px(what, p_rel, view));
}

void drawn_poses(const World::State& world, const ocean::SeaFrame& sea,
                 std::span<const scene::GivenPose> given, std::span<scene::ObjectPose> poses,
                 const StageRun& run) {
  if (poses.empty()) return;
  constexpr std::size_t kAtOnce = 32;
  const std::span<const scene::FloatingObject> objects = world.scene.objects;
  const ocean::WaterSurface surface = water_surface(world, sea);
  run.for_each((poses.size() + kAtOnce - 1) / kAtOnce, [&](std::size_t chunk, int) {
    const std::size_t begin = chunk * kAtOnce, count = std::min(kAtOnce, poses.size() - begin);
    scene::object_poses(objects.subspan(begin, count), surface, poses.subspan(begin, count));
  });
  const bool is_flat = world.scene.detail.triangulation == scene::Triangulation::kPlane;
  if (is_flat) scene::lay_flat(objects, poses);
  scene::take_given_poses(objects, given, surface, poses);
  if (is_flat)
    for (const scene::GivenPose& g : given) poses[g.object].water_m = 0.0;
}

void place_objects(const World::State& world, const SeaMaps& sea, const View& view,
                   std::span<const scene::GivenPose> given, Meshes& meshes, FrameViews views,
                   const StageRun& run) {
  ObjectGeometry& geometry = meshes.objects;
  geometry.poses.resize(world.scene.objects.size());
  drawn_poses(world, sea.frame, given, geometry.poses, run);
  geometry.instances.reserve(geometry.poses.size());  // primitives point into it
  list_instances(world, view, views, geometry);
  resize_vertices(SurfaceKind::kObjects, geometry.p_rel.size(), views);
  const auto for_chunks = [&](std::size_t count, auto&& body) {
    run.for_each((count + kVertexChunk - 1) / kVertexChunk, [&](std::size_t chunk, int) {
      body(chunk * kVertexChunk, std::min(count, (chunk + 1) * kVertexChunk));
    });
  };
  for_chunks(geometry.p_rel.size(), [&](std::size_t begin, std::size_t end) {
    write_vertices(world, view, begin, end, geometry);
    map_vertices(meshes, SurfaceKind::kObjects, begin, end, views);
  });
  for_chunks(geometry.primitives.size(),
             [&](std::size_t begin, std::size_t end) { write_triangles(begin, end, geometry); });
}

}  // namespace swell::render
