// Looking straight down, where azimuths meet.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "render/shot.h"

namespace swell::render {
namespace {

constexpr int kNadirSize = 256;

int largest_step(const Shot& shot) {
  glm::ivec3 largest(0);
  for (int y = 0; y + 1 < kNadirSize; ++y)
    for (int x = 0; x + 1 < kNadirSize; ++x)
      for (const glm::ivec3& beside : {shot.codes(x + 1, y), shot.codes(x, y + 1)})
        largest = glm::max(largest, glm::abs(shot.codes(x, y) - beside));
  return std::max({largest.r, largest.g, largest.b});
}

// Under a low sun the horizon's colour changes much with the azimuth.
TEST(Nadir, NoStarShowsInTheHaze) {
  scene::Scene scene = scene::load_scene(SWELL_SOURCE_DIR "/tests/scenes/nadir.toml");
  ASSERT_EQ(scene.camera.eye_m.z, 3000.0);
  scene.sea.wind_speed_mps = 0.0;  // nothing but the haze
  const World world = world_of(scene);
  const View view = make_view(scene.camera.eye_m, 0.3, -0.5 * std::numbers::pi,
                              scene.camera.fov_y_rad, 0.25f, kNadirSize, kNadirSize);
  const Shot shot(world, view, 0.0);
  EXPECT_LE(largest_step(shot), 2);
  // There is something to see: the side of the sun is lighter.
  const auto [least, most] =
      std::ranges::minmax_element(shot.target.rgba, {}, [](std::uint32_t p) { return p & 255; });
  EXPECT_GT((*most & 255) - (*least & 255), 10u);
}

}  // namespace
}  // namespace swell::render
