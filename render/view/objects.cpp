// Floating objects: where the sea carries them, and their vertices in the frame's three views.
#include <algorithm>
#include <cmath>

#include "render/workspace.h"

namespace swell::render {
namespace {

constexpr int kNearSegments = 24, kFarSegments = 8;
constexpr float kNearHeight_px = 24.0f;  // objects at least this high are drawn with many triangles

// Waves lift and lower the waterline: keep a little of the other side in both images.
constexpr float kClipMargin_m = 0.3f;

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
bool in_view(const scene::FloatingObject& object, const Placement& placement,
             const std::array<glm::vec4, 5>& planes) {
  const glm::vec3 size(object.size_m);
  const float radius = std::sqrt(0.25f * (size.x * size.x + size.y * size.y) + size.z * size.z);
  const glm::vec3 centre = placement.bottom_rel;
  // The bottom lies within a height of the waterline; so does all of both images.
  const float reach = 2.0f * radius;
  return std::ranges::all_of(planes, [&](const glm::vec4& plane) {
    return glm::dot(glm::vec3(plane), centre) + plane.w >= -reach;
  });
}

float height_px(const scene::FloatingObject& object, const Placement& placement, const View& view) {
  const glm::vec3 p = placement.bottom_rel;
  const float distance_m = std::max(std::sqrt(glm::dot(p, p)), view.near_m);
  return 0.5f * static_cast<float>(view.height_px) * static_cast<float>(object.size_m.z) /
         (distance_m * view.tan_half_y);
}

// Each object is mirrored in, and squeezed towards, the level of its own waterline, so that its
// images meet it there on any wave.
void add_vertices(const Frame& frame, const scene::ObjectMesh& mesh, const Placement& placement) {
  ObjectGeometry& out = frame.ws.objects;
  const float level = placement.waterline_rel_m;
  const auto n = static_cast<float>(frame.world.scene.water.refraction_index);
  const auto to_clip = [&](glm::vec3 p) { return frame.view.clip_from_rel * glm::vec4(p, 1.0f); };
  for (const glm::vec3& q : mesh.position) {
    const glm::vec3 p = placement.rel_from_unit * q + placement.bottom_rel;
    const float above = p.z - level;
    const float apparent = above < 0.0f ? above * squeeze(p, n) : above;
    out.p_clip.push_back(to_clip(p));
    out.mirrored.push_back(to_clip({p.x, p.y, level - above}));
    out.squeezed.push_back(to_clip({p.x, p.y, level + apparent}));
    out.above_water.push_back(kClipMargin_m + above);
    out.below_water.push_back(kClipMargin_m - above);
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
  geometry.primitives.clear();
  geometry.indices.clear();
  geometry.p_clip.clear();
  geometry.mirrored.clear();
  geometry.squeezed.clear();
  geometry.above_water.clear();
  geometry.below_water.clear();
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

void place_objects(Frame& frame) {
  const std::vector<scene::FloatingObject>& objects = frame.world.scene.objects;
  ObjectGeometry& geometry = frame.ws.objects;
  clear_geometry(geometry);
  if (objects.empty()) return;
  geometry.poses.resize(objects.size());
  geometry.meshes.resize(objects.size(), nullptr);
  scene::object_poses(objects, water_surface(frame), geometry.poses);
  if (frame.world.scene.detail.triangulation == scene::Triangulation::kPlane)
    for (scene::ObjectPose& pose : geometry.poses) pose.position_world.z = 0.0;  // as it is drawn

  geometry.instances.reserve(objects.size());  // primitives point into it
  const std::array<glm::vec4, 5> planes = frustum_planes(frame.view);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Placement placement = placement_of(objects[i], geometry.poses[i], frame.view);
    if (!in_view(objects[i], placement, planes)) continue;
    const ObjectMeshes::Choice choice = frame.world.objects.of_object[i];
    const bool near = height_px(objects[i], placement, frame.view) >= kNearHeight_px;
    const scene::ObjectMesh& mesh = frame.world.objects.meshes[near ? choice.near : choice.far];
    geometry.meshes[i] = &mesh;
    geometry.instances.push_back(instance_of(objects[i], geometry.poses[i], placement));
    add_triangles(mesh, geometry.instances.back(),
                  static_cast<std::uint32_t>(geometry.p_clip.size()), geometry);
    add_vertices(frame, mesh, placement);
  }
}

}  // namespace swell::render
