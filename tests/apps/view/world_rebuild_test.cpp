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

TEST(WorldRebuilder, EndsInTheMiddleOfWork) {
  const auto world = std::make_shared<const render::World>(small_scene());
  for (int i = 0; i < 10; ++i) {
    WorldRebuilder rebuilder;
    rebuilder.request(small_scene(), world);
    if (i % 2 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(i));
  }
}

}  // namespace
}  // namespace swell::view
