#include "render/picture/label_tables.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/frame/profile.h"
#include "render/sea/sea_maps.h"
#include "render/view/draw_record.h"
#include "render/view/implicits.h"
#include "render/view/meshes.h"
#include "render/view/objects_drawn.h"
#include "render/view/trees_drawn.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

constexpr std::size_t kTaskSize = kVertexChunk;  // vertices or triangles a task

template <class Body>
void for_chunks(std::size_t count, const StageRun& run, const Body& body) {
  run.for_each((count + kTaskSize - 1) / kTaskSize, [&](std::size_t chunk, int) {
    body(chunk * kTaskSize, std::min(count, (chunk + 1) * kTaskSize));
  });
}

// What a table by primitive has of a surface.
template <class T>
std::span<T> of_surface(std::vector<T>& table, const PrimitiveRanges& primitives,
                        SurfaceKind kind) {
  return std::span(table).subspan(primitives.begin(kind),
                                  primitives.end(kind) - primitives.begin(kind));
}

// --- Numbers

// The numbers of water, land, object n of the scene and tree n of the world.
template <class OfObject, class OfTree>
void fill_numbers(const LabelInputs& in, std::uint32_t water, std::uint32_t land,
                  const OfObject& of_object, const OfTree& of_tree,
                  std::vector<std::uint32_t>& numbers) {
  const PrimitiveRanges& primitives = in.window.primitives;
  numbers.assign(primitives.count(), land);
  for (const SurfaceKind kind : kAllSurfaces)
    if (kSurfaceTraits[kind].is_water)
      std::ranges::fill(of_surface(numbers, primitives, kind), water);
  if (!primitives.empty(SurfaceKind::kObjects)) {
    const ObjectDraws& draws = in.meshes.objects.in_window();
    const auto objects = of_surface(numbers, primitives, SurfaceKind::kObjects);
    for (std::size_t i = 0; i < draws.parts.size(); ++i)
      std::ranges::fill(objects.subspan(draws.parts[i].first_triangle, draws.parts[i].triangles),
                        of_object(draws.instances[i].object));
  }
  const TreeDraws& trees = in.meshes.trees.drawn_in(ViewKind::kWindow);
  const auto of_trees = of_surface(numbers, primitives, SurfaceKind::kTrees);
  for (std::size_t i = 0; i < of_trees.size(); ++i) of_trees[i] = of_tree(trees.tree_of(i).tree);
}

void fill_ids(const LabelInputs& in, LabelTables& tables) {
  fill_numbers(
      in, kWaterId, kLandId, [](std::uint32_t object) { return kFirstObjectId + object; },
      [](std::uint32_t tree) { return kFirstTreeId + tree; }, tables.id);
}

void fill_classes(const LabelInputs& in, LabelTables& tables) {
  fill_numbers(
      in, kWaterClass, kTerrainClass,
      [&](std::uint32_t object) { return in.world.object_classes[object]; },
      [&](std::uint32_t) { return in.world.tree_class; }, tables.klass);
}

// --- Normals

// Returns the normal on the side of the triangle that the eye is on. A triangle without an area
// stands for an implicit surface, whose normal the shader knows.
glm::vec3 seen_normal(const std::array<glm::vec3, 3>& p_rel) {
  const glm::vec3 n = glm::cross(p_rel[1] - p_rel[0], p_rel[2] - p_rel[0]);
  const float length = std::sqrt(glm::dot(n, n));
  if (!(length > 0.0f)) return {0.0f, 0.0f, 0.0f};
  return n * ((glm::dot(n, p_rel[0]) > 0.0f ? -1.0f : 1.0f) / length);
}

template <class Place>
void fill_normals(std::span<const std::uint32_t> indices, std::span<glm::vec3> normal,
                  const StageRun& run, const Place& place) {
  for_chunks(normal.size(), run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      normal[i] = seen_normal(
          {place(indices[3 * i]), place(indices[3 * i + 1]), place(indices[3 * i + 2])});
  });
}

