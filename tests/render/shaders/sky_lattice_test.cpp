// The sky of pictures, which is found at nodes and lies on lines between them, against the sky
// found at each pixel.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "render/shaders/shader_kernels.h"
#include "render/shot.h"
#include "sky/sky_light.h"

namespace swell::render {
namespace {

struct Looking {
  const char* name;
  double pitch_deg, fov_deg, cloud_cover;
};

class SkyLattice : public testing::TestWithParam<Looking> {
 protected:
  // Tiles that are cut, too. Pixels as large as may be.
  static constexpr int kWidth_px = 650, kHeight_px = 90;

  SkyLattice() : world(world_of(scene_of(GetParam()))) {
    const Looking& looking = GetParam();
    const View view = make_view({0.0, 0.0, 10.0}, 0.0, radians(looking.pitch_deg),
                                radians(looking.fov_deg), 0.25f, kWidth_px, kHeight_px);
    shot.draw(world, view, 3.0, {.keep_linear = true});
    std::vector<float> x, y;
    for (int i = 0; i < kWidth_px * kHeight_px; ++i) {
      x.push_back(static_cast<float>(i % kWidth_px));
      y.push_back(static_cast<float>(i / kWidth_px));
    }
    alone.resize(x.size());
    sky_light(shot.state().shading, x, y, alone);
    // The sky's rows, but for the step next to the horizon, where it ends.
    for (int i = 0; i < kHeight_px; ++i)
      if (view.ray(0.5f * kWidth_px, static_cast<float>(i) + 4.5f).z > 0.0f) rows = i + 1;
  }

  static scene::Scene scene_of(const Looking& looking) {
    scene::Scene scene;
    scene.sky.sun_elevation_rad = radians(25.0);
    scene.sky.sun_azimuth_rad = radians(5.0);
    scene.sky.sun_direction =
        sky::sun_direction(scene.sky.sun_azimuth_rad, scene.sky.sun_elevation_rad);
    scene.sky.cloud_cover = looking.cloud_cover;
    scene.sea.resolution = 16;
    scene.detail.water_triangles = 100;
    return scene;
  }

  World world;
  Shot shot;
  std::vector<glm::vec3> alone;
  int rows = 0;
};

TEST_P(SkyLattice, IsTheSkyOfEachPixel) {
  ASSERT_GE(rows, 30);
  double squares = 0.0, most = 0.0;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < kWidth_px; ++x) {
      const glm::vec3 expected = alone[shot.at(x, y)];
      const glm::vec3 error = (shot.linear(x, y) - expected) / (0.05f + expected);
      squares += glm::dot(error, error) / 3.0;
      most = std::max({most, std::abs(double(error.x)), std::abs(double(error.z))});
    }
  const double rms = std::sqrt(squares / (rows * kWidth_px));
  RecordProperty("rms", std::to_string(rms));
  RecordProperty("most", std::to_string(most));
  const bool clear = GetParam().cloud_cover == 0.0;
  EXPECT_LT(rms, clear ? 5e-4 : 1.5e-2);
  EXPECT_LT(most, clear ? 6e-3 : 0.25);
}

INSTANTIATE_TEST_SUITE_P(
    Views, SkyLattice,
    testing::Values(Looking{"clear_sun", 22.0, 7.5, 0.0}, Looking{"clear_low", 4.0, 7.5, 0.0},
                    Looking{"clear_tele", 25.0, 1.0, 0.0}, Looking{"clear_up", 88.0, 7.5, 0.0},
                    Looking{"clouds", 20.0, 7.5, 0.4}, Looking{"clouds_low", 4.0, 7.5, 0.4},
                    Looking{"clouds_tele", 10.0, 2.0, 0.4}, Looking{"clouds_up", 88.0, 7.5, 0.4}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace swell::render
