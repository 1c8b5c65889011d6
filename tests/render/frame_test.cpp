// What frames show and cost: every visible pixel shaded once, no allocation, whole pictures from
// any camera.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "allocation_count.h"
#include "render/drawn_frames.h"
#include "render/workspace.h"

namespace swell::render {
namespace {

class EachScene : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, EachScene,
                         testing::Values("open_ocean", "lagoon", "sines", "beach", "buoys",
                                         "harbour"),
                         [](const auto& test) { return std::string(test.param); });

TEST(Detail, EveryPriorityOfASceneMovesTriangles) {
  const World& world = world_of("lagoon");
  const Picture reference = draw(world, 2.0);
  const auto picture_with = [&](auto set) {
    scene::Scene scene = world.scene();
    set(scene.detail);
    return draw(World(scene, world, 2), 2.0).target;
  };
  const auto back_facing = picture_with([](scene::Detail& d) { d.back_facing = 16.0; });
  const auto normal_spread = picture_with([](scene::Detail& d) { d.normal_spread = 4.0; });
  const auto silhouette = picture_with([](scene::Detail& d) { d.silhouette = 4.0; });
  const auto visibility = picture_with([](scene::Detail& d) { d.visibility = 4.0; });
  const auto objects = picture_with([](scene::Detail& d) { d.objects = 64.0; });
  EXPECT_NE(difference(back_facing, reference.target), "");
  EXPECT_NE(difference(normal_spread, reference.target), "");
  EXPECT_NE(difference(silhouette, reference.target), "");
  EXPECT_NE(difference(visibility, reference.target), "");
  EXPECT_EQ(difference(objects, reference.target), "");  // nothing floats there
}

TEST_P(EachScene, EveryVisiblePixelIsShadedOnce) {
  const World& world = world_of(GetParam());
  const FrameStatistics s = draw(world, 1.0).statistics;
  EXPECT_GT(s.visible_pixels, 0u);
  EXPECT_LE(s.visible_pixels, std::uint64_t{kWidth} * kHeight);
  EXPECT_EQ(s.visible_pixels, s.shaded_pixels);
}

TEST_P(EachScene, SteadyStateAllocatesNothing) {
  const World& world = world_of(GetParam());
  Workers workers(1);
  Workspace workspace;
  Target target;
  const auto frame = [&](int k) {
    render_frame(world, view_of(world, 0.0), k / 60.0, few_triangles(), workspace, target, workers);
  };
  // Storage grows to the largest frame so far, so the second round finds everything large enough.
  for (int k = 0; k < 6; ++k) frame(k);
  const std::uint64_t before = allocation_count();
  for (int k = 0; k < 6; ++k) frame(k);
  EXPECT_EQ(allocation_count() - before, 0u);
}

TEST_P(EachScene, ASmallerPictureIsDrawnAndEnlarged) {
  const World world = load_world(GetParam());
  FrameOptions options = few_triangles();
  options.picture_scale = 0.75;
  const Picture picture = draw(world, 2.0, 2, options);
  ASSERT_EQ(picture.target.rgba.size(), std::size_t{kWidth} * kHeight);
  EXPECT_LE(picture.statistics.shaded_pixels, std::uint64_t{150} * 90);
  EXPECT_EQ(difference(draw(world, 2.0, 1, options).target, picture.target), "");
  // It shows the same view.
  const Picture full = draw(world, 2.0);
  double sum = 0.0;
  for (std::size_t i = 0; i < full.target.rgba.size(); ++i)
    for (int c = 0; c < 24; c += 8)
      sum += std::abs(static_cast<int>(full.target.rgba[i] >> c & 255u) -
                      static_cast<int>(picture.target.rgba[i] >> c & 255u));
  EXPECT_LT(sum / (3.0 * static_cast<double>(full.target.rgba.size())), 6.0);
}

// As a frame governor asks for them.
TEST(Frame, ChangingTriangleCountsWithinTheCapacityAllocatesNothing) {
  const World world = load_world("lagoon");
  Workers workers(1);
  Workspace workspace;
  Target target;
  FrameOptions options;
  options.triangle_capacity = 8000;
  const auto frame = [&](int triangles) {
    options.water_triangles = options.terrain_triangles = triangles;
    render_frame(world, view_of(world, 1.0), 1.0, options, workspace, target, workers);
  };
  for (const int triangles : {8000, 7200, 3000, 5500, 8000}) frame(triangles);
  const std::uint64_t before = allocation_count();
  for (const int triangles : {8000, 7200, 3000, 5500, 8000}) frame(triangles);
  EXPECT_EQ(allocation_count() - before, 0u);
}

TEST(Frame, LookingDownAtTheSeaLeavesNoHole) {
  const World& world = world_of("open_ocean");
  for (const double pitch : {-1.5, -1.0, -0.6}) {
    const View view = make_view({0, 0, 30}, 0.7, pitch, 0.8, 0.25f, 320, 200);
    Workers workers(2);
    Workspace workspace;
    Target target;
    const FrameStatistics s =
        render_frame(world, view, 3.0, few_triangles(), workspace, target, workers);
    EXPECT_EQ(s.visible_pixels, std::uint64_t{320} * 200) << "pitch " << pitch;
  }
}

TEST(Frame, WindChangesThePictureAndTheSeedToo) {
  const scene::Scene& scene = world_of("open_ocean").scene();
  const Picture reference = draw(world_of("open_ocean"), 2.0);
  scene::Scene calm = scene, other_seed = scene;
  calm.sea.wind_speed_mps = 5.0;
  other_seed.sea.seed += 1;
  EXPECT_NE(picture_hash(draw(World(calm), 2.0).target), picture_hash(reference.target));
  EXPECT_NE(picture_hash(draw(World(other_seed), 2.0).target), picture_hash(reference.target));
}

TEST(Frame, OddSizesDraw) {
  const World& world = world_of("lagoon");
  Workers workers(2);
  Workspace workspace;
  Target target;
  for (const glm::ivec2& size : {glm::ivec2(1, 1), {1, 200}, {200, 1}, {63, 65}, {17, 3}}) {
    for (const double pitch : {-1.57, 0.0, 1.57}) {
      const View view = make_view({1, 2, 5}, 2.0, pitch, 1.0, 0.25f, size.x, size.y);
      const FrameStatistics s =
          render_frame(world, view, 1.0, few_triangles(), workspace, target, workers);
      EXPECT_EQ(target.rgba.size(), static_cast<std::size_t>(size.x) * size.y);
      EXPECT_EQ(s.visible_pixels, s.shaded_pixels);
    }
  }
}

// From below, from within and from far above the water, through a telescope and a fish-eye: whole
// pictures, the same from a workspace that has drawn something else.
TEST(Frame, ExtremeCamerasGiveWholePictures) {
  const World& world = world_of("lagoon");
  Workers workers(2), one_worker(1);
  Workspace workspace;
  FrameOptions options = few_triangles();
  options.keep_linear = true;
  for (const double z : {-3.0, 0.0, 40000.0}) {
    for (const double fov : {0.01, 3.1}) {
      SCOPED_TRACE("z " + std::to_string(z) + " fov " + std::to_string(fov));
      const View view = make_view({0, 0, z}, 0.0, -0.3, fov, 0.25f, 64, 48);
      Target target, alone;
      Workspace fresh;
      const FrameStatistics s = render_frame(world, view, 1e9, options, workspace, target, workers);
      render_frame(world, view, 1e9, options, fresh, alone, one_worker);
      EXPECT_EQ(difference(target, alone), "");
      EXPECT_EQ(s.visible_pixels, s.shaded_pixels);
      EXPECT_TRUE(fov < 1.0 || s.visible_pixels > 0);
      EXPECT_TRUE(std::ranges::all_of(target.rgba, [](std::uint32_t p) { return p >> 24 == 255; }));
      EXPECT_TRUE(std::ranges::all_of(target.linear,
                                      [](float x) { return std::isfinite(x) && x >= 0.0f; }));
    }
  }
}

// Every number of a frame is of its own world.
TEST(Frame, StatisticsForgetTheWorldBefore) {
  Workspace workspace, fresh;
  Workers workers(2);
  Target target;
  const auto counts = [&](const World& world, Workspace& ws) {
    const FrameStatistics s =
        render_frame(world, view_of(world, 1.0), 1.0, few_triangles(), ws, target, workers);
    return std::array<std::uint64_t, 5>{static_cast<std::uint64_t>(s.water_triangles),
                                        static_cast<std::uint64_t>(s.terrain_triangles),
                                        static_cast<std::uint64_t>(s.lod_stopped), s.visible_pixels,
                                        s.shaded_pixels};
  };
  for (const char* before : {"lagoon", "buoys", "beach"}) {
    counts(world_of(before), workspace);
    EXPECT_EQ(counts(world_of("open_ocean"), workspace), counts(world_of("open_ocean"), fresh))
        << before;
    const FrameStatistics again =
        render_frame(world_of("open_ocean"), view_of(world_of("open_ocean"), 1.0), 1.0,
                     few_triangles(), workspace, target, workers);
    EXPECT_EQ(again.splits + again.merges, 0) << before;
  }
}

TEST(FrameDeathTest, RefusesWhatItCannotDraw) {
  const World& world = world_of("open_ocean");
  Workspace workspace;
  Target target;
  Workers workers(1);
  const auto draw_with = [&](const View& view, double t_s, const FrameOptions& options) {
    render_frame(world, view, t_s, options, workspace, target, workers);
  };
  const View good = view_of(world, 0.0);
  EXPECT_DEATH(draw_with(good, NAN, {}), "t_s=nan");
  EXPECT_DEATH(draw_with(good, INFINITY, {}), "t_s=inf");
  const auto expect_view_refused = [&](auto&& change, const char* message) {
    View view = good;
    change(view);
    EXPECT_DEATH(draw_with(view, 0.0, {}), message);
  };
  expect_view_refused([](View& v) { v.eye_world.y = NAN; }, "eye_world=\\(0, nan");
  expect_view_refused([](View& v) { v.forward.x = NAN; }, "axis=\\(nan");
  expect_view_refused([](View& v) { v.width_px = 0; }, "size=0x");
  expect_view_refused([](View& v) { v.height_px = 8193; }, "x8193");
  expect_view_refused([](View& v) { v.near_m = 0.0f; }, "near_m=0");
  expect_view_refused([](View& v) { v.tan_half_x = NAN; }, "tan_half=nan");
  const auto expect_refused = [&](auto&& change, const char* message) {
    FrameOptions options;
    change(options);
    EXPECT_DEATH(draw_with(good, 0.0, options), message);
  };
  expect_refused([](FrameOptions& o) { o.tile_size_px = 24; }, "tile_size_px=24");
  expect_refused([](FrameOptions& o) { o.water_triangles = -1; }, "triangles=-1");
  expect_refused([](FrameOptions& o) { o.terrain_triangles = 1; }, "triangles=1");
  expect_refused([](FrameOptions& o) { o.triangle_capacity = 1000001; }, "triangles=1000001");
  expect_refused([](FrameOptions& o) { o.lookup_scale = NAN; }, "lookup_scale=nan");
  expect_refused([](FrameOptions& o) { o.lookup_scale = 1e9; }, "lookup_scale=1000000000");
  expect_refused([](FrameOptions& o) { o.background_error_px = NAN; }, "background_error_px=nan");
  expect_refused([](FrameOptions& o) { o.picture_scale = 0.0; }, "picture_scale=0");
  expect_refused([](FrameOptions& o) { o.lod_ms = NAN; }, "lod_ms=nan");
  expect_refused([](FrameOptions& o) { o.lod_groups = 0; }, "lod_groups=0");
}

TEST(FrameDeathTest, RefusesWhatWasMovedFrom) {
  World world = load_world("open_ocean");
  const View view = view_of(world, 0.0);
  const World taken = std::move(world);
  Workspace workspace;
  Target target;
  Workers workers(1);
  // NOLINTBEGIN(bugprone-use-after-move): that is what the test is about
  EXPECT_DEATH(world.scene(), "the World was moved from");
  EXPECT_DEATH(render_frame(world, view, 0.0, {}, workspace, target, workers),
               "the World was moved from");
  Workspace other = std::move(workspace);
  EXPECT_DEATH(render_frame(taken, view, 0.0, {}, workspace, target, workers),
               "the Workspace was moved from");
  workspace = std::move(other);  // good again
  // NOLINTEND(bugprone-use-after-move)
  render_frame(taken, view, 0.0, few_triangles(), workspace, target, workers);
}

TEST(Frame, LinearPictureHoldsOnlyFiniteRadiance) {
  const World& world = world_of("lagoon");
  FrameOptions options = few_triangles();
  options.keep_linear = true;
  const Picture picture = draw(world, 2.0, 2, options);
  ASSERT_EQ(picture.target.linear.size(), std::size_t{3} * kWidth * kHeight);
  for (const float x : picture.target.linear) ASSERT_TRUE(std::isfinite(x) && x >= 0.0f) << x;
}

// A flat, smooth sea with a clear view to the south, and one white object 40 m ahead.
scene::Scene calm_scene(scene::ObjectKind kind, double size_m, double draught) {
  scene::Scene scene;
  scene.sea.wind_speed_mps = 0.0;
  scene.detail.objects = 1.0;  // the same triangles as without the object
  scene.water.bump_strength = 0.0;
  scene.camera.eye_m = {0.0, -40.0, 4.0};
  scene::FloatingObject object;
  object.kind = kind;
  object.size_m = glm::dvec3(size_m);
  object.draught = draught;
  object.colour = glm::vec3(1.0f);
  scene.objects = {object};
  return scene;
}

std::uint64_t object_pixels(Workspace& workspace) {
  const Workspace::State& state = workspace.state();
  return static_cast<std::uint64_t>(std::ranges::count_if(
      state.visibility.primitive,
      [&](std::uint32_t p) { return state.window.primitives.holds(SurfaceKind::kObjects, p); }));
}

// A ball of radius r at distance d fills a cone of half angle asin(r / d); near the middle of the
// picture that is pi (f tan(angle))^2 pixels.
TEST(Objects, ABallOnTheWaterCoversTheAreaOfItsDisc) {
  const scene::Scene scene = calm_scene(scene::ObjectKind::kSphere, 8.0, 0.0);
  const World world(scene);
  Workers workers(2);
  Workspace workspace;
  Target target;
  const int height_px = 400;
  render_frame(world, view_of(world, 0.0, 400, height_px), 0.0, few_triangles(), workspace, target,
               workers);
  const double focal_px = 0.5 * height_px / std::tan(0.5 * scene.camera.fov_y_rad);
  const double radius_px = focal_px * std::tan(std::asin(4.0 / 40.0));
  const double expected = 3.14159265 * radius_px * radius_px;
  // Flat sides take 1 % away.
  EXPECT_NEAR(static_cast<double>(object_pixels(workspace)), 0.99 * expected, 0.01 * expected);
}

TEST(Objects, ABoxShowsItselfAndItsMirrorImageAndNothingElseChanges) {
  const scene::Scene scene = calm_scene(scene::ObjectKind::kBox, 4.0, 0.0);
  scene::Scene empty = scene;
  empty.objects.clear();
  FrameOptions options = few_triangles();
  options.without = {Part::kShadows, Part::kHulls};
  const Target with = draw(World(scene), 0.0, 2, options).target;
  const Target without = draw(World(empty), 0.0, 2, options).target;
  // The eye is as high as the box: the box's top lies at the horizon, and the mirror image is as
  // high as the box.
  const double focal_px = 0.5 * kHeight / std::tan(0.5 * scene.camera.fov_y_rad);
  const double half_px = focal_px * 2.0 / 38.0, level_px = focal_px * 4.0 / 38.0;
  int changed = 0, changed_far = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const auto i = static_cast<std::size_t>(y) * kWidth + x;
      if (with.rgba[i] == without.rgba[i]) continue;
      ++changed;
      const double right = std::abs(x + 0.5 - 0.5 * kWidth), down = y + 0.5 - 0.5 * kHeight;
      // A lookup image's texel is two pixels, and a bilinear sample reads one further.
      changed_far += right > half_px + 4.0 || down < -1.0 || down > 2.0 * level_px + 4.0;
    }
  }
  EXPECT_EQ(changed_far, 0);
  EXPECT_NEAR(changed, 2.0 * half_px * 2.0 * level_px, 0.15 * 4.0 * half_px * level_px);
}

TEST(Objects, OutOfViewChangeNoPixel) {
  scene::Scene scene = calm_scene(scene::ObjectKind::kBuoy, 4.0, 0.2);
  scene::Scene empty = scene;
  empty.objects.clear();
  scene.objects[0].position_m = {0.0, -60.0};
  EXPECT_EQ(difference(draw(World(scene), 0.0).target, draw(World(empty), 0.0).target), "");
}

}  // namespace
}  // namespace swell::render
