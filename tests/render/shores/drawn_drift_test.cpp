// What drifts on a river: pictures, labels, picks and queries agree on where it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "ocean/water_surface.h"
#include "render/labels/classes.h"
#include "render/labels/label_channels.h"
#include "render/measure/pick.h"
#include "render/shot.h"
#include "render/world/world_state.h"
#include "scene/objects.h"
#include "scene/scene.h"
#include "scene/water.h"

namespace swell::render {
namespace {

// A river that comes down a beach, from above; two spheres in it, of which the lower one drifts.
const std::string kDriftScene = R"(
[camera]
eye_m = [0, -190, 60]
heading_deg = 0
pitch_deg = -55
fov_y_deg = 50
[sky]
cloud_cover = 0
[wind]
speed_mps = 0
[coast]
model = "none"
[terrain]
coast_m = [[-100, 0], [100, 0]]
beach_slope = 0.03
beach_size_m = 520
floor_depth_m = 5
[[river]]
path_m = [[0, -195], [8, -150], [-8, -100], [0, -40], [0, 40]]
width_m = [16]
depth_m = [1.5]
surface_m = [4, 2.6, 1.4, 0.3, 0]
speed_mps = 1
[[object]]
kind = "sphere"
size_m = [4, 4, 4]
draught = 0.2
position_m = [7, -180]
[[object]]
kind = "sphere"
size_m = [4, 4, 4]
draught = 0.2
position_m = [6, -145]
drift = true
)";

const World& drift_world() {
  static const World world = world_of(scene::parse_scene(kDriftScene, "drift.toml"));
  return world;
}

struct DriftFrame : Shot {
  DriftFrame(const World& world, double t_s) { draw(world, t_s); }
  void draw(const World& world, double t_s) {
    FrameOptions options;
    options.labels.add(Label::kId);
    Shot::draw(world, view_of(world, t_s, 200, 150), t_s, options);
  }
};

std::vector<scene::ObjectPose> poses_at(double t_s, glm::vec2* current) {
  static const scene::Water water = drift_world().water();
  ocean::SeaFrame sea;
  Workers workers(1);
  const scene::WaterSurface surface = water.at(t_s, sea, workers);
  const std::vector<scene::FloatingObject>& objects = drift_world().scene().objects;
  std::vector<scene::ObjectPose> poses(objects.size());
  scene::object_poses(objects, surface, poses);
  const glm::dvec2 p(poses[1].position_world);
  surface.currents({&p, 1}, {current, 1});
  return poses;
}

TEST(DrawnDrift, MovesWithTheCurrentThatQueriesTell) {
  glm::vec2 current, unused;
  double way_m = 0.0;
  for (double t_s = 5.0; t_s < 60.0; t_s += 5.0) {
    const auto before = poses_at(t_s - 0.5, &unused), now = poses_at(t_s, &current),
               after = poses_at(t_s + 0.5, &unused);
    const glm::dvec2 moved(after[1].position_world - before[1].position_world);
    // The lattice of currents is bilinear between points a few metres apart.
    EXPECT_LT(glm::distance(moved, glm::dvec2(current)), 0.08 * glm::length(current)) << t_s;
    EXPECT_NEAR(now[1].position_world.z, now[1].water_m, 1e-9);
    way_m += 5.0 * glm::length(moved);
    EXPECT_EQ(now[0].position_world.x, 7.0);
    EXPECT_EQ(now[0].position_world.y, -180.0);
  }
  EXPECT_GT(way_m, 40.0);
}

TEST(DrawnDrift, IsDrawnLabelledAndPickedWhereItsPoseIs) {
  const World& world = drift_world();
  for (const double t_s : {0.0, 25.0, 50.0}) {
    const DriftFrame frame(world, t_s);
    glm::vec2 unused;
    const scene::ObjectPose pose = poses_at(t_s, &unused)[1];
    const glm::dvec3 top = pose.position_world + glm::dvec3(0.0, 0.0, 2.0);
    const glm::vec4 clip =
        frame.view.clip_from_rel * glm::vec4(glm::vec3(top - frame.view.eye_world), 1.0f);
    const glm::vec2 at_px((0.5f + 0.5f * clip.x / clip.w) * 200.0f,
                          (0.5f - 0.5f * clip.y / clip.w) * 150.0f);
    const glm::ivec2 p(at_px);
    EXPECT_EQ(frame.target.labels.id[frame.at(p.x, p.y)], kFirstObjectId + 1) << t_s;
    PickScratch scratch;
    const auto picked = pick(world, frame.view, frame.workspace, at_px, scratch);
    ASSERT_TRUE(picked && picked->what == Shown::kObject) << t_s;
    EXPECT_EQ(picked->object, 1u);
    EXPECT_LT(glm::distance(picked->p_world, pose.position_world), 4.0);
  }
}

// Spheres of 4 m: one moored in the way of two.
TEST(DrawnDrift, KeepsOffWhatIsMooredAndOffOtherDrifters) {
  const std::string sphere = "[[object]]\nkind = \"sphere\"\nsize_m = [4, 4, 4]\ndraught = 0.2\n";
  const World world =
      world_of(scene::parse_scene(kDriftScene + sphere + "position_m = [5, -151]\ndrift = true\n" +
                                      sphere + "position_m = [-6, -100]\n",
                                  "drift.toml"));
  const std::vector<scene::FloatingObject>& objects = world.scene().objects;
  double apart_m = 1e9, off_m = 1e9;
  for (double t_s = 0.0; t_s < 400.0; t_s += 0.25) {
    const glm::dvec2 a = scene::plan_pose(objects[1], t_s).position_m;
    const glm::dvec2 b = scene::plan_pose(objects[2], t_s).position_m;
    apart_m = std::min(apart_m, glm::distance(a, b));
    for (const glm::dvec2& p : {a, b})
      off_m = std::min(off_m, glm::distance(p, objects[3].position_m));
  }
  EXPECT_GE(apart_m, 4.0);
  EXPECT_GE(off_m, 3.99);
  EXPECT_LT(off_m, 6.0);
  for (const std::size_t n : {1, 2})
    EXPECT_GT(scene::plan_pose(objects[n], 1e9).position_m.y, -20.0) << n;
}

TEST(DrawnDrift, IsTheSameAloneAndAfterOtherFrames) {
  const World& world = drift_world();
  const DriftFrame alone(world, 40.0);
  DriftFrame history(world, 3.0);
  EXPECT_NE(history.target.rgba, alone.target.rgba);
  history.draw(world, 40.0);
  EXPECT_EQ(history.target.rgba, alone.target.rgba);
  // And in a world made from another one, whose way it takes.
  const World again(world.scene(), world, 2);
  EXPECT_EQ(again.scene().objects[1].drift_track, world.scene().objects[1].drift_track);
  EXPECT_EQ(DriftFrame(again, 40.0).target.rgba, alone.target.rgba);
}

}  // namespace
}  // namespace swell::render
