// Whether far water shimmers: pixels that flicker from frame to frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "render/drawn_shots.h"

namespace swell::render {
namespace {

constexpr glm::ivec2 kSize_px(320, 180);
constexpr int kFrames = 30, kStep = 25;  // of 255

// Green of kSize_px pixels, each the mean of `times` x `times` of a larger picture.
std::vector<int> green_of(const Target& target, int times) {
  std::vector<int> green(static_cast<std::size_t>(kSize_px.x) * kSize_px.y);
  for (int y = 0; y < target.height_px; ++y)
    for (int x = 0; x < target.width_px; ++x)
      green[static_cast<std::size_t>(y / times * kSize_px.x + x / times)] += static_cast<int>(
          target.rgba[static_cast<std::size_t>(y * target.width_px + x)] >> 8 & 255);
  for (int& g : green) g /= times * times;
  return green;
}

// The part of the pixels whose green turns round by more than kStep each way, between a frame and
// its neighbours at 60 frames a second. `times`: of pixels that are means of so many each way.
double part_reversed(const World& world, const scene::Camera& camera, int times = 1) {
  Workers workers(2);
  Workspace workspace;
  Target target;
  FrameOptions options;
  options.edge_samples = 0;
  std::vector<std::vector<int>> green;
  for (int n = 0; n < kFrames; ++n) {
    const double t_s = n / 60.0;
    const View view = scene::camera_view(camera, t_s, times * kSize_px.x, times * kSize_px.y);
    render_frame(world, view, t_s, options, workspace, target, workers);
    green.push_back(green_of(target, times));
  }
  std::size_t reversed = 0, all = 0;
  for (std::size_t n = 1; n + 1 < kFrames; ++n) {
    for (std::size_t i = 0; i < green[n].size(); ++i, ++all) {
      const int before = green[n][i] - green[n - 1][i], after = green[n + 1][i] - green[n][i];
      reversed += (before > kStep && after < -kStep) || (before < -kStep && after > kStep);
    }
  }
  return static_cast<double>(reversed) / static_cast<double>(all);
}

// While the sequence lasts.
double highest_water_m(const scene::Scene& scene, glm::dvec2 place) {
  const scene::Water water(scene);
  Workers workers(2);
  ocean::SeaFrame frame;
  float highest_m = 0.0f;
  for (int n = 0; n < kFrames; n += 5)
    highest_m = std::max(highest_m, water.at(n / 60.0, frame, workers).height(place));
  return static_cast<double>(highest_m);
}

scene::Scene telephoto_scene() {
  return scene::load_scene(std::string(SWELL_SOURCE_DIR) + "/tests/scenes/telephoto.toml");
}

TEST(Shimmer, IsNotSeenOnGrazingWavesThroughALongLens) {
  const World world(telephoto_scene());
  EXPECT_LT(part_reversed(world, world.scene().camera), 0.002);
}

// The telephoto's camera, so high above the water that passes below it.
scene::Camera camera_above(const World& world, double above_m) {
  scene::Camera camera = world.scene().camera;
  camera.eye_m.z = above_m + highest_water_m(world.scene(), glm::dvec2(camera.eye_m));
  return camera;
}

TEST(Shimmer, IsNotSeenFromAnyHeight) {
  struct Case {
    double wind_mps, above_m, fov_deg;
  };
  for (const Case& c : {Case{2.0, 0.3, 10.0},
                        {2.0, 2.0, 10.0},
                        {2.0, 60.0, 10.0},
                        {5.0, 20.0, 3.0},
                        {12.0, 20.0, 3.0},
                        {12.0, 60.0, 10.0},
                        {20.0, 20.0, 3.0}}) {
    scene::Scene scene = telephoto_scene();
    scene.sea.wind_speed_mps = c.wind_mps;
    scene.camera.fov_y_rad = scene::radians(c.fov_deg);
    const World world(scene);
    EXPECT_LT(part_reversed(world, camera_above(world, c.above_m)), 0.002)
        << c.wind_mps << " m/s, " << c.above_m << " m, " << c.fov_deg << " degrees";
  }
}

// Near waves of a breeze move by pixels a frame, which turns some round in pictures without any
// fault too: as many are in pictures of three times the pixels each way.
TEST(Shimmer, OfNearWavesIsTheirMotion) {
  struct Case {
    double wind_mps, above_m, fov_deg;
  };
  for (const Case& c : {Case{5.0, 2.0, 3.0},
                        {12.0, 0.3, 10.0},
                        {12.0, 2.0, 10.0},
                        {12.0, 2.0, 3.0},
                        {20.0, 2.0, 10.0}}) {
    scene::Scene scene = telephoto_scene();
    scene.sea.wind_speed_mps = c.wind_mps;
    scene.camera.fov_y_rad = scene::radians(c.fov_deg);
    const World world(scene);
    const scene::Camera camera = camera_above(world, c.above_m);
    EXPECT_LT(part_reversed(world, camera), part_reversed(world, camera, 3) + 0.002)
        << c.wind_mps << " m/s, " << c.above_m << " m, " << c.fov_deg << " degrees";
  }
}

}  // namespace
}  // namespace swell::render
