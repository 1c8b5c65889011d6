// scenes/everything.toml shows what it is there for, in its own camera's picture.
#include <gtest/gtest.h>

#include "render/measures.h"
#include "render/shot.h"
#include "render/world_view.h"

namespace swell::render {
namespace {

class Everything : public testing::Test {
 protected:
  const Target& draw(PartSet without) {
    constexpr double kTime_s = 5.0;
    const World& world = shipped_world("everything");
    return film_.draw(world, world_view(world, kTime_s, 160, 90, sea_, film_.workers), kTime_s,
                      {.edge_samples = 0, .without = without});
  }

  double stage_ms(Stage stage) const {
    return film_.statistics.stage_ms[static_cast<std::size_t>(stage)];
  }

  Shot film_;
  ocean::SeaFrame sea_;
};

// Caustics are not among them: the picture is too coarse for them.
constexpr Part kParts[] = {Part::kImplicits,    Part::kTrees,        Part::kRivers,
                           Part::kVolumeClouds, Part::kCloudShadows, Part::kWakes,
                           Part::kSurfFronts,   Part::kHaze,         Part::kShadows,
                           Part::kReflection,   Part::kRefraction};

TEST_F(Everything, IsInThePicture) {
  const Target all = draw({});
  for (const Part part : kParts)
    EXPECT_GE(different_pixels(all, draw({part})), 10) << part_name(part);
}

TEST_F(Everything, CanBeLeftOutAllAtOnce) {
  const Target all = draw({});
  PartSet parts;
  for (const Part part : kParts) parts.add(part);
  EXPECT_GE(different_pixels(all, draw(parts)), 10000);
}

TEST_F(Everything, StagesTakeTheTimeOfWhatIsDrawnInThem) {
  draw({});
  for (const Stage stage : {Stage::kTrees, Stage::kRays, Stage::kClouds})
    EXPECT_GT(stage_ms(stage), 0.0) << stage_name(stage);
  double sum_ms = 0.0;
  for (const double ms : film_.statistics.stage_ms) {
    EXPECT_GE(ms, 0.0);
    sum_ms += ms;
  }
  // Stages follow one another, but for the first two, which run side by side.
  EXPECT_LE(sum_ms - stage_ms(Stage::kSea) - stage_ms(Stage::kTriangulate),
            film_.statistics.frame_ms);
  draw({Part::kImplicits});
  EXPECT_EQ(stage_ms(Stage::kRays), 0.0);
}

// scenes/everything_rays.toml: the same things, with all land found by rays, and one map.
TEST(EverythingRays, HasItsLandByRaysAndWavesOfAMapBesides) {
  scene::Scene scene = load_shipped("everything_rays");
  ASSERT_EQ(scene.detail.terrain_method, scene::TerrainMethod::kRays);
  ASSERT_EQ(scene.sea.maps.size(), 1u);
  ASSERT_TRUE(scene.sea.spectrum);
  EXPECT_EQ(scene.objects.size(), shipped_world("everything").scene().objects.size());
  const World world = world_of(scene);
  scene.sea.maps.clear();
  const World without_map = world_of(scene);
  ocean::SeaFrame sea;
  Workers workers(2);
  const View view = world_view(world, 5.0, 160, 90, sea, workers);
  const Shot drawn(world, view, 5.0, {.edge_samples = 0});
  EXPECT_EQ(drawn.statistics.terrain_triangles, 0);
  EXPECT_GT(drawn.statistics.stage_ms[static_cast<std::size_t>(Stage::kRays)], 0.0);
  EXPECT_GE(
      different_pixels(drawn.target, Shot(without_map, view, 5.0, {.edge_samples = 0}).target),
      3000);
}

}  // namespace
}  // namespace swell::render
