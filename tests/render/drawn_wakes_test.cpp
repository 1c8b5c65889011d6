// Wakes in pictures: the mesh has the heights that queries give, shading knows the slopes, the foam
// shows, and what a picture shows depends on the list and the time alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/frame.h"
#include "render/labels/label_channels.h"
#include "render/view/meshes.h"
#include "render/workspace.h"
#include "render/world/world_state.h"
#include "scene/scene.h"
#include "scene/water.h"

namespace swell::render {
namespace {

// A calm sea with a boat that crosses it and a stone that falls.
constexpr const char* kScene = R"(
[camera]
eye_m = [-8, -22, 9]
pitch_deg = -22
fov_y_deg = 50
[wind]
speed_mps = 0
[[object]]
kind = "sailboat"
path_m = [[-60, 0], [100, 0]]
path_closed = false
speed_mps = 3
[[disturbance]]
kind = "drop"
position_m = [-10, -8]
t_s = 19
height_m = 0.2
)";
constexpr double kTime_s = 20.5;

struct Drawn {
  Workspace workspace;
  Target target;
};

void draw(const World& world, double t_s, const FrameOptions& options, Drawn& drawn,
          int threads = 1) {
  Workers workers(threads);
  const View view = scene::camera_view(world.scene().camera, t_s, 160, 96);
  render_frame(world, view, t_s, options, drawn.workspace, drawn.target, workers);
}

World make_world() { return World(scene::parse_scene(kScene, "wake.toml"), 1); }

TEST(DrawnWakes, VerticesHaveTheHeightsThatQueriesGive) {
  const World world = make_world();
  Drawn drawn;
  draw(world, kTime_s, {}, drawn);
  const scene::Water water(world.scene());
  ocean::SeaFrame frame;
  Workers workers(1);
  const scene::WaterSurface surface = water.at(kTime_s, frame, workers);
  const Surface& mesh = drawn.workspace.state().meshes.water;
  int raised = 0;
  for (std::size_t v = 0; v < mesh.height_m.size(); ++v) {
    const glm::dvec2 p = vertex_world(mesh, v);
    if (glm::length(p) > 60.0) continue;
    ASSERT_EQ(mesh.height_m[v], surface.height(p)) << p.x << " " << p.y;
    raised += std::abs(mesh.height_m[v]) > 0.01f;
  }
  EXPECT_GT(raised, 100);
}

TEST(DrawnWakes, AFrameAloneIsTheFrameInASequence) {
  const World world = make_world();
  Drawn alone, sequence;
  draw(world, kTime_s, {}, alone, 3);
  FrameOptions tiles;
  for (int n = 0; n < 5; ++n) draw(world, kTime_s - 2.0 + 0.4 * n, {}, sequence);
  tiles.tile_size_px = 16;
  draw(world, kTime_s, tiles, sequence);
  EXPECT_EQ(alone.target.rgba, sequence.target.rgba);
}

TEST(DrawnWakes, AreLeftOutWithTheirPart) {
  const World world = make_world();
  scene::Scene calm = world.scene();
  calm.objects[0].wake = false;
  calm.disturbances.clear();
  const World without_any(calm, 1);
  FrameOptions options;
  Drawn wakes, without, calm_drawn;
  draw(world, kTime_s, options, wakes);
  options.without.add(Part::kWakes);
  draw(world, kTime_s, options, without);
  draw(without_any, kTime_s, {}, calm_drawn);
  EXPECT_NE(wakes.target.rgba, without.target.rgba);
  const Surface& mesh = without.workspace.state().meshes.water;
  EXPECT_TRUE(std::ranges::all_of(mesh.height_m, [](float z) { return z == 0.0f; }));
  EXPECT_EQ(without.workspace.state().shading.material<Water>().wakes.count, 0);
  EXPECT_EQ(calm_drawn.workspace.state().shading.material<Water>().wakes.count, 0);
}

TEST(DrawnWakes, AreFlaggedInLabels) {
  const World world = make_world();
  const auto flagged = [&](FrameOptions options) {
    options.labels.add(Label::kFlags);
    Drawn drawn;
    draw(world, kTime_s, options, drawn);
    return std::ranges::count_if(drawn.target.labels.flags,
                                 [](std::uint8_t flags) { return (flags & kShowsWake) != 0; });
  };
  FrameOptions without;
  without.without.add(Part::kWakes);
  EXPECT_GT(flagged({}), 160 * 96 / 50);
  EXPECT_LT(flagged({}), 160 * 96 * 3 / 4);
  EXPECT_EQ(flagged(without), 0);
}

TEST(DrawnWakes, AListForAFrameIsAsOneInTheScene) {
  scene::Scene scene = make_world().scene();
  const std::vector<ocean::Disturbance> given = scene.disturbances;
  scene.disturbances.clear();
  const World world = make_world(), bare(scene, 1);
  FrameOptions options;
  Drawn in_scene, in_frame;
  draw(world, kTime_s, options, in_scene);
  options.disturbances = given;
  draw(bare, kTime_s, options, in_frame);
  EXPECT_EQ(in_scene.target.rgba, in_frame.target.rgba);
}

TEST(DrawnWakes, ABuoyAsternBobs) {
  scene::Scene scene = make_world().scene();
  scene::FloatingObject buoy = scene::common_object(scene::ObjectKind::kBuoy);
  buoy.position_m = {-15.0, 4.0};
  buoy.size_m = {0.8, 0.8, 2.0};
  scene.objects.push_back(buoy);
  const World world(scene, 1);
  double low_m = 1.0, high_m = -1.0;
  Drawn drawn;
  for (double t_s = 15.0; t_s < 23.0; t_s += 0.5) {
    draw(world, t_s, {}, drawn);
    const double z = drawn.workspace.state().meshes.objects.poses[1].position_world.z;
    low_m = std::min(low_m, z), high_m = std::max(high_m, z);
  }
  EXPECT_GT(high_m - low_m, 0.05);
}

TEST(DrawnWakes, FoamBehindTheHullIsWhite) {
  const World world = make_world();
  FrameOptions options;
  options.labels = LabelSet::all();
  Drawn drawn;
  draw(world, kTime_s, options, drawn);
  const std::vector<float>& foam = drawn.target.labels.foam;
  EXPECT_GT(std::ranges::count_if(foam, [](float f) { return f > 0.3f; }), 30);
  options.without.add(Part::kWakes);
  options.without.add(Part::kHulls);
  draw(world, kTime_s, options, drawn);
  EXPECT_EQ(std::ranges::count_if(foam, [](float f) { return f > 0.3f; }), 0);
}

}  // namespace
}  // namespace swell::render