void fill_normals(const LabelInputs& in, LabelTables& tables, const StageRun& run) {
  const PrimitiveRanges& primitives = in.window.primitives;
  tables.normal.resize(primitives.count());
  for (const SurfaceKind kind : kAllSurfaces) {
    const std::span<glm::vec3> normal = of_surface(tables.normal, primitives, kind);
    const auto indices = in.window.draws[kind].indices;
    if (indices.empty()) {
      std::ranges::fill(normal, glm::vec3(0.0f));
      continue;
    }
    visit_points(in.meshes, kind, in.window, [&](const auto& point) {
      fill_normals(indices, normal, run, [&](std::uint32_t i) { return point(i).p_rel; });
    });
  }
}

// --- Motion

// Homogeneous points in pixels, from points relative to the eye; x and y from the picture's middle.
glm::dmat3 pixels_from_rel(const View& view) {
  const glm::dvec3 right(view.right), up(view.up), forward(view.forward);
  const double x_px = 0.5 * view.width_px / view.tan_half_x;
  const double y_px = 0.5 * view.height_px / view.tan_half_y;
  const double middle_x = view.tan_middle_x, middle_y = view.tan_middle_y;
  return glm::transpose(glm::dmat3(  // rows
      x_px * (right - middle_x * forward), -y_px * (up - middle_y * forward), forward));
}

using AffineMap = glm::dmat4x3;

AffineMap affine_map(const glm::dmat3& turn, glm::dvec3 shift) {
  return {turn[0], turn[1], turn[2], shift};
}

// How a triangle moves whose corners move so: as its plane does, and not with the height over it.
AffineMove move_of_triangle(const std::array<glm::dvec3, 3>& p_rel,
                            const std::array<glm::dvec3, 3>& move) {
  const glm::dvec3 a = p_rel[1] - p_rel[0], b = p_rel[2] - p_rel[0], normal = glm::cross(a, b);
  const double area2 = glm::dot(normal, normal);
  if (!(area2 > 0.0)) return AffineMove(affine_map(glm::dmat3(0.0), move[0]));
  const glm::dmat3 turn = glm::outerProduct((move[1] - move[0]) / area2, glm::cross(b, normal)) +
                          glm::outerProduct((move[2] - move[0]) / area2, glm::cross(normal, a));
  return AffineMove(affine_map(turn, move[0] - turn * p_rel[0]));
}

// From how far the surface's vertices move.
void fill_moves(const LabelInputs& in, SurfaceKind kind, std::span<const glm::vec3> vertex_move,
                std::span<AffineMove> moves, const StageRun& run) {
  const std::span<const std::uint32_t> indices = in.window.draws[kind].indices;
  visit_points(in.meshes, kind, in.window, [&](const auto& point) {
    for_chunks(moves.size(), run, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        std::array<glm::dvec3, 3> p_rel, move;
        for (std::size_t k = 0; k < 3; ++k) {
          const std::uint32_t vertex = indices[3 * i + k];
          p_rel[k] = point(vertex).p_rel;
          move[k] = vertex_move[vertex];
        }
        moves[i] = move_of_triangle(p_rel, move);
      }
    });
  });
}

void fill_sea_moves(const LabelInputs& in, std::span<AffineMove> moves, LabelTables& tables,
                    const StageRun& run) {
  const Surface& water = in.meshes.water;
  const WaterHeights heights{in.world, tables.next_sea, in.window.camera,
                             static_cast<float>(in.options.background_error_px)};
  tables.next_height_m.resize(water.height_m.size());
  tables.vertex_move.resize(water.height_m.size());
  for_chunks(water.height_m.size(), run, [&](std::size_t begin, std::size_t end) {
    water_heights(heights, water, begin, end, tables.next_height_m);
    for (std::size_t i = begin; i < end; ++i)
      tables.vertex_move[i] = {0.0f, 0.0f, tables.next_height_m[i] - water.height_m[i]};
  });
  fill_moves(in, SurfaceKind::kWater, tables.vertex_move, moves, run);
}

void fill_tree_moves(const LabelInputs& in, std::span<AffineMove> moves, LabelTables& tables,
                     const StageRun& run) {
  const TreeDraws& trees = in.meshes.trees.drawn_in(ViewKind::kWindow);
  tables.vertex_move.resize(trees.p_rel.size());
  find_tree_moves(in.world, trees, in.t_s + in.options.next_frame_s, tables.vertex_move, run);
  fill_moves(in, SurfaceKind::kTrees, tables.vertex_move, moves, run);
}

