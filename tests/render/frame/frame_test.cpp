// What frames show and cost: every visible pixel shaded once, no allocation, whole pictures from
// any camera.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "allocation_count.h"
#include "render/measures.h"
#include "render/shot.h"

namespace swell::render {
namespace {

View small_view(const World& world, double t_s) {
  return view_of(world, t_s, kSmallWidth, kSmallHeight);
}

class EachScene : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, EachScene,
                         testing::Values("open_ocean", "lagoon", "sines", "beach", "buoys",
                                         "harbour"),
                         [](const auto& test) { return std::string(test.param); });

TEST(Detail, EveryPriorityOfASceneMovesTriangles) {
  const World& world = shipped_world("lagoon");
  const Target reference = small_shot(world, 2.0).target;
  const auto difference_with = [&](auto set) {
    scene::Scene scene = world.scene();
    set(scene.detail);
    return difference(small_shot(World(scene, world, 2), 2.0).target, reference);
  };
  EXPECT_NE(difference_with([](scene::Detail& d) { d.back_facing = 16.0; }), "");
  EXPECT_NE(difference_with([](scene::Detail& d) { d.normal_spread = 4.0; }), "");
  EXPECT_NE(difference_with([](scene::Detail& d) { d.silhouette = 4.0; }), "");
  EXPECT_NE(difference_with([](scene::Detail& d) { d.visibility = 4.0; }), "");
  // Nothing floats there.
  EXPECT_EQ(difference_with([](scene::Detail& d) { d.objects = 64.0; }), "");
}

TEST_P(EachScene, EveryVisiblePixelIsShadedOnceOrFilledIn) {
  for (const auto shading : {scene::ShadingRate::kAdaptive, scene::ShadingRate::kFull}) {
    FrameOptions options = few_triangles();
    options.shading = shading;
    const FrameStatistics s = small_shot(shipped_world(GetParam()), 1.0, options).statistics;
    EXPECT_GT(s.visible_pixels, 0u);
    EXPECT_LE(s.visible_pixels, std::uint64_t{kSmallWidth} * kSmallHeight);
    EXPECT_EQ(s.visible_pixels, s.shaded_pixels + s.interpolated_pixels);
    EXPECT_EQ(s.interpolated_pixels == 0, shading == scene::ShadingRate::kFull);
  }
}

TEST_P(EachScene, SteadyStateAllocatesNothing) {
  const World& world = shipped_world(GetParam());
  Shot film(1);
  const auto draw_all = [&] {
    for (int k = 0; k < 6; ++k) film.draw(world, small_view(world, 0.0), k / 60.0, few_triangles());
  };
  // Storage grows to the largest frame so far, so the second round finds everything large enough.
  draw_all();
  const std::uint64_t before = allocation_count();
  draw_all();
  EXPECT_EQ(allocation_count() - before, 0u);
}

TEST_P(EachScene, ASmallerPictureIsDrawnAndEnlarged) {
  const World& world = shipped_world(GetParam());
  const FrameOptions options = {.water_triangles = 4000, .picture_scale = 0.75};
  const Shot shot = small_shot(world, 2.0, options);
  ASSERT_EQ(shot.target.rgba.size(), std::size_t{kSmallWidth} * kSmallHeight);
  EXPECT_LE(shot.statistics.shaded_pixels, std::uint64_t{150} * 90);
  EXPECT_EQ(difference(small_shot(world, 2.0, options, 1).target, shot.target), "");
  // It shows the same view.
  EXPECT_LT(mean_difference(small_shot(world, 2.0).target, shot.target), 6.0);
}

// As a frame governor asks for them.
TEST(Frame, ChangingTriangleCountsWithinTheCapacityAllocatesNothing) {
  const World& world = shipped_world("lagoon");
  Shot film(1);
  const auto draw_all = [&] {
    for (const int triangles : {8000, 7200, 3000, 5500, 8000})
      film.draw(world, small_view(world, 1.0), 1.0,
                {.water_triangles = triangles,
                 .terrain_triangles = triangles,
                 .triangle_capacity = 8000});
  };
  draw_all();
  const std::uint64_t before = allocation_count();
  draw_all();
  EXPECT_EQ(allocation_count() - before, 0u);
}

TEST(Frame, LookingDownAtTheSeaLeavesNoHole) {
  for (const double pitch : {-1.5, -1.0, -0.6}) {
    const View view = make_view({0, 0, 30}, 0.7, pitch, 0.8, 0.25f, 320, 200);
    const Shot shot(shipped_world("open_ocean"), view, 3.0, few_triangles());
    EXPECT_EQ(shot.statistics.visible_pixels, std::uint64_t{320} * 200) << "pitch " << pitch;
  }
}

TEST(Frame, WindChangesThePictureAndTheSeedToo) {
  const World& world = shipped_world("open_ocean");
  const std::uint64_t reference = picture_hash(small_shot(world, 2.0).target);
  scene::Scene calm = world.scene(), other_seed = calm;
  calm.sea.wind_speed_mps = 5.0;
  other_seed.sea.seed += 1;
  for (const scene::Scene& scene : {calm, other_seed})
    EXPECT_NE(picture_hash(small_shot(world_of(scene), 2.0).target), reference);
}

TEST(Frame, OddSizesDraw) {
  Shot film;
  for (const glm::ivec2& size : {glm::ivec2(1, 1), {1, 200}, {200, 1}, {63, 65}, {17, 3}}) {
    for (const double pitch : {-1.57, 0.0, 1.57}) {
      const View view = make_view({1, 2, 5}, 2.0, pitch, 1.0, 0.25f, size.x, size.y);
      film.draw(shipped_world("lagoon"), view, 1.0, few_triangles());
      EXPECT_EQ(film.target.rgba.size(), static_cast<std::size_t>(size.x) * size.y);
      EXPECT_EQ(film.statistics.visible_pixels,
                film.statistics.shaded_pixels + film.statistics.interpolated_pixels);
    }
  }
}

// From below, from within and from far above the water, through a telescope and a fish-eye: whole
// pictures, the same from a workspace that has drawn something else.
TEST(Frame, ExtremeCamerasGiveWholePictures) {
  const World& world = shipped_world("lagoon");
  const FrameOptions options = {.water_triangles = 4000, .keep_linear = true};
  Shot film;
  for (const double z : {-3.0, 0.0, 40000.0}) {
    for (const double fov : {0.01, 3.1}) {
      SCOPED_TRACE("z " + std::to_string(z) + " fov " + std::to_string(fov));
      const View view = make_view({0, 0, z}, 0.0, -0.3, fov, 0.25f, 64, 48);
      const Target& target = film.draw(world, view, 1e9, options);
      const FrameStatistics& s = film.statistics;
      EXPECT_EQ(difference(target, Shot(world, view, 1e9, options, 1).target), "");
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
  Shot film, fresh;
  const auto counts = [](const char* name, Shot& shot) {
    const World& world = shipped_world(name);
    shot.draw(world, small_view(world, 1.0), 1.0, few_triangles());
    const FrameStatistics& s = shot.statistics;
    return std::array<std::uint64_t, 5>{static_cast<std::uint64_t>(s.water_triangles),
                                        static_cast<std::uint64_t>(s.terrain_triangles),
                                        static_cast<std::uint64_t>(s.lod_stopped), s.visible_pixels,
                                        s.shaded_pixels};
  };
  for (const char* before : {"lagoon", "buoys", "beach"}) {
    counts(before, film);
    EXPECT_EQ(counts("open_ocean", film), counts("open_ocean", fresh)) << before;
    counts("open_ocean", film);
    EXPECT_EQ(film.statistics.splits + film.statistics.merges, 0) << before;
  }
}

TEST(FrameDeathTest, RefusesWhatItCannotDraw) {
  const World& world = shipped_world("open_ocean");
  Shot film(1);
  const View good = small_view(world, 0.0);
  EXPECT_DEATH(film.draw(world, good, NAN), "t_s=nan");
  EXPECT_DEATH(film.draw(world, good, INFINITY), "t_s=inf");
  const auto expect_view_refused = [&](auto&& change, const char* message) {
    View view = good;
    change(view);
    EXPECT_DEATH(film.draw(world, view, 0.0), message);
  };
  expect_view_refused([](View& v) { v.eye_world.y = NAN; }, "eye_world=\\(0, nan");
  expect_view_refused([](View& v) { v.forward.x = NAN; }, "axis=\\(nan");
  expect_view_refused([](View& v) { v.width_px = 0; }, "size=0x");
  expect_view_refused([](View& v) { v.height_px = 8193; }, "x8193");
  expect_view_refused([](View& v) { v.near_m = 0.0f; }, "near_m=0");
  expect_view_refused([](View& v) { v.tan_half_x = NAN; }, "tan_half=nan");
  const auto expect_refused = [&](const FrameOptions& options, const char* message) {
    EXPECT_DEATH(film.draw(world, good, 0.0, options), message);
  };
  expect_refused({.tile_size_px = 24}, "tile_size_px=24");
  expect_refused({.water_triangles = -1}, "triangles=-1");
  expect_refused({.terrain_triangles = 1}, "triangles=1");
  expect_refused({.triangle_capacity = 1000001}, "triangles=1000001");
  expect_refused({.lookup_scale = NAN}, "lookup_scale=nan");
  expect_refused({.lookup_scale = 1e9}, "lookup_scale=1000000000");
  expect_refused({.background_error_px = NAN}, "background_error_px=nan");
  expect_refused({.picture_scale = 0.0}, "picture_scale=0");
  expect_refused({.lod_ms = NAN}, "lod_ms=nan");
  expect_refused({.lod_groups = 0}, "lod_groups=0");
}

TEST(FrameDeathTest, RefusesWhatWasMovedFrom) {
  World world(load_shipped("open_ocean"));
  const View view = small_view(world, 0.0);
  const World taken = std::move(world);
  Shot film(1);
  // NOLINTBEGIN(bugprone-use-after-move): that is what the test is about
  EXPECT_DEATH(world.scene(), "the World was moved from");
  EXPECT_DEATH(film.draw(world, view, 0.0), "the World was moved from");
  Workspace other = std::move(film.workspace);
  EXPECT_DEATH(film.draw(taken, view, 0.0), "the Workspace was moved from");
  film.workspace = std::move(other);  // good again
  // NOLINTEND(bugprone-use-after-move)
  film.draw(taken, view, 0.0, few_triangles());
}

TEST(Frame, LinearPictureHoldsOnlyFiniteRadiance) {
  const Shot shot =
      small_shot(shipped_world("lagoon"), 2.0, {.water_triangles = 4000, .keep_linear = true});
  ASSERT_EQ(shot.target.linear.size(), std::size_t{3} * kSmallWidth * kSmallHeight);
  for (const float x : shot.target.linear) ASSERT_TRUE(std::isfinite(x) && x >= 0.0f) << x;
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

std::uint64_t object_pixels(const FrameState& state) {
  return static_cast<std::uint64_t>(std::ranges::count_if(
      state.visibility.primitive,
      [&](std::uint32_t p) { return state.window.primitives.holds(SurfaceKind::kObjects, p); }));
}

// A ball of radius r at distance d fills a cone of half angle asin(r / d); near the middle of the
// picture that is pi (f tan(angle))^2 pixels.
TEST(Objects, ABallOnTheWaterCoversTheAreaOfItsDisc) {
  const scene::Scene scene = calm_scene(scene::ObjectKind::kSphere, 8.0, 0.0);
  const World world = world_of(scene);
  const int height_px = 400;
  const Shot shot(world, view_of(world, 0.0, 400, height_px), 0.0, few_triangles());
  const double focal_px = 0.5 * height_px / std::tan(0.5 * scene.camera.fov_y_rad);
  const double radius_px = focal_px * std::tan(std::asin(4.0 / 40.0));
  const double expected = 3.14159265 * radius_px * radius_px;
  // Flat sides take 1 % away.
  EXPECT_NEAR(static_cast<double>(object_pixels(shot.state())), 0.99 * expected, 0.01 * expected);
}

TEST(Objects, ABoxShowsItselfAndItsMirrorImageAndNothingElseChanges) {
  const scene::Scene scene = calm_scene(scene::ObjectKind::kBox, 4.0, 0.0);
  scene::Scene empty = scene;
  empty.objects.clear();
  FrameOptions options = {.water_triangles = 4000, .without = {Part::kShadows, Part::kHulls}};
  options.shading = scene::ShadingRate::kFull;
  const Target with = small_shot(world_of(scene), 0.0, options).target;
  const Target without = small_shot(world_of(empty), 0.0, options).target;
  // The eye is as high as the box: the box's top lies at the horizon, and the mirror image is as
  // high as the box.
  const double focal_px = 0.5 * kSmallHeight / std::tan(0.5 * scene.camera.fov_y_rad);
  const double half_px = focal_px * 2.0 / 38.0, level_px = focal_px * 4.0 / 38.0;
  int changed = 0, changed_far = 0;
  for (int y = 0; y < kSmallHeight; ++y) {
    for (int x = 0; x < kSmallWidth; ++x) {
      const auto i = static_cast<std::size_t>(y) * kSmallWidth + x;
      if (with.rgba[i] == without.rgba[i]) continue;
      ++changed;
      const double right = std::abs(x + 0.5 - 0.5 * kSmallWidth),
                   down = y + 0.5 - 0.5 * kSmallHeight;
      // A planar map's texel is two pixels, and a bilinear sample reads one further.
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
  EXPECT_EQ(
      difference(small_shot(world_of(scene), 0.0).target, small_shot(world_of(empty), 0.0).target),
      "");
}

}  // namespace
}  // namespace swell::render
