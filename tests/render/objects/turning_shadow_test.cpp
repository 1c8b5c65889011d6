// The shadows of parts that turn.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "render/measures.h"
#include "render/objects/height_pictures.h"
#include "render/shot.h"
#include "scene/file/implicit_file.h"
#include "scratch_folder.h"
#include "shapes/implicit_mesh.h"
#include "sky/sky_light.h"

namespace swell::render {
namespace {

// A blade of two arms, 8 m long, that turns about an upright axis once in 4 s, 6 m over a calm sea;
// the camera looks at where its shadow falls.
constexpr double kTurn_s = 4.0;

scene::Scene blade_over_sea(const ScratchFolder& folder, double rpm) {
  scene::Scene scene;
  scene.sea.wind_speed_mps = 0.0;
  scene.water.bump_strength = 0.0;
  scene.sky.cloud_cover = 0.0;
  scene.sky.sun_elevation_rad = radians(50.0);
  scene.sky.sun_azimuth_rad = radians(200.0);
  scene.sky.sun_direction =
      sky::sun_direction(scene.sky.sun_azimuth_rad, scene.sky.sun_elevation_rad);
  scene.camera.eye_m = {0.0, -12.0, 22.0};
  scene.camera.pitch_rad = radians(-50.0);
  scene.camera.fov_y_rad = radians(50.0);
  scene::FloatingObject object = scene::common_object(scene::ObjectKind::kImplicit);
  object.motion = scene::Motion::kFixed;
  object.file = folder
                    .write(fmt::format("blade_{}.toml", rpm),
                           fmt::format("[[form]]\nshape = \"box\"\nsize = [8, 0.8, 0.2]\n"
                                       "at = [0, 0, 6]\nhub = [0, 0, 6]\nspin_axis = [0, 0, 1]\n"
                                       "spin_rpm = {}\n",
                                       rpm))
                    .string();
  scene.objects = {object};
  return scene;
}

// How much light the shadows take of each pixel.
std::vector<float> taken(const World& world, double t_s) {
  FrameOptions options = {.water_triangles = 4000, .keep_linear = true, .edge_samples = 0};
  const std::vector<float> shaded = green_light(small_shot(world, t_s, options).target);
  options.without = {Part::kShadows};
  std::vector<float> lit = green_light(small_shot(world, t_s, options).target);
  for (std::size_t i = 0; i < lit.size(); ++i) lit[i] -= shaded[i];
  return lit;
}

double sum_of(const std::vector<float>& values) {
  double sum = 0.0;
  for (const float value : values) sum += std::abs(static_cast<double>(value));
  return sum;
}

double shadow_difference(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(static_cast<double>(a[i]) - b[i]);
  return sum;
}

TEST(TurningShadow, TurnsWithThePart) {
  const ScratchFolder folder;
  const World world = world_of(blade_over_sea(folder, 60.0 / kTurn_s));
  const std::vector<float> now = taken(world, 0.0);
  EXPECT_GT(sum_of(now), 0.5);
  // Half a turn brings one arm where the other was.
  EXPECT_LT(shadow_difference(now, taken(world, 0.5 * kTurn_s)), 0.02 * sum_of(now));
  EXPECT_LT(shadow_difference(now, taken(world, kTurn_s)), 0.02 * sum_of(now));
  EXPECT_GT(shadow_difference(now, taken(world, 0.25 * kTurn_s)), 0.5 * sum_of(now));
}

// At t = 0 it lies where that of the same part at rest does.
TEST(TurningShadow, IsThatOfThePartAtRestAtFirst) {
  const ScratchFolder folder;
  const std::vector<float> turning = taken(world_of(blade_over_sea(folder, 15.0)), 0.0);
  const std::vector<float> still = taken(world_of(blade_over_sea(folder, 0.0)), 0.0);
  EXPECT_GT(sum_of(still), 0.5);
  EXPECT_LT(shadow_difference(turning, still), 0.05 * sum_of(still));
}

// An arm over a plate of the same object sweeps its shadow over it.
TEST(TurningShadow, FallsOnTheObjectItself) {
  const ScratchFolder folder;
  scene::Scene scene = blade_over_sea(folder, 15.0);
  scene.objects[0].file = folder
                              .write("plate.toml",
                                     "[[form]]\nshape = \"box\"\nsize = [12, 12, 0.5]\n"
                                     "[[form]]\nshape = \"box\"\nsize = [8, 0.8, 0.2]\n"
                                     "at = [0, 0, 3]\nhub = [0, 0, 3]\nspin_axis = [0, 0, 1]\n"
                                     "spin_rpm = 15\n")
                              .string();
  const World world = world_of(scene);
  const std::vector<float> now = taken(world, 0.0);
  EXPECT_LT(shadow_difference(now, taken(world, 0.5 * kTurn_s)), 0.05 * sum_of(now));
  EXPECT_GT(shadow_difference(now, taken(world, 0.25 * kTurn_s)), 0.1 * sum_of(now));
}

TEST(TurningShadow, OfAStandInKeepsItsLengths) {
  const ScratchFolder folder;
  const scene::Scene scene = blade_over_sea(folder, 15.0);
  const shapes::MeshOfFile shape = shapes::with_meshes(scene::load_implicit(scene.objects[0].file));
  const shapes::ObjectMesh& still = shape.levels.front();
  const glm::vec3 size(shape.high - shape.low);
  shapes::ObjectMesh posed;
  shapes::pose_stand_in(shape, 0.125 * kTurn_s, posed);
  ASSERT_EQ(posed.position.size(), still.position.size());
  EXPECT_EQ(posed.indices, still.indices);
  const auto middle = [&](const shapes::ObjectMesh& mesh, std::size_t i) {
    return mesh.position[i] * size;
  };
  // An eighth of a turn from east to north, as right hands turn.
  const float half = std::sqrt(0.5f);
  for (std::size_t i = 0; i < posed.position.size(); ++i) {
    const glm::vec3 from = middle(still, i), to = middle(posed, i);
    EXPECT_NEAR(to.x, half * (from.x - from.y), 1e-4f);
    EXPECT_NEAR(to.y, half * (from.x + from.y), 1e-4f);
    EXPECT_NEAR(to.z, from.z, 1e-4f);
  }
}

// A table that sinks by a metre halfway takes the top of its stand-in along, and leaves its foot.
TEST(TurningShadow, StandInsFollowHeightsThatMove) {
  const HeightPictures pictures;
  for (const int frame : {0, 1})
    pictures.write(fmt::format("sink_000{}.exr", frame), 5, 5,
                   [&](double u, double) { return 2.0 + 0.5 * u - frame; });
  const shapes::MeshOfFile shape = shapes::with_meshes(
      pictures.parse("[[form]]\nshape = \"box\"\nsize = [4, 4, 1]\n"
                     "heights = { image = \"sink_%04d.exr\", frames = 2, loop_s = 2 }"));
  const double height_m = shape.high.z - shape.low.z;
  shapes::ObjectMesh posed;
  const shapes::ObjectMesh& still = shape.levels.front();
  for (const double t_s : {0.0, 0.5, 1.0}) {
    shapes::pose_stand_in(shape, t_s, posed);
    ASSERT_EQ(posed.position.size(), still.position.size());
    for (std::size_t i = 0; i < posed.position.size(); ++i) {
      const double sunk_m =
          height_m * static_cast<double>(still.position[i].z - posed.position[i].z);
      EXPECT_NEAR(sunk_m, i % 2 == 0 ? 0.0 : t_s, 1e-4);
    }
  }
}

}  // namespace
}  // namespace swell::render
