#include "render/view/crossing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "render/frame/profile.h"
#include "render/view/meshes.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

constexpr int kStep = Crossing::kStep_px;

// How far from the eye the near plane's corners are, at most.
float reach_of_near_plane(const View& view) {
  float reach = 0.0f;
  for (const float x : {0.0f, static_cast<float>(view.width_px + kStep)})
    for (const float y : {0.0f, static_cast<float>(view.height_px + kStep)})
      reach = std::max(reach, glm::length(view.ray(x, y)));
  return view.near_m * reach;
}

struct Box {
  glm::vec2 low, high;
};

// What of the plane lies under or over the picture's near plane, relative to the eye.
Box box_of_near_plane(const View& view) {
  Box box{glm::vec2(1e30f), glm::vec2(-1e30f)};
  const auto width = static_cast<float>(view.width_px + kStep);
  const auto height = static_cast<float>(view.height_px + kStep);
  for (const float x : {0.0f, width})
    for (const float y : {0.0f, height}) {
      const glm::vec2 p(view.near_m * view.ray(x, y));
      box.low = glm::min(box.low, p);
      box.high = glm::max(box.high, p);
    }
  return box;
}

void list_triangles(const Surface& water, const Box& box, std::vector<int>& triangles) {
  triangles.clear();
  const std::span<const std::uint32_t> indices = water.mesh.indices;
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    const glm::vec2 a = water.offset[indices[i]], b = water.offset[indices[i + 1]],
                    c = water.offset[indices[i + 2]];
    const glm::vec2 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
    if (low.x <= box.high.x && low.y <= box.high.y && high.x >= box.low.x && high.y >= box.low.y)
      triangles.push_back(static_cast<int>(i));
  }
}

float cross(glm::vec2 a, glm::vec2 b) { return a.x * b.y - a.y * b.x; }

// The height of the triangle that holds p, or of the one that misses it least.
float height_at(const Surface& water, std::span<const int> triangles, glm::vec2 p) {
  float best = -1e30f, height_m = 0.0f;
  for (const int i : triangles) {
    std::array<glm::vec2, 3> at;
    std::array<float, 3> z;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t vertex = water.mesh.indices[static_cast<std::size_t>(i) + k];
      at[k] = water.offset[vertex];
      z[k] = water.height_m[vertex];
    }
    const float area = cross(at[1] - at[0], at[2] - at[0]);
    if (area == 0.0f) continue;
    const float w1 = cross(p - at[0], at[2] - at[0]) / area;
    const float w2 = cross(at[1] - at[0], p - at[0]) / area;
    const float least = std::min({w1, w2, 1.0f - w1 - w2});
    if (least <= best) continue;
    best = least;
    height_m = z[0] + w1 * (z[1] - z[0]) + w2 * (z[2] - z[0]);
  }
  return height_m;
}

// Whether any of the triangles reaches up or down to the near plane.
bool may_cross(const Surface& water, const View& view, std::span<const int> triangles) {
  float lowest = 1e30f, highest = -1e30f;
  for (const int i : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const float z = water.height_m[water.mesh.indices[static_cast<std::size_t>(i) + k]];
      lowest = std::min(lowest, z);
      highest = std::max(highest, z);
    }
  const auto eye_z = static_cast<float>(view.eye_world.z);
  const float reach_m = reach_of_near_plane(view);
  return eye_z - reach_m <= highest && eye_z + reach_m >= lowest;
}

// surface_m(p): the water's height at p from the eye.
template <class Height>
void find_nodes(const View& view, const Height& surface_m, Crossing& line) {
  line.columns = (view.width_px - 1) / kStep + 2;
  const int rows = (view.height_px - 1) / kStep + 2;
  line.above_m.resize(static_cast<std::size_t>(line.columns) * rows);
  const auto eye_z = static_cast<float>(view.eye_world.z);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < line.columns; ++column) {
      const glm::vec3 p = view.near_m * view.ray(static_cast<float>(column * kStep),
                                                 static_cast<float>(row * kStep));
      line.above_m[static_cast<std::size_t>(row) * line.columns + column] =
          p.z + eye_z - surface_m(glm::vec2(p));
    }
}

