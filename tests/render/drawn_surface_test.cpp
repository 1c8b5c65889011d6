// The surface that is drawn and the surface that scene::Water answers are one: the same bits at
// every vertex.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "math/random.h"
#include "render/frame_state.h"
#include "scene/water_surface.h"

namespace swell::render {
namespace {

constexpr int kFrames = 12;

// The scene of that name; "_radial" after it: with the radial grid, "_plane": with the plane.
scene::Scene load(const std::string& name) {
  const std::size_t end = std::min(name.find("_radial"), name.find("_plane"));
  scene::Scene scene =
      scene::load_scene(std::string(SWELL_SOURCE_DIR) + "/scenes/" + name.substr(0, end) + ".toml");
  if (name.ends_with("_radial")) scene.detail.triangulation = scene::Triangulation::kRadial;
  if (name.ends_with("_plane")) scene.detail.triangulation = scene::Triangulation::kPlane;
  return scene;
}

// Random eyes within 2 km of the origin, times from a day ago to a day ahead.
struct Shot {
  View view;
  double t_s;
};
Shot random_shot(int n) {
  const auto dice = [&](int i) {
    return random_uniform(77, static_cast<std::uint64_t>(8 * n + i));
  };
  const glm::dvec3 eye(4000.0 * (dice(0) - 0.5), 4000.0 * (dice(1) - 0.5), 2.0 + 60.0 * dice(2));
  return {make_view(eye, 6.3 * dice(3), -0.5 * dice(4), 0.9, 0.25f, 96, 54),
          172800.0 * (dice(5) - 0.5)};
}

// Draws a shot and gives the water's vertices to check(surface of the same time, drawn).
template <class Check>
void draw_shots(const std::string& name, Check check) {
  const World world(load(name));
  const scene::Water water(load(name));
  Workers workers(2);
  Workspace workspace;
  Target target;
  ocean::SeaFrame frame;
  FrameOptions options;
  options.water_triangles = 5000;
  for (int n = 0; n < kFrames; ++n) {
    const Shot shot = random_shot(n);
    render_frame(world, shot.view, shot.t_s, options, workspace, target, workers);
    check(water.at(shot.t_s, frame, workers), workspace.state().water);
  }
}

// The corner plus whole steps of a power of two: exact.
glm::dvec2 place_of(const Surface& drawn, std::size_t vertex) {
  const lod::Domain& domain = drawn.domain;
  const double step_m = std::ldexp(domain.size_m, -domain.lattice_bits);
  const glm::ivec2 lattice = drawn.mesh.lattice[vertex];
  return {domain.min_world.x + step_m * lattice.x, domain.min_world.y + step_m * lattice.y};
}

class DrawnSurface : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, DrawnSurface,
                         testing::Values("open_ocean", "lagoon", "sines", "beach",
                                         "open_ocean_radial"),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(DrawnSurface, HasTheHeightOfAQueryAtEveryVertex) {
  int moved = 0;
  draw_shots(GetParam(), [&](const scene::WaterSurface& surface, const Surface& drawn) {
    ASSERT_GT(drawn.height_m.size(), 1000u);
    for (std::size_t v = 0; v < drawn.height_m.size(); ++v) {
      ASSERT_EQ(drawn.height_m[v], surface.height(place_of(drawn, v))) << "vertex " << v;
      moved += drawn.height_m[v] != 0.0f;
    }
  });
  EXPECT_GT(moved, 1000);
}

// The plane leaves all waves to the shading.
TEST(DrawnPlane, IsTwoFlatTriangles) {
  draw_shots("open_ocean_plane", [&](const scene::WaterSurface&, const Surface& drawn) {
    ASSERT_EQ(drawn.mesh.level.size(), 2u);
    for (const float height_m : drawn.height_m) ASSERT_EQ(height_m, 0.0f);
  });
}

// Inside a triangle the picture is flat: it cuts off at most what the slope does over its edges.
TEST_P(DrawnSurface, StaysBetweenItsVerticesWithinTheWavesSlope) {
  constexpr double kSteepest = 1.0;  // of these scenes' waves and fading
  double near_square = 0.0;
  int near = 0;
  draw_shots(GetParam(), [&](const scene::WaterSurface& surface, const Surface& drawn) {
    for (std::size_t i = 0; i + 2 < drawn.mesh.indices.size(); i += 3) {
      const std::uint32_t* v = &drawn.mesh.indices[i];
      const glm::dvec2 a = place_of(drawn, v[0]), b = place_of(drawn, v[1]);
      const glm::dvec2 c = place_of(drawn, v[2]), middle = (a + b + c) / 3.0;
      const double flat = (static_cast<double>(drawn.height_m[v[0]]) + drawn.height_m[v[1]] +
                           drawn.height_m[v[2]]) /
                          3.0;
      const double edge_m =
          std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
      const double cut_off_m = std::abs(flat - surface.height(middle));
      ASSERT_LE(cut_off_m, kSteepest * edge_m);
      if (edge_m > 1.0) continue;
      near_square += cut_off_m * cut_off_m;
      ++near;
    }
  });
  ASSERT_GT(near, 200);
  EXPECT_LT(std::sqrt(near_square / near), 0.02) << "rms over triangles with edges up to 1 m";
}

}  // namespace
}  // namespace swell::render
