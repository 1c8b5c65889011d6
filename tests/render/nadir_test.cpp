// Looking straight down, where azimuths meet.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>

#include "render/frame.h"
#include "scene/scene.h"

namespace swell::render {
namespace {

constexpr int kSize = 256;

Target draw_down(const scene::Scene& scene) {
  const World world(scene);
  Workers workers(2);
  Workspace workspace;
  Target target;
  const View view = make_view(scene.camera.eye_m, 0.3, -0.5 * std::numbers::pi,
                              scene.camera.fov_y_rad, 0.25f, kSize, kSize);
  render_frame(world, view, 0.0, {}, workspace, target, workers);
  return target;
}

int largest_step(const Target& target) {
  int largest = 0;
  const auto step = [&](int i, int j) {
    for (int shift = 0; shift < 24; shift += 8) {
      const auto byte = [&](int k) { return static_cast<int>(target.rgba[k] >> shift & 255); };
      largest = std::max(largest, std::abs(byte(i) - byte(j)));
    }
  };
  for (int y = 0; y + 1 < kSize; ++y) {
    for (int x = 0; x + 1 < kSize; ++x) {
      step(y * kSize + x, y * kSize + x + 1);
      step(y * kSize + x, (y + 1) * kSize + x);
    }
  }
  return largest;
}

// Under a low sun the horizon's colour changes much with the azimuth.
TEST(Nadir, NoStarShowsInTheHaze) {
  scene::Scene scene =
      scene::load_scene(std::string(SWELL_SOURCE_DIR) + "/tests/scenes/nadir.toml");
  ASSERT_EQ(scene.camera.eye_m.z, 3000.0);
  scene.sea.wind_speed_mps = 0.0;  // nothing but the haze
  const Target target = draw_down(scene);
  EXPECT_LE(largest_step(target), 2);
  // There is something to see: the side of the sun is lighter.
  const auto [least, most] =
      std::ranges::minmax_element(target.rgba, {}, [](std::uint32_t p) { return p & 255; });
  EXPECT_GT((*most & 255) - (*least & 255), 10u);
}

}  // namespace
}  // namespace swell::render
