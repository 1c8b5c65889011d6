// Whether far water shimmers: pixels that flicker from frame to frame.
#include <gtest/gtest.h>

#include <vector>

#include "render/drawn_shots.h"

namespace swell::render {
namespace {

constexpr glm::ivec2 kSize_px(320, 180);
constexpr int kFrames = 30, kStep = 25;  // of 255

// The part of the pixels whose green turns round by more than kStep each way, between a frame and
// its neighbours at 60 frames a second.
double part_reversed(const scene::Scene& scene, PartSet without) {
  const World world(scene);
  Workers workers(2);
  Workspace workspace;
  FrameOptions options;
  options.without = without;
  options.edge_samples = 0;
  std::vector<Target> targets(kFrames);
  for (int n = 0; n < kFrames; ++n) {
    const double t_s = n / 60.0;
    const View view = scene::camera_view(scene.camera, t_s, kSize_px.x, kSize_px.y);
    render_frame(world, view, t_s, options, workspace, targets[static_cast<std::size_t>(n)],
                 workers);
  }
  std::size_t reversed = 0, all = 0;
  for (std::size_t n = 1; n + 1 < kFrames; ++n) {
    for (std::size_t i = 0; i < targets[n].rgba.size(); ++i, ++all) {
      const auto green = [&](std::size_t frame) {
        return static_cast<int>(targets[frame].rgba[i] >> 8 & 255);
      };
      const int before = green(n) - green(n - 1), after = green(n + 1) - green(n);
      reversed += (before > kStep && after < -kStep) || (before < -kStep && after > kStep);
    }
  }
  return static_cast<double>(reversed) / static_cast<double>(all);
}

TEST(Shimmer, IsNotSeenOnGrazingWavesThroughALongLens) {
  const scene::Scene scene =
      scene::load_scene(std::string(SWELL_SOURCE_DIR) + "/tests/scenes/telephoto.toml");
  const double drawn = part_reversed(scene, {});
  PartSet seen_slopes;
  seen_slopes.add(Part::kSeenSlopes);
  const double all_slopes = part_reversed(scene, seen_slopes);
  EXPECT_LT(drawn, 0.002);
  EXPECT_GT(all_slopes, 2.0 * drawn);  // without what mends it there is more
}

}  // namespace
}  // namespace swell::render