// How the points of a rigid object move.
AffineMap move_of_object(const scene::ObjectPose& now, const scene::ObjectPose& next,
                         glm::dvec3 eye_world) {
  const glm::dmat3 turn =
      (next.world_from_object - now.world_from_object) * glm::transpose(now.world_from_object);
  const glm::dvec3 shift = next.position_world - now.position_world;
  return affine_map(turn, shift - turn * (now.position_world - eye_world));
}

// How points move that `first` moves, then `second`.
AffineMap move_by_both(const AffineMap& first, const AffineMap& second) {
  const glm::dmat3 turn(second);
  return first + second + turn * first;
}

void fill_object_moves(const LabelInputs& in, std::span<AffineMove> moves, LabelTables& tables,
                       const StageRun& run) {
  const std::vector<scene::ObjectPose>& poses = in.meshes.objects.poses;
  const ObjectDraws& draws = in.meshes.objects.in_window();
  tables.next_poses.resize(poses.size());
  drawn_poses(in.world, tables.next_sea, in.options.next_poses, tables.next_poses, run);
  for (std::size_t i = 0; i < draws.parts.size(); ++i) {
    const ObjectInstance& instance = draws.instances[i];
    const auto [first, count] = std::pair(draws.parts[i].first_triangle, draws.parts[i].triangles);
    const AffineMap move = move_of_object(
        poses[instance.object], tables.next_poses[instance.object], in.window.camera.eye_world);
    std::ranges::fill(moves.subspan(first, count), AffineMove(move));
    if (!instance.implicit) continue;
    for (std::uint32_t part = 0; part < count; ++part)
      if (const auto turning = part_move(instance, part, in.options.next_frame_s))
        moves[first + part] = AffineMove(move_by_both(*turning, move));
  }
}

void fill_motion(const LabelInputs& in, LabelTables& tables, const StageRun& run) {
  const View& now = in.window.camera;
  const PrimitiveRanges& primitives = in.window.primitives;
  tables.camera = camera_motion(now, in.options.next_view.value_or(now));
  advance_waves(in.world, in.t_s + in.options.next_frame_s, in.options.disturbances,
                in.options.without, tables.next_sea, run.workers);
  tables.move.assign(primitives.count(), AffineMove(0.0f));
  const auto fill = [&](SurfaceKind kind, const auto& fill_its) {
    if (!primitives.empty(kind))
      fill_its(in, of_surface(tables.move, primitives, kind), tables, run);
  };
  fill(SurfaceKind::kWater, fill_sea_moves);
  fill(SurfaceKind::kObjects, fill_object_moves);
  fill(SurfaceKind::kTrees, fill_tree_moves);
}

}  // namespace

CameraMotion camera_motion(const View& now, const View& next) {
  const glm::dmat3 from_now = pixels_from_rel(now), from_next = pixels_from_rel(next);
  const glm::dmat3 turn = (from_next - from_now) * glm::inverse(from_now);
  return {glm::mat3(turn), glm::mat3(from_next),
          glm::vec3(from_next * (now.eye_world - next.eye_world))};
}

void fill_label_tables(const LabelInputs& in, LabelTables& tables, const StageRun& run) {
  tables.set = in.options.labels;
  tables.eye_world = in.window.camera.eye_world;
  const auto has = [&](Label label) { return tables.set.has(label); };
  const bool has_implicits = !in.window.implicits.implicits.empty();
  tables.from_shading = has(Label::kNormal) || has(Label::kFlags) ||
                        (has_implicits && has(Label::kGeometricNormal)) || has(Label::kFoam) ||
                        has(Label::kClass);
  if (has(Label::kId)) fill_ids(in, tables);
  if (has(Label::kClass)) fill_classes(in, tables);
  if (has(Label::kGeometricNormal)) fill_normals(in, tables, run);
  if (has(Label::kMotion)) fill_motion(in, tables, run);
}

}  // namespace swell::render
