// The drawn ground: where its map ends, and where triangles are few.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/labelled_frame.h"
#include "render/world/world_state.h"
#include "terrain/height_grid.h"

namespace swell::render {
namespace {

View view_down(glm::dvec3 eye) {
  return make_view(eye, 0.0, radians(-90.0), radians(60.0), 0.25f, 320, 240);
}

// The highest step of the ground's outline against the sea: land pixels beside water ones.
double highest_shore_m(const LabelledFrame& frame) {
  double highest_m = 0.0;
  const std::vector<std::uint32_t>& id = frame.labels().id;
  int pairs = 0;
  for (int y = 1; y < frame.view.height_px; ++y)
    for (int x = 1; x < frame.view.width_px; ++x)
      for (const glm::ivec2& other : {glm::ivec2(x - 1, y), glm::ivec2(x, y - 1)}) {
        const glm::ivec2 here(x, y);
        for (const auto& [land, water] : {std::pair(here, other), std::pair(other, here)}) {
          if (id[frame.at(land)] != kLandId || id[frame.at(water)] != kWaterId) continue;
          highest_m = std::max(highest_m, frame.position(land).z);
          ++pairs;
        }
      }
  EXPECT_GT(pairs, 50);
  return highest_m;
}

// The beach's dunes of 5.5 m reach three sides of its square. They were cut off there.
TEST(Ground, ComesDownToTheSeaWhereItsMapEnds) {
  const World& world = shipped_world("beach");
  for (const glm::dvec2& at : {glm::dvec2(-600.0, -400.0), {600.0, -400.0}, {0.0, -700.0}}) {
    const LabelledFrame frame(world, view_down({at.x, at.y, 500.0}), 5.0);
    EXPECT_LT(highest_shore_m(frame), 2.0) << at.x << " " << at.y;
  }
}

// With few triangles most went to the floor under the eye, and the hill lost its top.
TEST(Ground, KeepsItsHillsWithFewTriangles) {
  scene::Scene scene = load_shipped("lagoon");
  scene.detail.terrain_triangles = 500;
  const World world = world_of(scene);
  const double top_m = world.state().terrain->highest_m;
  for (const glm::dvec3& eye :
       {scene.camera.eye_m, glm::dvec3(-15.0, -500.0, 12.0), glm::dvec3(300.0, 200.0, 3.0)}) {
    const glm::dvec2 to_middle = -glm::dvec2(eye);
    const View view = make_view(eye, std::atan2(to_middle.x, to_middle.y), -0.1,
                                scene.camera.fov_y_rad, 0.25f, 320, 180);
    const LabelledFrame frame(world, view, 5.0);
    const std::vector<float>& drawn = frame.state().meshes.land.height_m;
    EXPECT_GT(*std::ranges::max_element(drawn), 0.8 * top_m) << eye.x << " " << eye.y;
  }
}

}  // namespace
}  // namespace swell::render