Begins begins_of(float least, float most) {
  return least >= 0.0f ? Begins::kInAir : most < 0.0f ? Begins::kInWater : Begins::kInBoth;
}

}  // namespace

Begins Crossing::begins(const raster::PixelBox& box) const {
  float least = 1e30f, most = -1e30f;
  for (int row = box.y0_px / kStep; row <= (box.y0_px + box.height_px - 1) / kStep + 1; ++row)
    for (int c = box.x0_px / kStep; c <= (box.x0_px + box.width_px - 1) / kStep + 1; ++c) {
      const float above = above_m[static_cast<std::size_t>(row) * columns + c];
      least = std::min(least, above);
      most = std::max(most, above);
    }
  return begins_of(least, most);
}

float Crossing::above(int x_px, int y_px) const {
  const int column = x_px / kStep, row = y_px / kStep;
  const float right = (static_cast<float>(x_px - column * kStep) + 0.5f) / kStep;
  const float down = (static_cast<float>(y_px - row * kStep) + 0.5f) / kStep;
  const float* const upper = above_m.data() + static_cast<std::size_t>(row) * columns + column;
  const float* const lower = upper + columns;
  const float top = upper[0] + right * (upper[1] - upper[0]);
  const float bottom = lower[0] + right * (lower[1] - lower[0]);
  return top + down * (bottom - top);
}

// How much the height changes from pixel to pixel in the cell under and right of a node.
float Crossing::per_px(const float* upper) const {
  const float* const lower = upper + columns;
  const glm::vec2 gradient(upper[1] - upper[0] + lower[1] - lower[0],
                           lower[0] - upper[0] + lower[1] - upper[1]);
  return std::max(glm::length(gradient) * (0.5f / kStep), 1e-9f);
}

float Crossing::rows_away(int x_px, int y_px) const {
  const std::size_t node = static_cast<std::size_t>(y_px / kStep) * columns + x_px / kStep;
  return std::abs(above(x_px, y_px)) / per_px(above_m.data() + node);
}

float Crossing::least_rows_away(int x_px, int y_px) const {
  const std::size_t node = static_cast<std::size_t>(y_px / kStep) * columns + x_px / kStep;
  const float *const upper = above_m.data() + node, *const lower = upper + columns;
  const auto [least, most] = std::minmax({upper[0], upper[1], lower[0], lower[1]});
  return std::max({least, -most, 0.0f}) / per_px(upper);
}

void find_crossing(const Surface& sea, const View& view, const WaterAtEye& water,
                   float most_height_m, Crossing& line) {
  line.picture = water.submerged ? Begins::kInWater : Begins::kInAir;
  const auto eye_z = static_cast<float>(view.eye_world.z);
  const float reach_m = reach_of_near_plane(view);
  if (water.is_inland) {
    const float level_m = water.in_water.level_m;
    if (std::abs(eye_z - level_m) > reach_m) return;
    find_nodes(
        view, [&](glm::vec2) { return level_m; }, line);
  } else {
    if (std::abs(eye_z) > most_height_m + reach_m) return;
    list_triangles(sea, box_of_near_plane(view), line.near_water);
    if (!may_cross(sea, view, line.near_water)) return;
    find_nodes(
        view, [&](glm::vec2 p) { return height_at(sea, line.near_water, p); }, line);
  }
  const auto [least, most] = std::minmax_element(line.above_m.begin(), line.above_m.end());
  line.picture = begins_of(*least, *most);
}

void map_land(const Meshes& meshes, FrameViews views, const StageRun& run) {
  const std::size_t count = meshes.land.offset.size();
  if (meshes.land.mesh.indices.empty()) return;
  resize_vertices(SurfaceKind::kTerrain, count, views);
  run.for_each((count + kVertexChunk - 1) / kVertexChunk, [&](std::size_t chunk, int) {
    const std::size_t begin = chunk * kVertexChunk;
    map_vertices(meshes, SurfaceKind::kTerrain, begin, std::min(count, begin + kVertexChunk),
                 views);
  });
}

}  // namespace swell::render
