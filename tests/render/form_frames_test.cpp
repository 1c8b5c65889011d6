// Forms in whole frames: the same bits however they are made, in the mirror and under water where
// triangles of the same shape are, in labels, and left out.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "math/simd_target.h"
#include "render/drawn_frames.h"
#include "render/labels/label_channels.h"
#include "scratch_folder.h"

namespace swell::render {
namespace {

const World& shipped_forms() {
  static const World world(scene::load_scene(SWELL_SOURCE_DIR "/tests/scenes/forms.toml"));
  return world;
}

TEST(FormFrames, ThreadsTilesAndTargetsChangeNoPixel) {
  const World& world = shipped_forms();
  FrameOptions options = few_triangles();
  options.edge_samples = 4;
  const Picture reference = draw(world, 5.0, 1, options);
  EXPECT_EQ(difference(draw(world, 5.0, 3, options).target, reference.target), "");
  for (const int tile : {16, 32}) {
    options.tile_size_px = tile;
    EXPECT_EQ(difference(draw(world, 5.0, 2, options).target, reference.target), "") << tile;
  }
  options.tile_size_px = 64;
  if (!simd_target_available(SimdTarget::kAvx512)) return;
  select_simd_target(SimdTarget::kAvx2);
  const Picture narrow = draw(world, 5.0, 2, options);
  select_simd_target(SimdTarget::kAvx512);
  EXPECT_EQ(difference(draw(world, 5.0, 2, options).target, narrow.target), "");
}

TEST(FormFrames, FramesBeforeChangeNoPixel) {
  const World& world = shipped_forms();
  const Picture alone = draw(world, 5.0);
  Workers workers(2);
  Workspace workspace;
  Target target;
  for (const double t_s : {4.97, 4.99, 5.0})
    render_frame(world, view_of(world, t_s), t_s, few_triangles(), workspace, target, workers);
  EXPECT_EQ(difference(target, alone.target), "");
}

// A calm sea with a thing half in it, fixed.
scene::Scene calm_scene() {
  scene::Scene scene;
  scene.sea.wind_speed_mps = 0.0;
  scene.water.bump_strength = 0.0;
  scene.sky.cloud_cover = 0.0;
  scene.camera.eye_m = {0.0, -14.0, 3.0};
  scene.camera.pitch_rad = scene::radians(-8.0);
  return scene;
}

// Sunk by two fifths.
scene::FloatingObject ball(scene::ObjectKind kind, const ScratchFolder& folder) {
  scene::FloatingObject object = scene::common_object(kind);
  object.motion = scene::Motion::kFixed;
  object.size_m = glm::dvec3(5.0);
  object.draught = 0.4;
  object.colour = {0.5f, 0.1f, 0.05f};
  if (kind != scene::ObjectKind::kForm) return object;
  object.file = folder
                    .write("ball.toml",
                           "[[form]]\nsize = [5, 5, 5]\nat = [0, 0, 0.5]\npainted = true\n"
                           "colour = [1, 1, 1]\n")
                    .string();
  return object;
}

double mean_difference(const Target& a, const Target& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i)
    for (int shift = 0; shift < 24; shift += 8)
      sum += std::abs(static_cast<int>(a.rgba[i] >> shift & 0xff) -
                      static_cast<int>(b.rgba[i] >> shift & 0xff));
  return sum / (3.0 * static_cast<double>(a.rgba.size()));
}

// The ball of triangles has 24 sides.
void expect_like_triangles(scene::Scene scene, double most) {
  const ScratchFolder folder;
  scene.objects = {ball(scene::ObjectKind::kSphere, folder)};
  const World triangles(scene);
  scene.objects = {ball(scene::ObjectKind::kForm, folder)};
  const World form(scene);
  scene.objects.clear();
  const World nothing(scene);
  const Picture drawn = draw(form, 1.0);
  EXPECT_LT(mean_difference(drawn.target, draw(triangles, 1.0).target), most);
  EXPECT_GT(mean_difference(drawn.target, draw(nothing, 1.0).target), 8.0 * most);
}

TEST(FormFrames, BallOfAFunctionLooksAsOneOfTriangles) { expect_like_triangles(calm_scene(), 0.5); }

TEST(FormFrames, BallSeenThroughTheWaterLooksAsOneOfTriangles) {
  scene::Scene scene = calm_scene();
  scene.water.absorption_per_m = glm::vec3(0.02f);
  scene.camera.eye_m = {0.0, -7.0, 6.0};
  scene.camera.pitch_rad = scene::radians(-45.0);
  expect_like_triangles(scene, 0.8);
}

TEST(FormFrames, BallSeenFromUnderWaterLooksAsOneOfTriangles) {
  scene::Scene scene = calm_scene();
  scene.water.absorption_per_m = glm::vec3(0.02f);
  scene.camera.eye_m = {0.0, -9.0, -3.0};
  scene.camera.pitch_rad = scene::radians(25.0);
  expect_like_triangles(scene, 1.0);
}

TEST(FormFrames, AreLeftOutWithTheirPart) {
  const ScratchFolder folder;
  scene::Scene scene = calm_scene();
  scene.objects = {ball(scene::ObjectKind::kForm, folder)};
  const World with(scene);
  scene.objects.clear();
  const World without(scene);
  FrameOptions options = few_triangles();
  options.without = {Part::kForms};
  // But for the sea's triangles, which are finer around an object.
  const Picture nothing = draw(without, 1.0);
  EXPECT_LT(mean_difference(draw(with, 1.0, 2, options).target, nothing.target), 0.02);
  EXPECT_GT(mean_difference(draw(with, 1.0).target, nothing.target), 4.0);
}

TEST(FormFrames, LabelsKnowThem) {
  const ScratchFolder folder;
  scene::Scene scene = calm_scene();
  scene.objects = {ball(scene::ObjectKind::kForm, folder)};
  const World world(scene);
  FrameOptions options = few_triangles();
  for (const Label label : {Label::kId, Label::kDepth, Label::kGeometricNormal})
    options.labels.add(label);
  const Picture picture = draw(world, 1.0, 2, options);
  const Labels& labels = picture.target.labels;
  const View view = view_of(world, 1.0);
  int seen = 0;
  for (std::size_t i = 0; i < labels.id.size(); ++i) {
    if (labels.id[i] != kFirstObjectId) continue;
    ++seen;
    const int x = static_cast<int>(i) % kWidth, y = static_cast<int>(i) / kWidth;
    const glm::dvec3 out = position_of(view, x, y, labels.depth_m[i]) - glm::dvec3(0, 0, 0.5);
    EXPECT_NEAR(glm::length(out), 2.5, 1e-3);
    EXPECT_GT(glm::dot(glm::normalize(out), glm::dvec3(labels.geometric_normal[i])), 0.9999);
  }
  EXPECT_GT(seen, 500);
}

// An arm that stands up and is an eighth of a turn further in the next frame: its motion takes
// pixels of the one onto it in the other.
TEST(FormFrames, MotionTakesTurningPartsAlong) {
  const ScratchFolder folder;
  constexpr double kStep_s = 0.125;
  scene::Scene scene = calm_scene();
  scene::FloatingObject arm = ball(scene::ObjectKind::kForm, folder);
  arm.file = folder
                 .write("arm.toml",
                        "[[form]]\nshape = \"box\"\nsize = [0.6, 0.6, 3]\nat = [0, 0, 1.5]\n"
                        "spin_axis = [0, 1, 0]\nspin_rpm = 60\nhub = [0, 0, 0]\n")
                 .string();
  arm.draught = 0.0;
  scene.objects = {arm};
  const World world(scene);
  FrameOptions options = few_triangles();
  options.next_frame_s = kStep_s;
  options.labels.add(Label::kId), options.labels.add(Label::kMotion);
  const Picture now = draw(world, 2.0, 2, options), next = draw(world, 2.0 + kStep_s, 2, options);
  int seen = 0, found = 0, stayed = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const auto id_at = [](const Picture& picture, int i, int j) {
        if (i < 0 || j < 0 || i >= kWidth || j >= kHeight) return kSkyId;
        return picture.target.labels.id[static_cast<std::size_t>(j * kWidth + i)];
      };
      if (id_at(now, x, y) != kFirstObjectId) continue;
      const glm::vec2 moved = now.target.labels.motion_px[static_cast<std::size_t>(y * kWidth + x)];
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
