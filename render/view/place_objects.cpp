// Stage 3: floating objects, where the sea carries them.
#include <algorithm>
#include <cmath>

#include "render/view/render_view.h"

namespace swell::render {
namespace {

constexpr int kNearSegments = 24, kFarSegments = 8;
constexpr float kNearHeight_px = 24.0f;  // objects at least this high are drawn with many triangles

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
  return {glm::mat3(scaled), glm::vec3(waterline - object.draught * scaled[2]),
          static_cast<float>(waterline.z)};
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
  return instance;
}

// Whether the view may show any of the object or of its mirror image.
bool in_view(const scene::FloatingObject& object, const Placement& placement, float drop_per_m2,
             const std::array<glm::vec4, 5>& planes) {
  const glm::vec3 size(object.size_m);
  const float radius = std::sqrt(0.25f * (size.x * size.x + size.y * size.y) + size.z * size.z);
  glm::vec3 centre = placement.bottom_rel;
  centre.z -= (centre.x * centre.x + centre.y * centre.y) * drop_per_m2;
  // The bottom lies within a height of the waterline; so does all of both images.
  const float reach = 2.0f * radius;
  return std::ranges::all_of(planes, [&](const glm::vec4& plane) {
    return glm::dot(glm::vec3(plane), centre) + plane.w >= -reach;
  });
}

void add_vertices(const scene::ObjectMesh& mesh, const Placement& placement, ObjectGeometry& out) {
  for (const glm::vec3& q : mesh.position) {
    out.p_rel.push_back(placement.rel_from_unit * q + placement.bottom_rel);
    // Each object is mirrored in, and squeezed towards, the level of its own waterline, so that its
    // images meet it there on any wave.
    out.waterline_rel_m.push_back(placement.waterline_rel_m);
  }
}

void add_triangles(const scene::ObjectMesh& mesh, const ObjectInstance& instance,
                   std::uint32_t first_vertex, ObjectGeometry& out) {
  for (const std::uint32_t index : mesh.indices) out.indices.push_back(first_vertex + index);
  for (const scene::ObjectTriangle& triangle : mesh.triangles)
    out.primitives.push_back({&triangle, &instance});
}

void clear_geometry(ObjectGeometry& geometry) {
  geometry.meshes.clear();
  geometry.instances.clear();
  geometry.parts.clear();
  geometry.primitives.clear();
  geometry.indices.clear();
  geometry.p_rel.clear();
  geometry.waterline_rel_m.clear();
}

}  // namespace

ObjectMeshes build_object_meshes(std::span<const scene::FloatingObject> objects) {
  ObjectMeshes result;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const auto same = std::find_if(objects.begin(), objects.begin() + i, [&](const auto& other) {
      return other.kind == objects[i].kind && other.top_mark == objects[i].top_mark;
    });
    const auto twin = static_cast<std::size_t>(same - objects.begin());
    if (twin < i) {
      result.of_object.push_back(result.of_object[twin]);
      continue;
    }
    result.of_object.push_back({result.meshes.size(), result.meshes.size() + 1});
    for (const int segments : {kNearSegments, kFarSegments})
      result.meshes.push_back(
          scene::make_object_mesh(objects[i].kind, objects[i].top_mark, segments));
  }
  return result;
}

std::vector<lod::Focus> object_focuses(std::span<const scene::FloatingObject> objects) {
  // The hull, and as much of the water around as its waterline and its mirror image take.
  std::vector<lod::Focus> focuses;
  for (const scene::FloatingObject& object : objects)
    focuses.push_back({object.position_m, std::max(object.size_m.x, object.size_m.y)});
  return focuses;
}

const scene::ObjectMesh& drawn_mesh(const World::State& world, std::size_t object, glm::vec3 p_rel,
                                    const View& view) {
  const auto height_m = static_cast<float>(world.scene.objects[object].size_m.z);
  const float distance_m = std::max(std::sqrt(glm::dot(p_rel, p_rel)), view.near_m);
  const float height_px =
      0.5f * static_cast<float>(view.height_px) * height_m / (distance_m * view.tan_half_y);
  const ObjectMeshes::Choice choice = world.objects.of_object[object];
  return world.objects.meshes[height_px >= kNearHeight_px ? choice.near : choice.far];
}

void drawn_poses(const World::State& world, const ocean::SeaFrame& sea,
                 std::span<scene::ObjectPose> poses) {
  if (poses.empty()) return;
  scene::object_poses(world.scene.objects, water_surface(world, sea), poses);
  if (world.scene.detail.triangulation == scene::Triangulation::kPlane)
    for (scene::ObjectPose& pose : poses) pose.position_world.z = 0.0;
}

void place_objects(const World::State& world, const SeaMaps& sea, const View& view, Meshes& meshes,
                   FrameViews views) {
  const std::vector<scene::FloatingObject>& objects = world.scene.objects;
  ObjectGeometry& geometry = meshes.objects;
  clear_geometry(geometry);
  geometry.poses.resize(objects.size());
  geometry.meshes.resize(objects.size(), nullptr);
  drawn_poses(world, sea.frame, geometry.poses);

  geometry.instances.reserve(objects.size());  // primitives point into it
  const std::array<glm::vec4, 5> planes = frustum_planes(view);
  const bool submerged =
      std::ranges::any_of(views, [](const RenderView* view) { return view->eye.submerged; });
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Placement placement = placement_of(objects[i], geometry.poses[i], view);
    // Through the surface an eye under water sees them far from where they are.
    if (!submerged && !in_view(objects[i], placement, views.front()->drop_per_m2, planes)) continue;
    const scene::ObjectMesh& mesh = drawn_mesh(world, i, placement.bottom_rel, view);
    geometry.meshes[i] = &mesh;
    geometry.instances.push_back(instance_of(objects[i], geometry.poses[i], placement));
    geometry.instances.back().object = static_cast<std::uint32_t>(i);
    geometry.parts.push_back({static_cast<std::uint32_t>(geometry.primitives.size()),
                              static_cast<std::uint32_t>(mesh.triangles.size()),
                              static_cast<std::uint32_t>(geometry.p_rel.size()),
                              static_cast<std::uint32_t>(mesh.position.size())});
    add_triangles(mesh, geometry.instances.back(),
                  static_cast<std::uint32_t>(geometry.p_rel.size()), geometry);
    add_vertices(mesh, placement, geometry);
  }
  resize_vertices(SurfaceKind::kObjects, geometry.p_rel.size(), views);
  map_vertices(meshes, SurfaceKind::kObjects, 0, geometry.p_rel.size(), views);
}

}  // namespace swell::render
