// The less is seen of far things, in haze, in fog, in rain or by night, the fewer triangles they
// have. Source: Elykov, Belago, Kuzikovsky, Nekrasov, 2000: priorities, the fifth of them.
#include <gtest/gtest.h>

#include "render/shot.h"
#include "render/view/meshes.h"
#include "sky/sky_light.h"

namespace swell::render {
namespace {

// What part of the water's vertices lies beyond 1 km.
double far_part(double sun_elevation_deg, double visibility, double haze_distance_m = 9000.0,
                double fog_visibility_m = 0.0, double rain_mm_h = 0.0) {
  scene::Scene scene;
  scene.sea.resolution = 16;
  scene.camera.eye_m = {0.0, 0.0, 150.0};
  scene.detail.water_triangles = 4000;
  scene.detail.visibility = visibility;
  scene.sky.haze_distance_m = haze_distance_m;
  scene.sky.sun_elevation_rad = radians(sun_elevation_deg);
  scene.sky.sun_direction =
      sky::sun_direction(scene.sky.sun_azimuth_rad, scene.sky.sun_elevation_rad);
  if (fog_visibility_m > 0.0) scene.air.visibility_m = fog_visibility_m;
  scene.air.rain_mm_h = rain_mm_h;
  scene.air.fog_top_m = 400.0;
  const World world = world_of(scene);
  const Shot drawn(world, view_of(world, 0.0, 64, 36), 0.0);
  const Surface& water = drawn.state().meshes.water;
  double far = 0.0;
  for (const glm::vec2& p : water.offset) far += glm::length(p) > 1000.0f;
  return far / static_cast<double>(water.offset.size());
}

TEST(PoorVisibility, OfNightAndDuskTakesTrianglesFromFarWater) {
  const double day = far_part(40.0, 1.0), dusk = far_part(-9.0, 1.0), night = far_part(-30.0, 1.0);
  EXPECT_GT(day, 0.1);
  EXPECT_LT(dusk, 0.95 * day);
  EXPECT_LT(night, 0.95 * day);
}

TEST(PoorVisibility, OfHazeAndFogTakesThemToo) {
  const double clear = far_part(40.0, 1.0, 50000.0);
  EXPECT_LT(far_part(40.0, 1.0, 2000.0), 0.8 * clear);
  EXPECT_LT(far_part(40.0, 1.0, 50000.0, 2000.0), 0.8 * clear);
}

TEST(PoorVisibility, OfRainTakesThemTheMoreTheHarderItFalls) {
  const double dry = far_part(40.0, 1.0, 50000.0);
  const double drizzle = far_part(40.0, 1.0, 50000.0, 0.0, 2.0);
  const double downpour = far_part(40.0, 1.0, 50000.0, 0.0, 50.0);
  EXPECT_LT(drizzle, dry);
  EXPECT_LT(downpour, 0.8 * drizzle);
  EXPECT_EQ(far_part(40.0, 0.0, 50000.0, 0.0, 50.0), far_part(40.0, 0.0, 50000.0));
}

TEST(PoorVisibility, CountsForNothingUnlessItIsAskedFor) {
  EXPECT_EQ(far_part(40.0, 0.0), far_part(-30.0, 0.0));
  EXPECT_EQ(far_part(40.0, 0.0), far_part(40.0, 0.0, 2000.0));
}

}  // namespace
}  // namespace swell::render
