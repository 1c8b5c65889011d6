// Wakes in pictures: the mesh has the heights that queries give, shading knows the slopes, the foam
// shows, and what a picture shows depends on the list and the time alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "ocean/water_surface.h"
#include "render/labels/label_channels.h"
#include "render/shot.h"
#include "render/view/meshes.h"
#include "render/world/world_state.h"
#include "scene/scene.h"
#include "scene/water.h"

namespace swell::render {
namespace {

// A calm sea with a boat that crosses it and a stone that falls.
constexpr const char* kWakesScene = R"(
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

View small_view(const World& world) { return view_of(world, 0.0, 160, 96); }

Shot draw(const World& world, const FrameOptions& options = {}, int threads = 1) {
  return Shot(world, small_view(world), kTime_s, options, threads);
}

World make_world() { return world_of(scene::parse_scene(kWakesScene, "wake.toml")); }

TEST(DrawnWakes, VerticesHaveTheHeightsThatQueriesGive) {
  const World world = make_world();
  const Shot shot = draw(world);
  const scene::Water water(world.scene());
  ocean::SeaFrame frame;
  Workers workers(1);
  const scene::WaterSurface surface = water.at(kTime_s, frame, workers);
  const Surface& mesh = shot.state().meshes.water;
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
  const Shot alone = draw(world, {}, 3);
  Shot sequence(1);
  for (int n = 0; n < 5; ++n) sequence.draw(world, small_view(world), kTime_s - 2.0 + 0.4 * n);
  sequence.draw(world, small_view(world), kTime_s, {.tile_size_px = 16});
  EXPECT_EQ(alone.target.rgba, sequence.target.rgba);
}

TEST(DrawnWakes, AreLeftOutWithTheirPart) {
  const World world = make_world();
  scene::Scene calm = world.scene();
  calm.objects[0].wake = false;
  calm.disturbances.clear();
  const World without_any = world_of(calm);
  const Shot wakes = draw(world), without = draw(world, {.without = {Part::kWakes}}),
             calm_shot = draw(without_any);
  EXPECT_NE(wakes.target.rgba, without.target.rgba);
  const Surface& mesh = without.state().meshes.water;
  EXPECT_TRUE(std::ranges::all_of(mesh.height_m, [](float z) { return z == 0.0f; }));
  EXPECT_EQ(without.state().shading.material<Water>().wakes.count, 0);
  EXPECT_EQ(calm_shot.state().shading.material<Water>().wakes.count, 0);
}

TEST(DrawnWakes, AreFlaggedInLabels) {
  const World world = make_world();
  const auto flagged = [&](PartSet without) {
    FrameOptions options{.without = without};
    options.labels.add(Label::kFlags);
    return std::ranges::count_if(draw(world, options).target.labels.flags,
                                 [](std::uint8_t flags) { return (flags & kShowsWake) != 0; });
  };
  EXPECT_GT(flagged({}), 160 * 96 / 50);
  EXPECT_LT(flagged({}), 160 * 96 * 3 / 4);
  EXPECT_EQ(flagged({Part::kWakes}), 0);
}

TEST(DrawnWakes, AListForAFrameIsAsOneInTheScene) {
  scene::Scene scene = make_world().scene();
  const std::vector<ocean::Disturbance> given = scene.disturbances;
  scene.disturbances.clear();
  const World world = make_world(), bare(scene, 1);
  EXPECT_EQ(draw(world).target.rgba, draw(bare, {.disturbances = given}).target.rgba);
}

TEST(DrawnWakes, ABuoyAsternBobs) {
  scene::Scene scene = make_world().scene();
  scene::FloatingObject buoy = scene::common_object(scene::ObjectKind::kBuoy);
  buoy.position_m = {-15.0, 4.0};
  buoy.size_m = {0.8, 0.8, 2.0};
  scene.objects.push_back(buoy);
  const World world = world_of(scene);
  double low_m = 1.0, high_m = -1.0;
  Shot film(1);
  for (double t_s = 15.0; t_s < 23.0; t_s += 0.5) {
    film.draw(world, small_view(world), t_s);
    const double z = film.state().meshes.objects.poses[1].position_world.z;
    low_m = std::min(low_m, z), high_m = std::max(high_m, z);
  }
  EXPECT_GT(high_m - low_m, 0.05);
}

TEST(DrawnWakes, FoamBehindTheHullIsWhite) {
  const World world = make_world();
  const auto white_pixels = [&](PartSet without) {
    const Shot shot = draw(world, {.without = without, .labels = LabelSet::all()});
    return std::ranges::count_if(shot.target.labels.foam, [](float f) { return f > 0.3f; });
  };
  EXPECT_GT(white_pixels({}), 30);
  EXPECT_EQ(white_pixels({Part::kWakes, Part::kHulls}), 0);
}

}  // namespace
}  // namespace swell::render
