// Stage 3: objects, where they are.
#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "render/view/render_view.h"

namespace swell::render {
namespace {

constexpr float kNearSize_px = 24.0f;  // objects at least this large are drawn with many triangles
// Of a file's mesh: triangles for each square pixel that an object of its size takes.
constexpr float kTrianglesPerPx2 = 0.5f;

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

// A part's vertices and triangles, into the room that is made for them.
void write_part(const scene::ObjectMesh& mesh, const Placement& placement,
                const ObjectInstance& instance, const ObjectPart& part, ObjectGeometry& out) {
  for (std::size_t i = 0; i < mesh.position.size(); ++i)
    out.p_rel[part.first_vertex + i] =
        placement.rel_from_unit * mesh.position[i] + placement.bottom_rel;
  // Each object is mirrored in, and squeezed towards, the level of its own waterline, so that its
  // images meet it there on any wave.
  std::fill_n(out.waterline_rel_m.begin() + part.first_vertex, part.vertices,
              placement.waterline_rel_m);
  for (std::size_t i = 0; i < mesh.indices.size(); ++i)
    out.indices[3 * part.first_triangle + i] = part.first_vertex + mesh.indices[i];
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    out.primitives[part.first_triangle + i] = {&mesh.triangles[i], &instance};
}

// Which objects the view may show, and where what they are drawn with goes.
void list_instances(const World::State& world, const View& view, float drop_per_m2,
                    ObjectGeometry& geometry) {
  const std::vector<scene::FloatingObject>& objects = world.scene.objects;
  const std::array<glm::vec4, 5> planes = frustum_planes(view);
  geometry.instances.clear();
  geometry.parts.clear();
  geometry.meshes.assign(objects.size(), nullptr);
  ObjectPart part;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Placement placement = placement_of(objects[i], geometry.poses[i], view);
    if (!in_view(objects[i], placement, drop_per_m2, planes)) continue;
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

const scene::ObjectMesh& drawn_mesh(const World::State& world, std::size_t object, glm::vec3 p_rel,
                                    const View& view) {
  const scene::FloatingObject& what = world.scene.objects[object];
  const std::vector<scene::ObjectMesh>& levels = world.objects.of_object[object]->levels;
  const float size_px = drawn_size_px(what, p_rel, view);
  if (what.kind != scene::ObjectKind::kMesh) return levels[size_px >= kNearSize_px ? 0 : 1];
  const float wanted = kTrianglesPerPx2 * size_px * size_px;
  std::size_t level = levels.size() - 1;
  while (level > 0 && static_cast<float>(levels[level].triangles.size()) < wanted) --level;
  return levels[level];
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
  list_instances(world, view, views.front()->drop_per_m2, geometry);
  resize_vertices(SurfaceKind::kObjects, geometry.p_rel.size(), views);
  run.for_each(geometry.parts.size(), [&](std::size_t i, int) {
    const ObjectInstance& instance = geometry.instances[i];
    const ObjectPart& part = geometry.parts[i];
    const scene::FloatingObject& object = world.scene.objects[instance.object];
    write_part(*instance.mesh, placement_of(object, geometry.poses[instance.object], view),
               instance, part, geometry);
    map_vertices(meshes, SurfaceKind::kObjects, part.first_vertex,
                 part.first_vertex + part.vertices, views);
  });
}

}  // namespace swell::render
