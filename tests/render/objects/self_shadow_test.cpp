// Shadows of objects on themselves, and levels of detail on a flight.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "math/elementary.h"
#include "mesh_import/mesh_files.h"
#include "render/measure/pick.h"
#include "render/measures.h"
#include "render/shadows/self_shadows.h"
#include "render/shot.h"
#include "scene/scene.h"
#include "sky/sky_light.h"

namespace swell::render {
namespace {

constexpr int kWidth_px = 160, kHeight_px = 120;

FrameOptions linear(PartSet without = {}) {
  return {.water_triangles = 2000, .keep_linear = true, .edge_samples = 0, .without = without};
}

// A mesh on a flat sea, the sun in the east.
scene::Scene scene_of(const std::string& name, const LooseTriangles& triangles,
                      double elevation_deg) {
  const std::filesystem::path file = mesh_folder("own_shadow") / (name + ".stl");
  write_stl(file, triangles);
  scene::Scene scene;
  scene.sea.wind_speed_mps = 0.0;
  scene.water.bump_strength = 0.0;
  scene.sky.cloud_cover = 0.0;
  scene.sky.sun_azimuth_rad = radians(90.0);
  scene.sky.sun_elevation_rad = radians(elevation_deg);
  scene.sky.sun_direction =
      sky::sun_direction(scene.sky.sun_azimuth_rad, scene.sky.sun_elevation_rad);
  scene::FloatingObject object = scene::common_object(scene::ObjectKind::kMesh);
  object.file = file.string();
  object.motion = scene::Motion::kFixed;
  object.height_m = 2.0;
  object.draught = 0.0;
  object.colour = glm::vec3(0.5f);
  object.roughness = 1.0;
  scene.objects = {object};
  return scene;
}

void append_box(glm::vec3 low, glm::vec3 high, LooseTriangles& to) {
  const LooseTriangles box = box_triangles(low, high);
  to.corners.insert(to.corners.end(), box.corners.begin(), box.corners.end());
}

// A plate of 24 x 24 m, 1 m thick, with a wall 4 m high and 1 m thick across its middle.
LooseTriangles plate_with_wall() {
  LooseTriangles mesh;
  append_box({-12, -12, 0}, {12, 12, 1}, mesh);
  append_box({-0.5f, -12, 1}, {0.5f, 12, 5}, mesh);
  return mesh;
}

// A closed surface of points from a pole, row 0, to the other, row `rows`; twice as many in a row.
template <class Point>
LooseTriangles closed_mesh(int rows, const Point& point) {
  LooseTriangles mesh;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < 2 * rows; ++j) {
      const glm::vec3 a = point(i, j), b = point(i + 1, j), c = point(i + 1, j + 1),
                      d = point(i, j + 1);
      if (i < rows - 1) mesh.corners.insert(mesh.corners.end(), {a, b, c});
      if (i > 0) mesh.corners.insert(mesh.corners.end(), {a, c, d});
    }
  return mesh;
}

TEST(SelfShadow, AWallShadesThePlateThatItStandsOn) {
  for (const double elevation_deg : {30.0, 60.0}) {
    const World world = world_of(scene_of("wall", plate_with_wall(), elevation_deg));
    const View view =
        make_view({0.0, 0.0, 60.0}, 0.0, -0.5 * kPi, radians(26.0), 0.25f, kWidth_px, kHeight_px);
    const Shot with(world, view, 1.0, linear());
    const Shot without(world, view, 1.0, linear({Part::kSelfShadows}));
    const double shadow_m = 4.0 / std::tan(radians(elevation_deg));
    PickScratch scratch;
    int shaded = 0, lit = 0;
    for (int y = 0; y < kHeight_px; y += 3)
      for (int x = 0; x < kWidth_px; ++x) {
        const auto picked =
            pick(world, view, without.workspace,
                 {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f}, scratch);
        if (!picked || picked->what != Shown::kObject) continue;
        const glm::dvec3 p = picked->p_world;
        if (std::abs(p.z - 3.0) > 0.01 || std::abs(p.y) > 11.5) continue;
        // The map's points are 0.3 m apart, and the shadow is soft by one.
        const double past_wall_m = -0.5 - p.x;
        const float part = with.linear(x, y).y / without.linear(x, y).y;
        if (past_wall_m > 0.3 && past_wall_m < shadow_m - 0.7) {
          EXPECT_LT(part, 0.6f) << p.x << " " << p.y;
          ++shaded;
        } else if (past_wall_m < -1.3 || past_wall_m > shadow_m + 0.7) {
          EXPECT_EQ(part, 1.0f) << p.x << " " << p.y;
          ++lit;
        }
      }
    EXPECT_GT(shaded, 100);
    EXPECT_GT(lit, 300);
  }
}

// A ball throws nothing on itself that faces the sun: no point of it is spotted.
TEST(SelfShadow, ABallHasNone) {
  const LooseTriangles ball = closed_mesh(40, [](int i, int j) {
    const SinCos up = sin_cos_turns(i / 80.0), around = sin_cos_turns(j / 80.0);
    return 6.0f * glm::vec3(up.sin * around.cos, up.sin * around.sin, up.cos);
  });
  for (const double elevation_deg : {10.0, 45.0}) {
    const World world = world_of(scene_of("ball", ball, elevation_deg));
    const View view = make_view({25.0, -25.0, 12.0}, radians(-45.0), radians(-8.0), radians(30.0),
                                0.25f, kWidth_px, kHeight_px);
    const Shot with(world, view, 1.0, linear());
    const Shot without(world, view, 1.0, linear({Part::kSelfShadows}));
    double most = 0.0;
    for (int y = 0; y < kHeight_px; ++y)
      for (int x = 0; x < kWidth_px; ++x)
        most = std::max(most, std::abs(1.0 - static_cast<double>(with.linear(x, y).y) /
                                                 static_cast<double>(without.linear(x, y).y)));
    EXPECT_LT(most, 0.05) << elevation_deg;
    EXPECT_FALSE(with.state().meshes.objects.shadows.own.empty());
  }
}

// Against the plane through the corners, at all points inside.
TEST(SelfShadow, ATriangleRaisesThePointsThatItCovers) {
  constexpr int kSide = 32;
  std::vector<float> depth_m(kSide * kSide, SunDepth::kNothing_m);
  const std::array<glm::vec3, 3> corner = {
      {{3.2f, 4.1f, 1.0f}, {27.9f, 9.3f, 5.0f}, {12.4f, 29.7f, -2.0f}}};
  add_triangle(corner, kSide, depth_m);
  const glm::vec3 n = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  int covered = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const glm::vec2 p(x, y);
      bool inside = true;
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec2 a(corner[k]), along = glm::vec2(corner[(k + 1) % 3]) - a, to = p - a;
        inside &= along.x * to.y - along.y * to.x > 1.5f * glm::length(along);
      }
      const float at = depth_m[static_cast<std::size_t>(y * kSide + x)];
      if (inside) {
        const float z = corner[0].z - (n.x * (p.x - corner[0].x) + n.y * (p.y - corner[0].y)) / n.z;
        EXPECT_NEAR(at, z, 1e-4f);
        ++covered;
      }
    }
  EXPECT_GT(covered, 100);
  EXPECT_EQ(depth_m[0], SunDepth::kNothing_m);
}

