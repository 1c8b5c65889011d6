#include "render/labels/label_tables.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/view/surface_points.h"

namespace swell::render {
namespace {

constexpr std::size_t kTaskSize = kVertexChunk;  // vertices or triangles a task

template <class Body>
void for_chunks(std::size_t count, const StageRun& run, const Body& body) {
  run.for_each((count + kTaskSize - 1) / kTaskSize, [&](std::size_t chunk, int) {
    body(chunk * kTaskSize, std::min(count, (chunk + 1) * kTaskSize));
  });
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
    const auto normal =
        std::span(tables.normal)
            .subspan(primitives.begin(kind), primitives.end(kind) - primitives.begin(kind));
    const auto indices = in.meshes.indices(kind);
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

// The plane through what the triangle's vertices rise by.
glm::vec3 rise_of(const std::array<glm::dvec2, 3>& p, const std::array<double, 3>& rise_m) {
  const glm::dvec2 a = p[1] - p[0], b = p[2] - p[0];
  const double da = rise_m[1] - rise_m[0], db = rise_m[2] - rise_m[0];
  const double area = a.x * b.y - a.y * b.x;
  if (area == 0.0) return {static_cast<float>(rise_m[0]), 0.0f, 0.0f};
  const glm::dvec2 slope((da * b.y - db * a.y) / area, (db * a.x - da * b.x) / area);
  return glm::vec3(rise_m[0] - glm::dot(slope, p[0]), slope.x, slope.y);
}

void fill_rise(const LabelInputs& in, LabelTables& tables, const StageRun& run) {
  const Surface& water = in.meshes.water;
  const WaterHeights heights{in.world, tables.next_sea, in.window.camera,
                             static_cast<float>(in.options.background_error_px)};
  tables.next_height_m.resize(water.height_m.size());
  tables.rise.resize(water.mesh.indices.size() / 3);
  for_chunks(tables.next_height_m.size(), run, [&](std::size_t begin, std::size_t end) {
    water_heights(heights, water, begin, end, tables.next_height_m);
  });
  for_chunks(tables.rise.size(), run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      std::array<glm::dvec2, 3> p;
      std::array<double, 3> rise_m;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = water.mesh.indices[3 * i + k];
        p[k] = water.offset[v];
        rise_m[k] = static_cast<double>(tables.next_height_m[v]) - water.height_m[v];
      }
      tables.rise[i] = rise_of(p, rise_m);
    }
  });
}

ObjectMotion motion_of(const scene::ObjectPose& now, const scene::ObjectPose& next,
                       glm::dvec3 eye_world) {
  const glm::dmat3 turn =
      (next.world_from_object - now.world_from_object) * glm::transpose(now.world_from_object);
  return {glm::mat3(turn), glm::vec3(now.position_world - eye_world),
          glm::vec3(next.position_world - now.position_world)};
}

void fill_motion(const LabelInputs& in, LabelTables& tables, const StageRun& run) {
  const View& now = in.window.camera;
  tables.step_s = in.options.next_frame_s;
  tables.camera = camera_motion(now, in.options.next_view.value_or(now));
  advance_waves(in.world, in.t_s + in.options.next_frame_s, in.options.disturbances,
                in.options.without, tables.next_sea, run.workers);
  fill_rise(in, tables, run);

  const std::vector<scene::ObjectPose>& poses = in.meshes.objects.poses;
  tables.next_poses.resize(poses.size());
  tables.object_motion.resize(poses.size());
  drawn_poses(in.world, tables.next_sea, in.options.next_poses, tables.next_poses, run);
  for (std::size_t i = 0; i < poses.size(); ++i)
    tables.object_motion[i] = motion_of(poses[i], tables.next_poses[i], now.eye_world);

  const TreeDraws& trees = in.meshes.trees.drawn_in(ViewKind::kWindow);
  tables.tree_move.resize(trees.p_rel.size());
  if (!trees.p_rel.empty())
    find_tree_moves(in.world, trees, in.t_s + in.options.next_frame_s, tables.tree_move, run);
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
  if (has(Label::kGeometricNormal)) fill_normals(in, tables, run);
  if (has(Label::kMotion)) fill_motion(in, tables, run);
}

}  // namespace swell::render
