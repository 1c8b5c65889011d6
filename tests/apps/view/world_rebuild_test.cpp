#include "apps/view/world_rebuild.h"

#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <thread>

#include "view_scene.h"

namespace swell::view {
namespace {

void wait_until_idle(WorldRebuilder& rebuilder, std::shared_ptr<const render::World>& world) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (rebuilder.busy() && std::chrono::steady_clock::now() < end) {
    rebuilder.swap_if_ready(world);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

TEST(WorldRebuilder, TheNewestOfManyRequestsWins) {
  WorldRebuilder rebuilder;
  auto world = std::make_shared<const render::World>(small_scene());
  for (int i = 1; i <= 30; ++i) {
    scene::Scene scene = small_scene();
    scene.sea.wind_speed_mps = i;
    rebuilder.request(scene, world);
    if (i % 10 == 0) rebuilder.swap_if_ready(world);
  }
  wait_until_idle(rebuilder, world);
  EXPECT_EQ(world->scene().sea.wind_speed_mps, 30.0);
  EXPECT_EQ(rebuilder.error(), "");
}

TEST(WorldRebuilder, ABadSceneIsReportedAndTheOldWorldKept) {
  WorldRebuilder rebuilder;
  auto world = std::make_shared<const render::World>(small_scene());
  scene::Scene scene = small_scene();
  scene.sea.wind_speed_mps = std::numeric_limits<double>::quiet_NaN();
  rebuilder.request(scene, world);
  wait_until_idle(rebuilder, world);
  EXPECT_EQ(world->scene().sea.wind_speed_mps, small_scene().sea.wind_speed_mps);
  EXPECT_NE(rebuilder.error(), "");

  scene.sea.wind_speed_mps = 3.0;
  rebuilder.request(scene, world);
  wait_until_idle(rebuilder, world);
  EXPECT_EQ(world->scene().sea.wind_speed_mps, 3.0);
  EXPECT_EQ(rebuilder.error(), "");
}

// A scene whose wave trains take a while is being made when the rebuilder goes, and another waits.
TEST(WorldRebuilder, EndsInTheMiddleOfWork) {
  const auto world = std::make_shared<const render::World>(small_scene());
  scene::Scene coast = small_scene();
  coast.terrain.emplace();
  coast.coast.model = scene::CoastModel::kBlend;
  int in_the_middle = 0;
  for (int i = 0; i < 2; ++i) {
    {
      WorldRebuilder rebuilder;
      rebuilder.request(coast, world);
      std::this_thread::sleep_for(std::chrono::milliseconds(10 * i));
      if (i == 1) rebuilder.request(small_scene(), world);
      in_the_middle += world.use_count() > 1;  // whoever has work left holds it
    }
    EXPECT_EQ(world.use_count(), 1) << "nobody works on";
  }
  EXPECT_GE(in_the_middle, 1);
}

}  // namespace
}  // namespace swell::view
