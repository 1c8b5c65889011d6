// Implicit surfaces in whole frames: the same bits however they are made, in the mirror and under
// water where triangles of the same shape are, in labels, and left out.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "math/simd_target.h"
#include "render/measures.h"
#include "render/shot.h"
#include "scratch_folder.h"

namespace swell::render {
namespace {

const World& shipped_implicits() {
  static const World world(scene::load_scene(SWELL_SOURCE_DIR "/tests/scenes/forms.toml"));
  return world;
}

TEST(ImplicitFrames, ThreadsTilesAndTargetsChangeNoPixel) {
  const World& world = shipped_implicits();
  const auto draw = [&](int tile, int threads) {
    return small_shot(world, 5.0,
                      {.tile_size_px = tile, .water_triangles = 4000, .edge_samples = 4}, threads)
        .target;
  };
  const Target reference = draw(64, 1);
  EXPECT_EQ(difference(draw(64, 3), reference), "");
  for (const int tile : {16, 32}) EXPECT_EQ(difference(draw(tile, 2), reference), "") << tile;
  if (!simd_target_available(SimdTarget::kAvx512)) return;
  select_simd_target(simd_targets().front());
  const Target narrow = draw(64, 2);
  select_simd_target(SimdTarget::kAvx512);
  EXPECT_EQ(difference(draw(64, 2), narrow), "");
}

TEST(ImplicitFrames, FramesBeforeChangeNoPixel) {
  const World& world = shipped_implicits();
  Shot film;
  for (const double t_s : {4.97, 4.99, 5.0})
    film.draw(world, view_of(world, t_s, kSmallWidth, kSmallHeight), t_s, few_triangles());
  EXPECT_EQ(difference(film.target, small_shot(world, 5.0).target), "");
}

// A calm sea with a thing half in it, fixed.
scene::Scene calm_scene() {
  scene::Scene scene;
  scene.sea.wind_speed_mps = 0.0;
  scene.water.bump_strength = 0.0;
  scene.sky.cloud_cover = 0.0;
  scene.camera.eye_m = {0.0, -14.0, 3.0};
  scene.camera.pitch_rad = radians(-8.0);
  return scene;
}

// Sunk by two fifths.
scene::FloatingObject ball(scene::ObjectKind kind, const ScratchFolder& folder) {
  scene::FloatingObject object = scene::common_object(kind);
  object.motion = scene::Motion::kFixed;
  object.size_m = glm::dvec3(5.0);
  object.draught = 0.4;
  object.colour = {0.5f, 0.1f, 0.05f};
  if (kind != scene::ObjectKind::kImplicit) return object;
  object.file = folder
                    .write("ball.toml",
                           "[[form]]\nsize = [5, 5, 5]\nat = [0, 0, 0.5]\npainted = true\n"
                           "colour = [1, 1, 1]\n")
                    .string();
  return object;
}

Target draw_with(const std::vector<scene::FloatingObject>& objects, scene::Scene scene,
                 const FrameOptions& options = few_triangles()) {
  scene.objects = objects;
  return small_shot(world_of(scene), 1.0, options).target;
}

// The ball of triangles has 24 sides.
void expect_like_triangles(const scene::Scene& scene, double most) {
  const ScratchFolder folder;
  const Target implicit = draw_with({ball(scene::ObjectKind::kImplicit, folder)}, scene);
  const Target triangles = draw_with({ball(scene::ObjectKind::kSphere, folder)}, scene);
  EXPECT_LT(mean_difference(implicit, triangles), most);
  EXPECT_GT(mean_difference(implicit, draw_with({}, scene)), 8.0 * most);
}

TEST(ImplicitFrames, BallOfAFunctionLooksAsOneOfTriangles) {
  expect_like_triangles(calm_scene(), 0.5);
}

TEST(ImplicitFrames, BallSeenThroughTheWaterLooksAsOneOfTriangles) {
  scene::Scene scene = calm_scene();
  scene.water.absorption_per_m = glm::vec3(0.02f);
  scene.camera.eye_m = {0.0, -7.0, 6.0};
  scene.camera.pitch_rad = radians(-45.0);
  expect_like_triangles(scene, 0.8);
}

TEST(ImplicitFrames, BallSeenFromUnderWaterLooksAsOneOfTriangles) {
  scene::Scene scene = calm_scene();
  scene.water.absorption_per_m = glm::vec3(0.02f);
  scene.camera.eye_m = {0.0, -9.0, -3.0};
  scene.camera.pitch_rad = radians(25.0);
  expect_like_triangles(scene, 1.0);
}

TEST(ImplicitFrames, AreLeftOutWithTheirPart) {
  const ScratchFolder folder;
  const scene::Scene scene = calm_scene();
  const scene::FloatingObject implicit = ball(scene::ObjectKind::kImplicit, folder);
  const Target nothing = draw_with({}, scene);
  const Target left_out =
      draw_with({implicit}, scene, {.water_triangles = 4000, .without = {Part::kImplicits}});
  // But for the sea's triangles, which are finer around an object.
  EXPECT_LT(mean_difference(left_out, nothing), 0.02);
  EXPECT_GT(mean_difference(draw_with({implicit}, scene), nothing), 4.0);
}

TEST(ImplicitFrames, LabelsKnowThem) {
  const ScratchFolder folder;
  scene::Scene scene = calm_scene();
  scene.objects = {ball(scene::ObjectKind::kImplicit, folder)};
  const World world = world_of(scene);
  FrameOptions options = few_triangles();
  for (const Label label : {Label::kId, Label::kDepth, Label::kGeometricNormal})
    options.labels.add(label);
  const Shot shot = small_shot(world, 1.0, options);
  const Labels& labels = shot.target.labels;
  int seen = 0;
  for (std::size_t i = 0; i < labels.id.size(); ++i) {
    if (labels.id[i] != kFirstObjectId) continue;
    ++seen;
    const int x = static_cast<int>(i) % kSmallWidth, y = static_cast<int>(i) / kSmallWidth;
    const glm::dvec3 out = position_of(shot.view, x, y, labels.depth_m[i]) - glm::dvec3(0, 0, 0.5);
    EXPECT_NEAR(glm::length(out), 2.5, 1e-3);
    EXPECT_GT(glm::dot(glm::normalize(out), glm::dvec3(labels.geometric_normal[i])), 0.9999);
  }
  EXPECT_GT(seen, 500);
}

// An arm that stands up and is an eighth of a turn further in the next frame: its motion takes
// pixels of the one onto it in the other.
TEST(ImplicitFrames, MotionTakesTurningPartsAlong) {
  const ScratchFolder folder;
  constexpr double kStep_s = 0.125;
  scene::Scene scene = calm_scene();
  scene::FloatingObject arm = ball(scene::ObjectKind::kImplicit, folder);
  arm.file = folder
                 .write("arm.toml",
                        "[[form]]\nshape = \"box\"\nsize = [0.6, 0.6, 3]\nat = [0, 0, 1.5]\n"
                        "spin_axis = [0, 1, 0]\nspin_rpm = 60\nhub = [0, 0, 0]\n")
                 .string();
  arm.draught = 0.0;
  scene.objects = {arm};
  const World world = world_of(scene);
  FrameOptions options = {.water_triangles = 4000, .next_frame_s = kStep_s};
  options.labels.add(Label::kId), options.labels.add(Label::kMotion);
  const Shot now = small_shot(world, 2.0, options),
             next = small_shot(world, 2.0 + kStep_s, options);
  int seen = 0, found = 0, stayed = 0;
  for (int y = 0; y < kSmallHeight; ++y)
    for (int x = 0; x < kSmallWidth; ++x) {
      const auto id_at = [](const Shot& shot, int i, int j) {
        if (i < 0 || j < 0 || i >= kSmallWidth || j >= kSmallHeight) return kSkyId;
        return shot.target.labels.id[shot.at(i, j)];
      };
      if (id_at(now, x, y) != kFirstObjectId) continue;
      const glm::vec2 moved = now.target.labels.motion_px[now.at(x, y)];
      ++seen;
      found +=
          id_at(next, static_cast<int>(std::lround(static_cast<float>(x) + moved.x)),
                static_cast<int>(std::lround(static_cast<float>(y) + moved.y))) == kFirstObjectId;
      stayed += id_at(next, x, y) == kFirstObjectId;
    }
  EXPECT_GT(seen, 100);
  EXPECT_GT(found, 0.9 * seen);
  EXPECT_LT(stayed, 0.5 * seen);
}

}  // namespace
}  // namespace swell::render
