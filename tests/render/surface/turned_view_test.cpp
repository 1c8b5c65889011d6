// Pictures of rolled cameras, and of cameras that look past their picture's middle: the same sea,
// turned or cut out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/elementary.h"
#include "render/shot.h"
#include "scene/scene.h"
#include "sky/sky_light.h"

namespace swell::render {
namespace {

constexpr int kTurnedSide_px = 160;
constexpr double kTime_s = 4.0;

// Two triangles, which are the same from everywhere.
scene::Scene flat_sea() {
  scene::Scene scene;
  scene.sea.resolution = 64;
  scene.detail.triangulation = scene::Triangulation::kPlane;
  return scene;
}

// Linear light: the 8-bit picture is dithered by place.
std::vector<float> draw_turned(const World& world, const View& view) {
  return Shot(world, view, kTime_s, {.lookup_scale = 1.0, .keep_linear = true}).target.linear;
}

View rolled(double roll_rad) {
  return make_view({0.0, 0.0, 5.0}, camera_axes(0.0, -0.25, roll_rad),
                   lens_of_fov(0.9, kTurnedSide_px, kTurnedSide_px), 0.25f, kTurnedSide_px,
                   kTurnedSide_px);
}

// The share of pixels that differ by more than the share `tolerance`, and 0.002; `source` is the
// number in `a` of a pixel of `b`, which is `size` large.
template <class Source>
double share_different(const std::vector<float>& a, const std::vector<float>& b, glm::ivec2 size,
                       Source source, float tolerance = 0.02f) {
  int different = 0;
  for (int y = 0; y < size.y; ++y) {
    for (int x = 0; x < size.x; ++x) {
      const float* p = &a[3 * static_cast<std::size_t>(source(x, y))];
      const float* q = &b[3 * static_cast<std::size_t>(y * size.x + x)];
      different += !std::equal(p, p + 3, q, [&](float u, float v) {
        return std::abs(u - v) <= tolerance * std::max(u, v) + 0.002f;
      });
    }
  }
  return static_cast<double>(different) / (size.x * size.y);
}

// A buoy mirrors in the ripples, whose displacement of its image has to turn too.
TEST(TurnedView, ARolledPictureIsTheLevelOneTurned) {
  scene::Scene scene = flat_sea();
  scene.objects.resize(1);
  scene.objects[0].position_m = {0.0, 12.0};
  const World world = world_of(scene);
  const auto level = draw_turned(world, rolled(0.0));
  const glm::ivec2 size(kTurnedSide_px);
  constexpr int kLast = kTurnedSide_px - 1;
  // A camera turned clockwise has its picture turned counter-clockwise.
  const auto clockwise = [](int x, int y) { return x * kTurnedSide_px + kLast - y; };
  EXPECT_EQ(share_different(level, draw_turned(world, rolled(0.5 * kPi)), size, clockwise), 0.0);
  const auto other_way = [](int x, int y) { return (kLast - x) * kTurnedSide_px + y; };
  EXPECT_EQ(share_different(level, draw_turned(world, rolled(-0.5 * kPi)), size, other_way), 0.0);
  const auto upside_down = [](int x, int y) { return (kLast - y) * kTurnedSide_px + kLast - x; };
  EXPECT_EQ(share_different(level, draw_turned(world, rolled(kPi)), size, upside_down), 0.0);
  // Seen to tell pictures apart.
  EXPECT_GT(share_different(level, draw_turned(world, rolled(kPi)), size, clockwise), 0.2);
}

// Vertices are rounded to 1/256 pixel, other ones in each picture: on the large triangles that
// moves the sea by up to 1/64 pixel. A move by 1/16 pixel takes a tenth of the pixels over this
// tolerance.
TEST(TurnedView, APictureBesideTheMiddleIsCutOutOfAWiderOne) {
  // Into the sun, where neighbours differ most.
  scene::Scene scene = flat_sea();
  scene.sky.sun_azimuth_rad = 0.0;
  scene.sky.sun_elevation_rad = radians(25.0);
  scene.sky.sun_direction = sky::sun_direction(0.0, scene.sky.sun_elevation_rad);
  const World world = world_of(scene);
  const View wide = rolled(0.3);
  // Its lower right part.
  const glm::ivec2 corner(80, 60), size(70, 90);
  const OpticalPose pose = camera_pose(wide);
  const Intrinsics k = {pose.k.fx, pose.k.fy, pose.k.cx - corner.x, pose.k.cy - corner.y};
  const View part = make_view(pose.eye_world, pose.world_from_optical, k, 0.25f, size.x, size.y);
  const auto place = [&](int x, int y) { return (y + corner.y) * kTurnedSide_px + x + corner.x; };
  const auto whole = draw_turned(world, wide);
  EXPECT_LE(share_different(whole, draw_turned(world, part), size, place, 0.1f), 0.01);
  const auto one_aside = [&](int x, int y) { return place(x, y) - 1; };
  EXPECT_GE(share_different(whole, draw_turned(world, part), size, one_aside, 0.1f), 0.5);
}

}  // namespace
}  // namespace swell::render
