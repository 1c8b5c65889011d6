// Frames have the same bits however they are made: by any threads, SIMD target and tiles, alone or
// in a sequence, and a loop apart.
#include <gtest/gtest.h>

#include "float_control.h"
#include "math/simd_target.h"
#include "render/measures.h"
#include "render/shot.h"
#include "sky/sky_light.h"

namespace swell::render {
namespace {

class SameBits : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, SameBits,
                         testing::Values("open_ocean", "lagoon", "sines", "beach", "buoys",
                                         "harbour", "waves_maps"),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(SameBits, ThreadCountChangesNoPixel) {
  const World& world = shipped_world(GetParam());
  const auto draw = [&](int threads) {
    return small_shot(world, 2.0, few_triangles(), threads).target;
  };
  const Target reference = draw(1);
  for (const int threads : {2, 3, 7})
    EXPECT_EQ(difference(draw(threads), reference), "") << threads;
}

TEST_P(SameBits, SimdTargetChangesNoPixel) {
  if (!simd_target_available(SimdTarget::kAvx512)) GTEST_SKIP() << "this CPU has no AVX-512";
  const World& world = shipped_world(GetParam());
  select_simd_target(SimdTarget::kAvx512);
  const Target wide = small_shot(world, 2.0).target;
  select_simd_target(simd_targets().front());
  EXPECT_EQ(difference(wide, small_shot(world, 2.0).target), "");
  const World narrow_world(load_shipped(GetParam()));  // its maps made on AVX2, too
  EXPECT_EQ(difference(small_shot(narrow_world, 2.0).target, wide), "");
  select_simd_target(SimdTarget::kAvx512);
}

TEST_P(SameBits, TileSizeChangesNoPixel) {
  const World& world = shipped_world(GetParam());
  const auto draw_in = [&](int tile) {
    return small_shot(world, 2.0, {.tile_size_px = tile, .water_triangles = 4000}).target;
  };
  const Target reference = draw_in(64);
  for (const int tile : {16, 32}) EXPECT_EQ(difference(draw_in(tile), reference), "") << tile;
}

Target draw_in_tiles(const World& world, const View& view, int tile_size_px) {
  return Shot(world, view, 3.0, {.tile_size_px = tile_size_px, .water_triangles = 4000}).target;
}

// From aloft, of pixels so small that the air below lies between nodes.
TEST(FrameBits, TilesAndTargetsShowTheSameAir) {
  const World& world = shipped_world("lagoon");
  const View view = make_view({0.0, -900.0, 300.0}, 0.1, -0.3, 0.0014 * kSmallHeight, 0.25f,
                              kSmallWidth, kSmallHeight);
  const auto draw_in = [&](int tile) { return draw_in_tiles(world, view, tile); };
  const Target reference = draw_in(64);
  for (const int tile : {16, 32}) EXPECT_EQ(difference(draw_in(tile), reference), "") << tile;
  if (!simd_target_available(SimdTarget::kAvx512)) return;
  select_simd_target(simd_targets().front());
  EXPECT_EQ(difference(draw_in(64), reference), "");
  select_simd_target(SimdTarget::kAvx512);
}

// Where the maps of a coast end, what a packet skips depends on its other pixels.
TEST(FrameBits, PacketsOfAnyPixelsShowTheSameRimOfACoast) {
  const World& world = shipped_world("beach");
  const View view =
      make_view({590.0, 250.0, 8.0}, 0.2, -0.12, 0.9, 0.25f, kSmallWidth, kSmallHeight);
  const auto draw_in = [&](int tile) { return draw_in_tiles(world, view, tile); };
  const Target reference = draw_in(64);
  EXPECT_EQ(difference(draw_in(16), reference), "");
  select_simd_target(simd_targets().front());
  EXPECT_EQ(difference(draw_in(32), reference), "");
  if (simd_target_available(SimdTarget::kAvx512)) select_simd_target(SimdTarget::kAvx512);
}

// In a sequence.
const Target& draw_next(Shot& film, const World& world, double t_s,
                        const FrameOptions& options = few_triangles()) {
  return film.draw(world, view_of(world, t_s, kSmallWidth, kSmallHeight), t_s, options);
}

TEST_P(SameBits, FrameAloneEqualsFrameInSequence) {
  const World& world = shipped_world(GetParam());
  Shot film;
  for (const int k : {0, 1, 2, 3, 4, 5, 40, 7, 50}) draw_next(film, world, k / 25.0);
  EXPECT_EQ(difference(small_shot(world, 2.0).target, film.target), "");
}

TEST_P(SameBits, WorkspaceOfAnotherSizeAndSceneLeavesNoTrace) {
  const World &world = shipped_world(GetParam()), &other = shipped_world("lagoon");
  Shot film;
  film.draw(other, view_of(other, 1.0, 333, 77), 1.0,
            {.tile_size_px = 32, .water_triangles = 4000, .lookup_scale = 1.0});
  draw_next(film, world, 2.0);
  EXPECT_EQ(difference(small_shot(world, 2.0).target, film.target), "");
}

// A still camera, whose mesh is not written anew: but for another triangulation or more storage.
TEST(FrameBits, OtherTriangulationsInBetweenLeaveNoTrace) {
  const World &roam = shipped_world("open_ocean"), &radial = shipped_world("open_ocean_radial");
  Shot film;
  const auto frame = [&](const World& world, int capacity) -> const Target& {
    return draw_next(film, world, 2.0, {.water_triangles = 4000, .triangle_capacity = capacity});
  };
  const Target alone = small_shot(roam, 2.0).target;
  for (const int capacity : {0, 0, 9000})
    EXPECT_EQ(difference(alone, frame(roam, capacity)), "") << capacity;
  EXPECT_NE(difference(alone, frame(radial, 9000)), "");
  EXPECT_EQ(difference(alone, frame(roam, 9000)), "");
}

TEST(FrameBits, StorageForMoreTrianglesChangesNoPixel) {
  const World& world = shipped_world("lagoon");
  const Shot roomy = small_shot(world, 2.0, {.water_triangles = 4000, .triangle_capacity = 50000});
  EXPECT_EQ(difference(roomy.target, small_shot(world, 2.0).target), "");
}

// Constant frame time: a cut to another place is worked off over some frames.
TEST(FrameBits, BoundedTriangulationReachesThePictureOfOneWithoutBounds) {
  const World& world = shipped_world("lagoon");
  const FrameOptions unbounded = {.water_triangles = 4000, .terrain_triangles = 3000};
  const Target alone = small_shot(world, 2.0, unbounded).target;
  Shot film;
  const auto frame = [&](const FrameOptions& options, glm::dvec3 moved_m) {
    View view = view_of(world, 2.0, kSmallWidth, kSmallHeight);
    view.eye_world += moved_m;
    film.draw(world, view, 2.0, options);
    return film.statistics;
  };
  // The number of frames until nothing is left to do, whatever the group of priorities.
  const auto frames_to_settle = [&](const FrameOptions& options) {
    int frames = 0;
    for (int settled = 0; settled < options.lod_groups && frames < 1000; ++frames)
      settled = frame(options, {}).lod_stopped ? 0 : settled + 1;
    return frames;
  };

  FrameOptions by_work = unbounded, by_time = unbounded;
  by_work.lod_operations = 1000;
  const FrameStatistics first = frame(by_work, {});
  EXPECT_TRUE(first.lod_stopped);
  EXPECT_EQ(first.splits, 2 * 1000) << "sea and land";
  EXPECT_NE(difference(alone, film.target), "");
  EXPECT_GT(frames_to_settle(by_work), 1);
  EXPECT_EQ(difference(alone, film.target), "");

  by_time.lod_ms = 1e-3;  // over before it begins
  by_time.lod_groups = 3;
  frame(unbounded, {4.0, -3.0, 0.5});
  EXPECT_GT(frames_to_settle(by_time), 5);
  EXPECT_EQ(difference(alone, film.target), "");
}

TEST(FrameBits, CallersFloatEnvironmentChangesNoPixel) {
  const World& world = shipped_world("lagoon");
  const Shot reference = small_shot(world, 2.0);
  const std::uint64_t saved = float_control();
  set_float_control(saved | kFlushToZero);
  const Shot flushed = small_shot(world, 2.0);
  set_float_control(saved);
  EXPECT_EQ(difference(flushed.target, reference.target), "");
}

TEST(FrameBits, AWorldMadeLikeAnotherDrawsTheSamePicture) {
  const World& beach = shipped_world("beach");
  scene::Scene other_wind = beach.scene(), other_sun = beach.scene(), other_air = beach.scene(),
               painted = beach.scene(), other_all = shipped_world("open_ocean").scene();
  other_wind.sea.wind_speed_mps = 6.0;
  other_sun.sky.sun_elevation_rad = 0.3;
  other_sun.sky.sun_direction = sky::sun_direction(beach.scene().sky.sun_azimuth_rad, 0.3);
  other_air.sky.turbidity = 6.0;
  painted.sky.model = scene::SkyModel::kGradient;
  other_all.sea.seed += 1;
  for (const scene::Scene& scene : {other_wind, other_sun, other_air, painted, other_all}) {
    const World like(scene, beach, 1);
    EXPECT_EQ(difference(small_shot(like, 2.0).target, small_shot(World(scene), 2.0).target), "");
  }
}

// All that moves: waves, ripples, foam, surf, clouds, and what floats; paths are their own.
TEST_P(SameBits, ALoopEndsAsItBegan) {
  scene::Scene scene = shipped_world(GetParam()).scene();
  std::erase_if(scene.objects,
                [](const scene::FloatingObject& object) { return !object.path_m.empty(); });
  scene.sea.loop_s = 12.5;
  const World world(scene, shipped_world(GetParam()), 2);
  const Target first = small_shot(world, 1.75).target;
  EXPECT_EQ(difference(small_shot(world, 1.75 + 12.5).target, first), "");
  EXPECT_EQ(difference(small_shot(world, 1.75 - 25.0).target, first), "");
  EXPECT_NE(difference(small_shot(world, 1.75 + 6.0).target, first), "");
}

}  // namespace
}  // namespace swell::render
