// An eye that goes through the surface, frame by frame, in calm and in storm.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "ocean/water_surface.h"
#include "render/measures.h"
#include "render/shot.h"
#include "render/world/world_state.h"
#include "terrain/height_grid.h"
#include "trials.h"

namespace swell::render {
namespace {

constexpr int kDivingWidth = 96, kDivingHeight = 54;
constexpr double kFrame_s = 1.0 / 120.0, kSinks_m = 0.003;  // a frame, against the water there
constexpr glm::dvec2 kPlace_m{0.0, -600.0};

// With a raft and a buoy near by; without wind the sea is flat.
scene::Scene sea_of(double wind_mps) {
  scene::Scene scene;
  scene.sea.wind_speed_mps = wind_mps;
  scene.sea.patch_lengths_m = {97.0, 23.0, 5.3};
  scene.detail.water_triangles = 12000;
  scene.detail.terrain_triangles = 2000;
  scene.terrain.emplace();
  scene.terrain->floor_depth_m = 12.0;
  scene.terrain->island_height_m = 0.0;
  scene.objects.resize(2);
  scene.objects[0].position_m = kPlace_m + glm::dvec2(4.0, 12.0);
  scene.objects[1].kind = scene::ObjectKind::kBox;
  scene.objects[1].position_m = kPlace_m + glm::dvec2(-3.0, 9.0);
  return scene;
}

View eye_at(double z_m) {
  const scene::Camera camera{.eye_m = {kPlace_m, z_m}, .pitch_rad = 0.05, .fov_y_rad = 1.0};
  return scene::camera_view(camera, 0.0, kDivingWidth, kDivingHeight);
}

// The dry pixels from a column's top down, as they are drawn and as a query of the water has it.
struct DryRows {
  int drawn = 0, asked = 0;
};

struct Diver : Shot {
  explicit Diver(const World& in) : world(in) {}

  void draw(const View& seen, double t_s) {
    FrameOptions options{.keep_linear = true};
    options.labels.add(Label::kFlags);
    Shot::draw(world, seen, t_s, options);
  }

  // Returns the water's height in the last frame.
  double height_m(glm::dvec2 place_m) const {
    return static_cast<double>(water_surface(world.state(), *state().sea).height(place_m));
  }
  DryRows dry_rows(int x) const {
    DryRows rows;
    for (int y = 0; y < kDivingHeight; ++y) {
      rows.drawn += (target.labels.flags[at(x, y)] & kSeenInWater) == 0;
      const glm::vec3 ray = view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const glm::dvec3 begins = view.eye_world + glm::dvec3(view.near_m * ray);
      rows.asked += begins.z >= height_m(glm::dvec2(begins));
    }
    return rows;
  }

  const World& world;
};

// The median of what lies up to four before and after the i-th.
double median_around(const std::vector<double>& all, std::size_t i) {
  std::vector<double> near;
  for (std::size_t k = i < 4 ? 0 : i - 4; k <= std::min(i + 4, all.size() - 1); ++k)
    if (k != i) near.push_back(all[k]);
  std::ranges::nth_element(near, near.begin() + near.size() / 2);
  return near[near.size() / 2];
}

class Diving : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Winds, Diving, testing::Values(0.0, 4.0, 8.0, 13.0, 22.0));

// No blank, no dark pixel and no flash: no picture differs from the one before by 1 % of white more
// than those around do. The water line of each column lies within two pixels of where a query puts
// it: the drawn triangles miss the water by a few millimetres, of which a pixel has five.
TEST_P(Diving, IsOneSmoothWayThroughTheSurface) {
  const World world = world_of(sea_of(GetParam()));
  Diver diver(world);
  // Fewer of them are those about the middle.
  constexpr int kFrames = 300;
  const int frames = trials(kFrames), first = (kFrames - frames) / 2;
  Target before;
  std::vector<double> steps;
  int cut = 0;
  diver.draw(eye_at(3.0), 10.0 + kFrame_s * (first - 1));
  for (int i = first; i < first + frames; ++i) {
    diver.draw(eye_at(diver.height_m(kPlace_m) + kSinks_m * (kFrames / 2 - i)),
               10.0 + kFrame_s * i);
    const Target& target = diver.target;
    for (std::size_t k = 0; k < target.linear.size(); k += 3) {
      const float light = target.linear[k] + target.linear[k + 1] + target.linear[k + 2];
      ASSERT_TRUE(std::isfinite(light) && light > 0.005f) << i << ' ' << k / 3 << ' ' << light;
    }
    if (!before.rgba.empty()) steps.push_back(mean_difference(before, target) / 255.0);
    before = target;
    for (int x = 0; x < kDivingWidth; x += 5) {
      const DryRows rows = diver.dry_rows(x);
      EXPECT_LE(std::abs(rows.drawn - rows.asked), 2) << i << ' ' << x;
      cut += rows.drawn > 0 && rows.drawn < kDivingHeight;
    }
  }
  EXPECT_GT(cut, frames);
  for (std::size_t i = 0; i < steps.size(); ++i)
    EXPECT_LT(steps[i], 0.01 + median_around(steps, i)) << i;
}

}  // namespace
}  // namespace swell::render
