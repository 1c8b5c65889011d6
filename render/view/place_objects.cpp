// Stage 3: objects, where they are.
#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "ocean/water_surface.h"
#include "render/frame/profile.h"
#include "render/sea/sea_maps.h"
#include "render/view/meshes.h"
#include "render/view/object_levels.h"
#include "render/view/objects_drawn.h"
#include "render/view/refracted_image.h"
#include "render/view/render_view.h"
#include "render/view/surfaces.h"
#include "render/world/object_meshes.h"
#include "render/world/world_state.h"
#include "shapes/implicit_mesh.h"

namespace swell::render {
namespace {

// Less than this of an object in the mirror, or under water, is not drawn there.
constexpr float kSmallestImage_px = 0.5f;
constexpr float kWaveMargin_m = 0.3f;  // of what crosses the level, as in clip_distance()

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

// A ball around an object in the flat world, and between which heights it lies.
struct Bounds {
  glm::vec3 middle_rel;
  float radius_m;
  float lowest_rel_m, highest_rel_m;
};

Bounds bounds_of(const scene::FloatingObject& object, const Placement& placement) {
  const glm::vec3 size(object.size_m);
  const glm::mat3& axes = placement.rel_from_unit;
  const glm::vec3 middle = placement.bottom_rel + 0.5f * axes[2];
  const float half_m = 0.5f * (std::abs(axes[0].z) + std::abs(axes[1].z) + std::abs(axes[2].z));
  return {middle, 0.5f * std::sqrt(glm::dot(size, size)), middle.z - half_m, middle.z + half_m};
}

// What views of one kind are drawn from.
struct DrawnKind {
  ViewKind kind;
  const View& camera;
  std::array<glm::vec4, 5> planes;
  float drop_per_m2, refraction_index;
  bool any_submerged;
};

DrawnKind drawn_kind(FrameViews views) {
  const RenderView& first = *views.front();
  return {first.kind,
          first.camera,
          frustum_planes(first.camera),
          first.drop_per_m2,
          first.refraction_index,
          std::ranges::any_of(views, [](const RenderView* view) { return view->eye.submerged; })};
}

// Whether any of a ball lies between the planes, where a round earth puts it.
bool in_view(const DrawnKind& drawn, glm::vec3 p, float radius_m) {
  p.z -= (p.x * p.x + p.y * p.y) * drawn.drop_per_m2;
  // What is near its middle sinks a little more or less.
  const float reach_m = 1.02f * radius_m;
  return std::ranges::all_of(drawn.planes, [&](const glm::vec4& plane) {
    return glm::dot(glm::vec3(plane), p) + plane.w >= -reach_m;
  });
}

// Whether a view from the air may show any of the object in its mirror.
bool in_mirror(const DrawnKind& drawn, Bounds ball, float waterline_rel_m) {
  if (ball.highest_rel_m < waterline_rel_m - kWaveMargin_m) return false;
  ball.middle_rel.z = 2.0f * waterline_rel_m - ball.middle_rel.z;
  const float px_per_m = most_px_per_m(ball.middle_rel, ball.radius_m, drawn.camera);
  return 2.0f * ball.radius_m * px_per_m >= kSmallestImage_px &&
         in_view(drawn, ball.middle_rel, ball.radius_m);
}

// Whether a view of what lies under water may show any of the object.
bool under_water(const DrawnKind& drawn, const Bounds& ball, float waterline_rel_m) {
  const float deepest_m = waterline_rel_m - ball.lowest_rel_m;
  if (deepest_m < -kWaveMargin_m) return false;
  // Things appear between where they are and the level above, seen at a slant just below it.
  const glm::vec3 p = ball.middle_rel;
  const float nearest_m = std::max(glm::length(glm::vec2(p)) - ball.radius_m, 0.0f);
  const float eye_m = std::max(-waterline_rel_m, kLeastAirHeight_m);
  const float apparent_m =
      apparent_depth_m({eye_m, std::max(deepest_m, 0.0f), nearest_m}, drawn.refraction_index);
  const float reach_m = ball.radius_m + std::abs(p.z - waterline_rel_m);
  if (apparent_m * most_px_per_m(p, reach_m, drawn.camera) < kSmallestImage_px) return false;
  return in_view(drawn, p, reach_m);
}

bool may_show(const DrawnKind& drawn, const scene::FloatingObject& object,
              const Placement& placement) {
  // Through the surface an eye under water sees them far from where they are.
  if (drawn.any_submerged) return true;
  const Bounds ball = bounds_of(object, placement);
  switch (drawn.kind) {
    case ViewKind::kWindow:
      return in_view(drawn, ball.middle_rel, ball.radius_m);
    case ViewKind::kReflection:
      return in_mirror(drawn, ball, placement.waterline_rel_m);
    case ViewKind::kRefraction:
      return under_water(drawn, ball, placement.waterline_rel_m);
  }
  return true;
}

// Calls body(i, first, count) for the pieces of parts that numbers [begin, end) are of, counted
// through all parts: of part i those from its own number `first` on.
template <class First, class Count, class Body>
void for_pieces(const std::vector<DrawPart>& parts, std::size_t begin, std::size_t end,
                First first_of, Count count_of, const Body& body) {
  auto part = std::ranges::upper_bound(parts, begin, {}, first_of) - 1;
  for (; begin < end; ++part) {
    const std::size_t first = begin - (*part).*first_of;
    const std::size_t count = std::min((*part).*count_of - first, end - begin);
    body(static_cast<std::size_t>(part - parts.begin()), first, count);
    begin += count;
  }
}

// Writes vertices [begin, end), counted through all parts.
void write_vertices(const WorldState& world, std::span<const scene::ObjectPose> poses,
                    const View& view, std::size_t begin, std::size_t end, ObjectDraws& out) {
  for_pieces(out.parts, begin, end, &DrawPart::first_vertex, &DrawPart::vertices,
             [&](std::size_t i, std::size_t first, std::size_t count) {
               const ObjectInstance& instance = out.instances[i];
               const Placement placement =
                   placement_of(world.scene.objects[instance.object], poses[instance.object], view);
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

// Writes triangles [begin, end), counted through all parts.
void write_triangles(std::size_t begin, std::size_t end, ObjectDraws& out) {
  for_pieces(out.parts, begin, end, &DrawPart::first_triangle, &DrawPart::triangles,
             [&](std::size_t i, std::size_t first, std::size_t count) {
               const ObjectInstance& instance = out.instances[i];
               const DrawPart& part = out.parts[i];
               const std::size_t at = part.first_triangle + first;
               for (std::size_t k = 0; k < 3 * count; ++k)
                 out.indices[3 * at + k] =
                     part.first_vertex + instance.mesh->indices[3 * first + k];
               for (std::size_t k = 0; k < count; ++k)
                 out.primitives[at + k] = {&instance.mesh->triangles[first + k], &instance};
             });
}

// An implicit surface's shape, in place of triangles.
void take_implicit(const ObjectGeometry& geometry, const shapes::MeshOfFile& shape,
                   ObjectInstance& instance) {
  const scene::ImplicitSurface& implicit = shape.implicit->implicit;
  const auto at = std::ranges::find(geometry.implicit_of, &implicit);
  instance.implicit =
      &geometry.implicits[static_cast<std::size_t>(at - geometry.implicit_of.begin())];
  instance.implicit_size = glm::vec3(implicit.high - implicit.low);
  instance.implicit_base = {0.5 * (implicit.low.x + implicit.high.x),
                            0.5 * (implicit.low.y + implicit.high.y), implicit.low.z};
}

// The scene's implicit surfaces at t_s, one for all objects of a shape.
void pose_implicits(const WorldState& world, double t_s, ObjectGeometry& geometry) {
  geometry.implicit_of.clear();
  for (const ObjectShape& shape : world.objects.of_object) {
    if (!shape->implicit || std::ranges::find(geometry.implicit_of, &shape->implicit->implicit) !=
                                geometry.implicit_of.end())
      continue;
    geometry.implicit_of.push_back(&shape->implicit->implicit);
    const std::size_t count = geometry.implicit_of.size();
    if (geometry.stand_ins.size() < count) geometry.stand_ins.resize(count);
    if (!shape->implicit->moving.empty())
      shapes::pose_stand_in(*shape, t_s, geometry.stand_ins[count - 1]);
  }
  if (geometry.implicits.size() < geometry.implicit_of.size())
    geometry.implicits.resize(geometry.implicit_of.size());
  for (std::size_t i = 0; i < geometry.implicit_of.size(); ++i)
    pose_implicit(*geometry.implicit_of[i], t_s, geometry.implicits[i]);
}

// Which objects the views may show, and where what they are drawn with goes.
void list_instances(const WorldState& world, const DrawnKind& drawn, const ObjectGeometry& geometry,
                    ObjectDraws& draws) {
  const std::vector<scene::FloatingObject>& objects = world.scene.objects;
  draws.instances.clear();
  draws.instances.reserve(objects.size());  // primitives point into it
  draws.parts.clear();
  DrawPart part;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Placement placement = placement_of(objects[i], geometry.poses[i], drawn.camera);
    if (!may_show(drawn, objects[i], placement)) continue;
    const Bounds ball = bounds_of(objects[i], placement);
    const float px_per_m = most_px_per_m(ball.middle_rel, ball.radius_m, drawn.camera);
    const shapes::MeshOfFile& shape = *world.objects.of_object[i];
    if (shape.implicit && !geometry.draws_implicits) continue;
    const shapes::ObjectMesh& mesh = shape.implicit
                                         ? shape.implicit->mesh
                                         : coarsest_mesh(world, i, kMostLevelError_px / px_per_m);
    draws.instances.push_back(instance_of(objects[i], geometry.poses[i], placement));
    if (shape.implicit) take_implicit(geometry, shape, draws.instances.back());
    draws.instances.back().object = static_cast<std::uint32_t>(i);
    draws.instances.back().mesh = &mesh;
    part.first_triangle += part.triangles;
    part.first_vertex += part.vertices;
    part.triangles = static_cast<std::uint32_t>(mesh.triangles.size());
    part.vertices = static_cast<std::uint32_t>(mesh.position.size());
    part.is_cast = shape.implicit != nullptr;
    draws.parts.push_back(part);
  }
  const std::size_t triangles = part.first_triangle + part.triangles;
  const std::size_t vertices = part.first_vertex + part.vertices;
  draws.primitives.resize(triangles);
  draws.indices.resize(3 * triangles);
  draws.p_rel.resize(vertices);
  draws.waterline_rel_m.resize(vertices);
}

// The objects of views of one kind.
void place_in_views(const WorldState& world, Meshes& meshes, FrameViews views,
                    const StageRun& run) {
  const DrawnKind drawn = drawn_kind(views);
  ObjectDraws& draws = meshes.objects.drawn_in(drawn.kind);
  list_instances(world, drawn, meshes.objects, draws);
  resize_vertices(SurfaceKind::kObjects, draws.p_rel.size(), views);
  const auto for_chunks = [&](std::size_t count, auto&& body) {
    run.for_each((count + kVertexChunk - 1) / kVertexChunk, [&](std::size_t chunk, int) {
      body(chunk * kVertexChunk, std::min(count, (chunk + 1) * kVertexChunk));
    });
  };
  for_chunks(draws.p_rel.size(), [&](std::size_t begin, std::size_t end) {
    write_vertices(world, meshes.objects.poses, drawn.camera, begin, end, draws);
    map_vertices(meshes, SurfaceKind::kObjects, begin, end, views);
  });
  for_chunks(draws.primitives.size(),
             [&](std::size_t begin, std::size_t end) { write_triangles(begin, end, draws); });
}

}  // namespace

void drawn_poses(const WorldState& world, const ocean::SeaFrame& sea,
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

void place_objects(const WorldState& world, const SeaMaps& sea,
                   std::span<const scene::GivenPose> given, Meshes& meshes, FrameViews views,
                   const StageRun& run) {
  ObjectGeometry& geometry = meshes.objects;
  geometry.poses.resize(world.scene.objects.size());
  drawn_poses(world, sea.frame, given, geometry.poses, run);
  pose_implicits(world, sea.frame.t_s, geometry);
  for (const ViewKind kind : kAllViewKinds) {
    const ViewsOfKind of_kind(views, kind);
    // Without water there are no images.
    if (of_kind.all().empty())
      geometry.drawn_in(kind) = {};
    else
      place_in_views(world, meshes, of_kind.all(), run);
  }
  geometry.meshes.assign(geometry.poses.size(), nullptr);
  for (const ObjectInstance& instance : geometry.in_window().instances)
    geometry.meshes[instance.object] =
        instance.implicit ? &outline_mesh(world, geometry, instance.object, 0.0f) : instance.mesh;
}

}  // namespace swell::render
