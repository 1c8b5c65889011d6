// scenes/everything.toml shows what it is there for, in its own camera's picture.
#include <gtest/gtest.h>

#include "render/frame.h"
#include "render/world/world_view.h"

namespace swell::render {
namespace {

// Made once: it takes longer than drawing it.
const World& everything() {
  static const World world(scene::load_scene(SWELL_SOURCE_DIR "/scenes/everything.toml"), 2);
  return world;
}

class Everything : public testing::Test {
 protected:
  Target draw(PartSet without) {
    FrameOptions options;
    options.edge_samples = 0;
    options.without = without;
    const View view = world_view(world_, kTime_s, 160, 90, sea_, workers_);
    Target target;
    statistics_ = render_frame(world_, view, kTime_s, options, workspace_, target, workers_);
    return target;
  }

  double stage_ms(Stage stage) const {
    return statistics_.stage_ms[static_cast<std::size_t>(stage)];
  }

  static constexpr double kTime_s = 5.0;
  const World& world_ = everything();
  Workers workers_{2};
  Workspace workspace_;
  ocean::SeaFrame sea_;
  FrameStatistics statistics_;
};

TEST_F(Everything, IsInThePicture) {
  const Target all = draw({});  // too coarse for caustics, which are seen from near
  for (const Part part : {Part::kForms, Part::kTrees, Part::kRivers, Part::kVolumeClouds,
                          Part::kCloudShadows, Part::kWakes, Part::kSurfFronts, Part::kHaze,
                          Part::kShadows, Part::kReflection, Part::kRefraction}) {
    const Target without = draw({part});
    int changed = 0;
    for (std::size_t i = 0; i < all.rgba.size(); ++i) changed += all.rgba[i] != without.rgba[i];
    EXPECT_GE(changed, 10) << part_name(part);
  }
}

TEST_F(Everything, StagesTakeTheTimeOfWhatIsDrawnInThem) {
  draw({});
  for (const Stage stage : {Stage::kTrees, Stage::kRays, Stage::kClouds})
    EXPECT_GT(stage_ms(stage), 0.0) << stage_name(stage);
  double sum_ms = 0.0;
  for (const double ms : statistics_.stage_ms) {
    EXPECT_GE(ms, 0.0);
    sum_ms += ms;
  }
  // Stages follow one another, but for the first two, which run side by side.
  EXPECT_LE(sum_ms - stage_ms(Stage::kSea) - stage_ms(Stage::kTriangulate), statistics_.frame_ms);
  draw({Part::kForms});
  EXPECT_EQ(stage_ms(Stage::kRays), 0.0);
}

}  // namespace
}  // namespace swell::render
