// The water of a world: that of its scene, and not made anew.
#include <gtest/gtest.h>

#include <optional>

#include "render/shot.h"
#include "render/world/world_state.h"
#include "scene/water.h"

namespace swell::render {
namespace {

class WaterOfWorld : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, WaterOfWorld, testing::Values("beach", "buoys", "river"));

TEST_P(WaterOfWorld, IsThatOfItsSceneAndNotMadeAnew) {
  const scene::Scene scene = load_shipped(GetParam());
  const World world(scene, 2);
  const scene::Water shared = world.water(), made(scene, 2);
  EXPECT_EQ(&shared.sea(), world.state().sea.get());
  EXPECT_EQ(shared.terrain(), world.state().terrain.get());
  EXPECT_EQ(shared.coast(), world.state().coast.get());
  EXPECT_EQ(shared.inland(), world.state().inland.get());

  Workers workers(2);
  ocean::SeaFrame shared_frame, made_frame;
  const scene::WaterSurface a = shared.at(3.0, shared_frame, workers);
  const scene::WaterSurface b = made.at(3.0, made_frame, workers);
  for (int n = 0; n < 500; ++n) {
    const glm::dvec2 p(7.3 * n - 1800.0, 900.0 - 5.1 * n);
    ASSERT_EQ(a.height(p), b.height(p)) << p.x << " " << p.y;
    ASSERT_EQ(shared.wets(a, p), made.wets(b, p));
  }
}

TEST(WaterOfWorld, OutlivesIt) {
  std::optional<World> world(std::in_place, load_shipped("beach"), 2);
  const scene::Water water = world->water();
  Workers workers(1);
  ocean::SeaFrame frame;
  const float height_m = water.at(3.0, frame, workers).height({10.0, 20.0});
  world.reset();
  EXPECT_EQ(water.at(3.0, frame, workers).height({10.0, 20.0}), height_m);
}

}  // namespace
}  // namespace swell::render