// From frame to frame pictures change evenly, whether or not a mesh changes its level.
TEST(ObjectLevels, AFlightTowardsAMeshShowsNoChangeOfLevel) {
  const LooseTriangles body = closed_mesh(64, [](int i, int j) {
    const SinCos up = sin_cos_turns(i / 128.0), around = sin_cos_turns(j / 128.0);
    const double r = 8.0 + 0.3 * sin(0.35 * i) * sin(2.0 * kPi * 6.0 * j / 128.0);
    return glm::vec3(r * up.sin * around.cos, 2.0 * r * up.sin * around.sin, r * up.cos);
  });
  scene::Scene scene = scene_of("body", body, 30.0);
  scene.objects[0].draught = 0.2;
  scene.objects[0].height_m = 0.0;
  const World world = world_of(scene);
  Shot film;
  std::vector<double> changes;
  std::vector<bool> is_new_level;
  std::vector<int> before;
  const shapes::ObjectMesh* level = nullptr;
  for (int k = 0; k < 60; ++k) {
    const double distance_m = 900.0 * std::exp(-0.05 * k);
    const View view = make_view({0.0, -distance_m, 0.1 * distance_m}, 0.0, std::atan(-0.1),
                                radians(8.0), 0.25f, kWidth_px, kHeight_px);
    const std::vector<int> green = green_codes(film.draw(world, view, 1.0, linear()));
    const shapes::ObjectMesh* const now = film.state().meshes.objects.meshes[0];
    if (k > 0) {
      double change = 0.0;
      for (std::size_t i = 0; i < before.size(); ++i) change += std::abs(before[i] - green[i]);
      changes.push_back(change);
      is_new_level.push_back(now != level);
    }
    before = green;
    level = now;
  }
  int new_levels = 0;
  for (std::size_t i = 1; i + 1 < changes.size(); ++i) {
    if (!is_new_level[i]) continue;
    ++new_levels;
    EXPECT_LT(changes[i], 1.15 * std::max(changes[i - 1], changes[i + 1])) << i;
  }
  EXPECT_GE(new_levels, 2);
}

}  // namespace
}  // namespace swell::render
