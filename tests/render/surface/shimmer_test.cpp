// Whether far water shimmers: pixels that flicker from frame to frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <vector>

#include "render/measures.h"
#include "render/shot.h"
#include "scene/water.h"

namespace swell::render {
namespace {

constexpr glm::ivec2 kShimmerSize_px(320, 180);
constexpr int kFrames = 30, kStep = 25;  // of 255

// Green of kShimmerSize_px pixels, each the mean of `times` x `times` of a larger picture.
std::vector<int> green_of(const Target& target, int times) {
  const std::vector<int> codes = green_codes(target);
  std::vector<int> green(static_cast<std::size_t>(kShimmerSize_px.x) * kShimmerSize_px.y);
  for (int y = 0; y < target.height_px; ++y)
    for (int x = 0; x < target.width_px; ++x)
      green[static_cast<std::size_t>(y / times * kShimmerSize_px.x + x / times)] +=
          codes[static_cast<std::size_t>(y * target.width_px + x)];
  for (int& g : green) g /= times * times;
  return green;
}

// The part of the pixels whose green turns round by more than kStep each way, between a frame and
// its neighbours at 60 frames a second. `times`: of pixels that are means of so many each way.
double shimmer(const World& world, const scene::Camera& camera, int times = 1) {
  Shot film;
  std::vector<std::vector<int>> green;
  for (int n = 0; n < kFrames; ++n) {
    const double t_s = n / 60.0;
    const View view =
        scene::camera_view(camera, t_s, times * kShimmerSize_px.x, times * kShimmerSize_px.y);
    green.push_back(green_of(film.draw(world, view, t_s, {.edge_samples = 0}), times));
  }
  return part_reversed(green, kStep);
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
  return scene::load_scene(SWELL_SOURCE_DIR "/tests/scenes/telephoto.toml");
}

TEST(Shimmer, IsNotSeenOnGrazingWavesThroughALongLens) {
  const World world = world_of(telephoto_scene());
  EXPECT_LT(shimmer(world, world.scene().camera), 0.002);
}

// The telephoto's camera, so high above the water that passes below it.
struct Case {
  double wind_mps, above_m, fov_deg;

  World world() const {
    scene::Scene scene = telephoto_scene();
    scene.sea.wind_speed_mps = wind_mps;
    scene.camera.fov_y_rad = radians(fov_deg);
    return world_of(scene);
  }
  scene::Camera camera(const scene::Scene& scene) const {
    scene::Camera camera = scene.camera;
    camera.eye_m.z = above_m + highest_water_m(scene, glm::dvec2(camera.eye_m));
    return camera;
  }
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.wind_mps << " m/s, " << c.above_m << " m, " << c.fov_deg << " degrees";
}

TEST(Shimmer, IsNotSeenFromAnyHeight) {
  for (const Case& c : {Case{2.0, 0.3, 10.0},
                        {2.0, 2.0, 10.0},
                        {2.0, 60.0, 10.0},
                        {5.0, 20.0, 3.0},
                        {12.0, 20.0, 3.0},
                        {12.0, 60.0, 10.0},
                        {20.0, 20.0, 3.0}}) {
    const World world = c.world();
    EXPECT_LT(shimmer(world, c.camera(world.scene())), 0.002) << c;
  }
}

// Near waves of a breeze move by pixels a frame, which turns some round in pictures without any
// fault too: as many are in pictures of three times the pixels each way.
TEST(Shimmer, OfNearWavesIsTheirMotion) {
  for (const Case& c : {Case{5.0, 2.0, 3.0},
                        {12.0, 0.3, 10.0},
                        {12.0, 2.0, 10.0},
                        {12.0, 2.0, 3.0},
                        {20.0, 2.0, 10.0}}) {
    const World world = c.world();
    const scene::Camera camera = c.camera(world.scene());
    EXPECT_LT(shimmer(world, camera), shimmer(world, camera, 3) + 0.002) << c;
  }
}

}  // namespace
}  // namespace swell::render
