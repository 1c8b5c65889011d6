// What of the water's time does not grow with the scene: pixels are shaded, not triangles. The
// paper's table 2 has a tenth of the time for the smallest scene and nothing for the largest.
// Source: Ma, Zhu, Gong, 2006.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "apps/bench/optics_table.h"

namespace swell::apps {
namespace {

struct TimedScene {
  StillScene still;
  render::Workspace workspace = {};
  double least_ms = 1e9;
};

// By turns, so that a slow moment of the machine slows all of them.
void time_scenes(std::vector<TimedScene>& all, Workers& workers) {
  render::Target target;
  for (int k = 0; k < 25; ++k)
    for (TimedScene& timed : all) {
      const StillScene& still = timed.still;
      const auto drawn = render_frame(still.world, still.view, k / 60.0, still.frame,
                                      timed.workspace, target, workers);
      const double ms = drawn.stage_ms[static_cast<std::size_t>(render::Stage::kShade)];
      timed.least_ms = std::min(timed.least_ms, ms);
    }
}

// Three times the triangles, the same pixels. Least times of more and more frames: those of a busy
// machine come down to each other, or a true difference stays.
TEST(WaterTime, ShadingDoesNotGrowWithTheScenesTriangles) {
  FrameSetup setup;
  setup.size = {480, 270};
  setup.frame.edge_samples = 0;  // edges between things are the more, the more triangles there are
  const render::World world(scene::load_scene(SWELL_SOURCE_DIR "/scenes/harbour.toml"));
  Workers workers(1);
  std::vector<TimedScene> all;
  for (const int triangles : {13912, 41736}) {
    auto still = make_still_scene(world, setup, triangles, workers);
    ASSERT_TRUE(still);
    all.push_back({*std::move(still)});
  }
  for (int attempt = 0; attempt < 8; ++attempt) {
    time_scenes(all, workers);
    if (all[1].least_ms < 1.05 * all[0].least_ms) break;
  }
  EXPECT_LT(all[1].least_ms, 1.05 * all[0].least_ms);
}

}  // namespace
}  // namespace swell::apps
