// The ground that trees stand on where few triangles draw the land.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "render/shot.h"
#include "render/world/forest.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

constexpr int kWide = 192, kHigh = 112, kTriangles = 3000;

// Hills with woods, seen from the sea and from above.
const World& coarse_hills() {
  static const World world = world_of(scene::parse_scene(R"(
    [camera]
    eye_m = [0.0, -260.0, 6.0]
    fov_y_deg = 40.0
    [wind]
    speed_mps = 2.0
    [sea]
    patch_lengths_m = [60.0]
    resolution = 32
    [detail]
    water_triangles = 500
    terrain_triangles = 3000
    [terrain]
    island_radius_m = 180.0
    island_height_m = 70.0
    [[trees]]
    density_per_m2 = 0.02
    height_m = [6.0, 14.0]
)",
                                                         "coarse_hills.toml"));
  return world;
}

Shot shot_from(glm::dvec3 eye, int terrain_triangles) {
  return Shot(coarse_hills(), make_view(eye, 0.0, -0.1, 0.7, 0.25f, kWide, kHigh), 1.0,
              {.terrain_triangles = terrain_triangles, .triangle_capacity = kTriangles});
}

constexpr glm::dvec3 kEyes[] = {{0.0, -260.0, 6.0}, {40.0, -330.0, 60.0}, {0.0, -120.0, 90.0}};

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

// The land's triangles at a place relative to the eye, found by looking at all of them [m].
std::optional<double> drawn_height_m(const Surface& land, glm::dvec2 at) {
  for (std::size_t i = 0; i < land.mesh.indices.size(); i += 3) {
    std::array<glm::dvec2, 3> p;
    std::array<double, 3> height_m;
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = glm::dvec2(land.offset[land.mesh.indices[i + k]]) - at;
      height_m[k] = land.height_m[land.mesh.indices[i + k]];
    }
    const double a = cross(p[1], p[2]), b = cross(p[2], p[0]), c = cross(p[0], p[1]);
    if (std::min({a, b, c}) < 0.0) continue;
    return (a * height_m[0] + b * height_m[1] + c * height_m[2]) / (a + b + c);
  }
  return std::nullopt;
}

// The feet of trees that the window draws: how far over the drawn land each stands, and how far the
// true ground lies over that [m].
struct Feet {
  std::vector<double> tree_m, ground_m;
};

Feet feet_of(const Shot& shot) {
  Feet feet;
  const Meshes& meshes = shot.state().meshes;
  const TreeDraws& draws = meshes.trees.drawn_in(ViewKind::kWindow);
  const Forest& forest = *coarse_hills().state().forest;
  for (const DrawnCell& cell : draws.cells)
    for (std::uint32_t i = 0; i < cell.trees; ++i) {
      const DrawnTree& tree = draws.trees[forest.trees.cells[cell.cell].first + i];
      const auto drawn_m = drawn_height_m(meshes.land, tree.foot_rel);
      if (!drawn_m) continue;
      const double true_m = forest.trees.origin.z + forest.columns.z_m[tree.tree];
      feet.tree_m.push_back(shot.view.eye_world.z + tree.foot_rel.z - *drawn_m);
      feet.ground_m.push_back(true_m - *drawn_m);
    }
  return feet;
}

double farthest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

TEST(TreesOnCoarseLand, StandOnTheGroundThatIsDrawn) {
  for (const glm::dvec3& eye : kEyes)
    for (const int triangles : {150, 600, 2000}) {
      const Feet feet = feet_of(shot_from(eye, triangles));
      ASSERT_GT(feet.tree_m.size(), 100u) << eye.y << ' ' << triangles;
      EXPECT_LT(farthest(feet.tree_m), 0.01) << eye.y << ' ' << triangles;
      if (triangles == 150) {
        EXPECT_GT(farthest(feet.ground_m), 3.0) << eye.y << ": trees would float";
      }
    }
}

TEST(TreesOnCoarseLand, StandOnTheTrueGroundWithAsManyTrianglesAsTheSceneAsksFor) {
  for (const glm::dvec3& eye : kEyes)
    for (const int triangles : {kTriangles, 0}) {
      const Shot shot = shot_from(eye, triangles);
      EXPECT_EQ(shot.state().meshes.trees.on_drawn_ground, 0.0f);
      const Feet feet = feet_of(shot);
      ASSERT_GT(feet.tree_m.size(), 100u);
      for (std::size_t i = 0; i < feet.tree_m.size(); ++i)
        ASSERT_NEAR(feet.tree_m[i], feet.ground_m[i], 1e-4);
    }
}

TEST(TreesOnCoarseLand, GoOverToItLittleByLittle) {
  float before = 0.0f;
  for (int triangles = kTriangles; triangles > 2200; triangles -= 60) {
    const float now = shot_from(kEyes[0], triangles).state().meshes.trees.on_drawn_ground;
    EXPECT_GE(now, before);
    EXPECT_LT(now - before, 0.1f) << triangles;
    before = now;
  }
  EXPECT_EQ(before, 1.0f);
}

}  // namespace
}  // namespace swell::render
