#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "math/random.h"
#include "scene/expect_near.h"
#include "scene/scene.h"
#include "sky/sky_light.h"

namespace swell::scene {
namespace {

constexpr double kQuarter = 3.14159265358979323846 / 2.0;

TEST(Camera, LooksNorthFromItsEyeByDefault) {
  const View view = camera_view({}, 0.0, 200, 100);
  EXPECT_EQ(view.eye_world, glm::dvec3(0, 0, 10));
  expect_near(view.forward, {0, 1, 0}, 1e-7);
  expect_near(view.right, {1, 0, 0}, 1e-7);
  expect_near(view.up, {0, 0, 1}, 1e-7);
  EXPECT_EQ(view.width_px, 200);
  EXPECT_EQ(view.height_px, 100);
}

TEST(Camera, MovesStraightAtItsVelocity) {
  const Camera camera{.eye_m = {1, 2, 3}, .velocity_mps = {10, -20, 0.5}};
  EXPECT_EQ(camera_view(camera, 4.0, 8, 8).eye_world, glm::dvec3(41, -78, 5));
  EXPECT_EQ(camera_view(camera, -2.0, 8, 8).eye_world, glm::dvec3(-19, 42, 2));
}

TEST(Camera, TurnsClockwise) {
  const Camera camera{.turn_rad_s = kQuarter};
  expect_near(camera_view(camera, 1.0, 8, 8).forward, {1, 0, 0}, 1e-7);   // east
  expect_near(camera_view(camera, 2.0, 8, 8).forward, {0, -1, 0}, 1e-7);  // south
  expect_near(camera_view(camera, -1.0, 8, 8).forward, {-1, 0, 0}, 1e-7);
}

TEST(Camera, PitchLooksUp) {
  const Camera camera{.heading_rad = kQuarter, .pitch_rad = kQuarter / 3.0};
  expect_near(camera_view(camera, 0.0, 8, 8).forward, {std::sqrt(0.75), 0, 0.5}, 1e-7);
}

TEST(Camera, AnyFiniteTimeGivesAFiniteView) {
  const Camera camera{.velocity_mps = {1000, -1000, 1}, .turn_rad_s = 6.0};
  for (const double t_s : {1e9, -1e9, 1e15, -1e300, std::numeric_limits<double>::max()}) {
    const View view = camera_view(camera, t_s, 64, 64);
    EXPECT_LE(std::abs(view.eye_world.x), 1e7) << t_s;
    EXPECT_LE(std::abs(view.eye_world.y), 1e7) << t_s;
    EXPECT_NEAR(glm::length(view.forward), 1.0f, 1e-6f) << t_s;
    EXPECT_NEAR(glm::dot(view.forward, view.right), 0.0f, 1e-6f) << t_s;
  }
}

TEST(Camera, RollLowersTheRightSide) {
  const Camera camera{.heading_rad = kQuarter, .roll_rad = kQuarter / 3.0};
  const View view = camera_view(camera, 0.0, 8, 8);
  expect_near(view.forward, {1, 0, 0}, 1e-7);
  expect_near(view.right, {0, -std::sqrt(0.75), -0.5}, 1e-7);
}

// The identity looks at the zenith; the eye still moves.
TEST(Camera, AQuaternionTakesThePlaceOfTheAngles) {
  Camera camera{.eye_m = {0, 0, 2}, .heading_rad = 1.0, .velocity_mps = {1, 0, 0}};
  camera.quaternion = glm::dvec4(1, 0, 0, 0);
  const View view = camera_view(camera, 5.0, 8, 8);
  expect_near(view.forward, {0, 0, 1}, 1e-7);
  expect_near(view.up, {0, -1, 0}, 1e-7);
  EXPECT_EQ(view.eye_world, glm::dvec3(5, 0, 2));
}

// The corners and the principal point show the same directions, whatever the picture's size.
TEST(Camera, AMatrixIsStretchedToThePicturesSize) {
  Camera camera;
  camera.focal_px = glm::dvec2(800.0, 780.0);
  camera.principal_px = glm::dvec2(300.0, 250.0);
  camera.size_px = glm::dvec2(640.0, 480.0);
  const View given = camera_view(camera, 0.0, 640, 480);
  const Intrinsics k = camera_pose(given).k;
  expect_near({k.fx, k.fy, 0.0}, {800.0, 780.0, 0.0}, 1e-4);
  expect_near({k.cx, k.cy, 0.0}, {300.0, 250.0, 0.0}, 1e-4);
  expect_near(given.ray(300.0f, 250.0f), given.forward, 1e-6);
  for (const glm::ivec2& size : {glm::ivec2(320, 240), glm::ivec2(1280, 960), glm::ivec2(64, 99)}) {
    const View view = camera_view(camera, 0.0, size.x, size.y);
    EXPECT_EQ(view.ray(0, 0), given.ray(0, 0));
    expect_near(view.ray(static_cast<float>(size.x), static_cast<float>(size.y)),
                given.ray(640.0f, 480.0f), 1e-6);
    EXPECT_NEAR(camera_pose(view).k.fx, 800.0 * size.x / 640.0, 2e-4);
    EXPECT_NEAR(camera_pose(view).k.cy, 250.0 * size.y / 480.0, 2e-4);
  }
  camera.principal_px.reset();
  EXPECT_EQ(camera_view(camera, 0.0, 640, 480).tan_middle_x, 0.0f);
}

TEST(CameraPath, RollsFromWaypointToWaypoint) {
  const Camera camera{.path = {{.t_s = 0.0}, {.t_s = 1.0, .roll_rad = 0.2}, {.t_s = 2.0}}};
  EXPECT_EQ(camera_view(camera, 0.0, 8, 8).right.z, 0.0f);
  EXPECT_NEAR(camera_view(camera, 1.0, 8, 8).right.z, -std::sin(0.2), 1e-7);
  EXPECT_LT(camera_view(camera, 0.5, 8, 8).right.z, -0.01f);
  EXPECT_GT(camera_view(camera, 0.5, 8, 8).right.z, -0.19f);
}

// There and back, with a turn on the spot over north.
Camera camera_on_path() {
  const auto deg = [](double angle) { return radians(angle); };
  return {.path = {{0.0, {0, 0, 20}, deg(350), deg(-5)},
                   {4.0, {100, 40, 8}, deg(350), deg(-9)},
                   {6.0, {100, 40, 8}, deg(30), deg(0)},
                   {7.0, {100, 40, 8}, deg(160), deg(0)},
                   {12.0, {20, 90, 30}, deg(-140), deg(-20)}}};
}

TEST(CameraPath, PassesThroughItsWaypoints) {
  const Camera camera = camera_on_path();
  for (const Waypoint& w : camera.path) {
    const View view = camera_view(camera, w.t_s, 8, 8);
    expect_near(view.eye_world, w.eye_m, 1e-12);
    expect_near(view.forward, make_view({}, w.heading_rad, w.pitch_rad, 1.0, 1.0f, 8, 8).forward,
                1e-6);
  }
}

TEST(CameraPath, RestsBeforeItsStartAndAfterItsEnd) {
  const Camera camera = camera_on_path();
  EXPECT_EQ(camera_view(camera, -1e300, 8, 8).eye_world, camera.path.front().eye_m);
  EXPECT_EQ(camera_view(camera, 1e9, 8, 8).eye_world, camera.path.back().eye_m);
  const Camera fixed{.path = {{5.0, {1, 2, 3}, kQuarter, 0.0}}};
  for (const double t_s : {0.0, 5.0, 6.0}) {
    EXPECT_EQ(camera_view(fixed, t_s, 8, 8).eye_world, glm::dvec3(1, 2, 3));
    expect_near(camera_view(fixed, t_s, 8, 8).forward, {1, 0, 0}, 1e-7);
  }
}

TEST(CameraPath, TurnsOnTheSpotWithoutMoving) {
  const Camera camera = camera_on_path();
  for (double t_s = 4.0; t_s <= 7.0; t_s += 0.01)
    ASSERT_EQ(camera_view(camera, t_s, 8, 8).eye_world, glm::dvec3(100, 40, 8)) << t_s;
}

TEST(CameraPath, TurnsTheShorterWayOverNorth) {
  // From 350 to 30 degrees: half way it looks to between north-north-west and north-east.
  const Camera camera = camera_on_path();
  for (double t_s = 4.0; t_s <= 6.0; t_s += 0.01)
    ASSERT_GT(camera_view(camera, t_s, 8, 8).forward.y, 0.8f) << t_s;
}

// Each coordinate stays between its values at the waypoints around, and steps of a millisecond
// change neither the place nor the speed by leaps.
TEST(CameraPath, IsSmoothAndDoesNotOvershoot) {
  const Camera camera = camera_on_path();
  const double dt_s = 1e-3;
  glm::dvec3 last = camera.path.front().eye_m, last_step(0.0);
  for (std::size_t i = 0; i + 1 < camera.path.size(); ++i) {
    const Waypoint &from = camera.path[i], &to = camera.path[i + 1];
    const glm::dvec3 low = glm::min(from.eye_m, to.eye_m), high = glm::max(from.eye_m, to.eye_m);
    for (double t_s = from.t_s; t_s < to.t_s; t_s += dt_s) {
      const glm::dvec3 eye = camera_view(camera, t_s, 8, 8).eye_world, step = eye - last;
      for (int c = 0; c < 3; ++c) {
        ASSERT_GE(eye[c], low[c] - 1e-9) << t_s;
        ASSERT_LE(eye[c], high[c] + 1e-9) << t_s;
      }
      ASSERT_LT(glm::length(step), 60.0 * dt_s) << t_s;
      ASSERT_LT(glm::length(step - last_step), 100.0 * dt_s * dt_s) << t_s;
      last = eye, last_step = step;
    }
  }
}

TEST(CameraPath, KeepsAConstantSpeedBetweenEvenWaypoints) {
  const Camera camera{.path = {{0, {0, 0, 5}}, {1, {10, 0, 5}}, {3, {30, 0, 5}}, {4, {40, 0, 5}}}};
  for (double t_s = 1.0; t_s <= 3.0; t_s += 0.125)
    EXPECT_NEAR(camera_view(camera, t_s, 8, 8).eye_world.x, 10.0 * t_s, 1e-12);
}

TEST(CameraDeathTest, TimeThatIsNoNumberIsTheCallersMistake) {
  EXPECT_DEATH(camera_view({}, std::nan(""), 8, 8), "t_s=nan");
}

TEST(CameraDeathTest, AMountedCamerasViewNeedsItsObject) {
  Camera camera;
  camera.mount = "boat";
  EXPECT_DEATH(camera_view(camera, 0.0, 8, 8), "mount=boat");
}

Sky clear_sky() {
  Sky sky;
  sky.model = SkyModel::kGradient;
  sky.sun_direction = sky::sun_direction(0.0, 0.7);
  return sky;
}

TEST(Sky, SunDirectionIsClockwiseFromNorth) {
  expect_near(sky::sun_direction(0.0, 0.0), {0, 1, 0}, 1e-7);
  expect_near(sky::sun_direction(kQuarter, 0.0), {1, 0, 0}, 1e-7);
  expect_near(sky::sun_direction(1.0, kQuarter), {0, 0, 1}, 1e-7);
  expect_near(sky::sun_direction(3.0 * kQuarter, kQuarter / 3.0), {-std::sqrt(0.75), 0, 0.5}, 1e-7);
}

TEST(GradientSky, WithoutSunHasItsZenithAndHorizonColours) {
  Sky sky = clear_sky();
  sky.sun_radiance = glm::vec3(0.0f);
  expect_near(sky::gradient_radiance(sky, {0, 0, 1}), sky::gradient_of(sky).zenith, 1e-3);
  expect_near(sky::gradient_radiance(sky, {1, 0, 0}), sky::gradient_of(sky).horizon, 0.1);
}

TEST(GradientSky, GoesFromHorizonToZenithWithoutSteps) {
  const Sky sky = clear_sky();
  glm::vec3 last = sky::gradient_radiance(sky, {-1, 0, 0});
  for (int i = 1; i <= 2000; ++i) {
    const double angle = kQuarter * i / 2000.0;
    const glm::vec3 now =
        sky::gradient_radiance(sky, {-static_cast<float>(std::cos(angle)), 0.0f, std::sin(angle)});
    EXPECT_LT(glm::length(now - last), 0.01f) << i;
    last = now;
  }
}

TEST(GradientSky, IsBrightestAroundTheSun) {
  const Sky sky = clear_sky();
  const glm::vec3 at_sun = sky::gradient_radiance(sky, sky.sun_direction);
  const glm::vec3 beside = sky::gradient_radiance(sky, sky::sun_direction(0.3, 0.7));
  const glm::vec3 opposite = sky::gradient_radiance(sky, sky::sun_direction(2.0 * kQuarter, 0.7));
  EXPECT_GT(at_sun.x, beside.x);
  EXPECT_GT(beside.x, opposite.x);
}

TEST(GradientSky, BelowTheHorizonIsTheHorizonsColour) {
  const Sky sky = clear_sky();
  const glm::vec3 horizon = sky::gradient_radiance(sky, {0.6f, -0.8f, 0.0f});
  expect_near(sky::gradient_radiance(sky, {0.3f, -0.4f, -0.7f}), horizon, 1e-6);
  EXPECT_TRUE(std::isfinite(sky::gradient_radiance(sky, {0, 0, -1}).x));
}

TEST(GradientSky, IsFiniteAndNotNegativeForAnySkyAndDirection) {
  for (int n = 0; n < 3000; ++n) {
    const auto uniform = [&](int k) { return random_uniform(n, k); };
    Sky sky;
    sky.sun_direction = sky::sun_direction(6.3 * uniform(0), kQuarter * (2.0 * uniform(1) - 1.0));
    sky.zenith = glm::vec3(glm::dvec3(100.0 * uniform(2)));
    sky.horizon = glm::vec3(uniform(3), 0.0, 100.0 * uniform(4));
    const glm::vec3 direction =
        sky::sun_direction(6.3 * uniform(6), kQuarter * (2.0 * uniform(7) - 1.0));
    const glm::vec3 radiance = sky::gradient_radiance(sky, direction);
    for (int c = 0; c < 3; ++c) ASSERT_TRUE(radiance[c] >= 0.0f && radiance[c] < 1e4f) << n;
  }
}

}  // namespace
}  // namespace swell::scene
