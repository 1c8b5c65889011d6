// Views off their axis, rolled, and in the words of robotics: K and a quaternion.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "constants.h"
#include "math/elementary.h"
#include "math/random.h"
#include "math/view.h"

namespace swell {
namespace {

const Intrinsics kCamera = {800.0, 780.0, 300.0, 260.0};
constexpr int kWidth_px = 640, kHeight_px = 480;

void expect_near_place(glm::dvec3 a, glm::dvec3 b, double tolerance = 1e-6) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

// The pipeline's path from a point to the window.
glm::dvec2 pixel_of(const View& view, glm::dvec3 p_rel) {
  const glm::dvec4 clip = glm::dmat4(view.clip_from_rel) * glm::dvec4(p_rel, 1.0);
  return {(1.0 + clip.x / clip.w) * 0.5 * view.width_px,
          (1.0 - clip.y / clip.w) * 0.5 * view.height_px};
}

// q v q*, written out.
glm::dvec3 rotate(const glm::dquat& q, glm::dvec3 v) {
  const glm::dvec3 u(q.x, q.y, q.z);
  return 2.0 * glm::dot(u, v) * u + (q.w * q.w - glm::dot(u, u)) * v + 2.0 * q.w * glm::cross(u, v);
}

// The textbook's pinhole: p_optical = q* (p - eye), x = fx X / Z + cx.
glm::dvec2 pinhole(const glm::dquat& q, const Intrinsics& k, glm::dvec3 p_rel) {
  const glm::dvec3 p = rotate(glm::dquat(q.w, -q.x, -q.y, -q.z), p_rel);
  return {k.fx * p.x / p.z + k.cx, k.fy * p.y / p.z + k.cy};
}

struct Shot {
  glm::dquat q;
  Intrinsics k;
  View view;
};
std::vector<Shot> random_shots() {
  std::vector<Shot> shots;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const auto u = [&](std::uint64_t n) { return 2.0 * random_uniform(81, 8 * i + n) - 1.0; };
    const glm::dvec4 r(u(0), u(1), u(2), u(3));
    const glm::dvec4 unit = r / glm::length(r);
    const glm::dquat q(unit[0], unit[1], unit[2], unit[3]);
    const Intrinsics k = {600 + 300 * u(4), 600 + 300 * u(5), 320 + 400 * u(6), 240 + 300 * u(7)};
    shots.push_back({q, k, make_view({1e5, 2e5, 3.0}, q, k, 0.1f, kWidth_px, kHeight_px)});
  }
  return shots;
}

TEST(CameraModel, TheIdentityLooksStraightUpWithSouthOnTop) {
  const View view = make_view({}, glm::dquat(1, 0, 0, 0), kCamera, 0.1f, kWidth_px, kHeight_px);
  expect_near_place(view.forward, {0, 0, 1});
  expect_near_place(view.right, {1, 0, 0});
  expect_near_place(view.up, {0, -1, 0});
}

// A quarter turn about east, from zenith to north: (cos 45, -sin 45, 0, 0).
TEST(CameraModel, AKnownQuaternionLooksNorth) {
  const double s = std::sqrt(0.5);
  const View view = make_view({}, glm::dquat(s, -s, 0, 0), kCamera, 0.1f, kWidth_px, kHeight_px);
  expect_near_place(view.forward, {0, 1, 0});
  expect_near_place(view.right, {1, 0, 0});
  expect_near_place(view.up, {0, 0, 1});
  // 10 m north, 1 m east and 2 m up.
  const glm::dvec2 at = pixel_of(view, {1, 10, 2});
  EXPECT_NEAR(at.x, 300.0 + 80.0, 1e-4);
  EXPECT_NEAR(at.y, 260.0 - 156.0, 1e-4);
}

TEST(CameraModel, TheAxisLandsAtThePrincipalPoint) {
  for (const Shot& shot : random_shots()) {
    const glm::dvec2 at = pixel_of(shot.view, 50.0 * glm::dvec3(shot.view.forward));
    EXPECT_NEAR(at.x, shot.k.cx, 1e-3);
    EXPECT_NEAR(at.y, shot.k.cy, 1e-3);
    expect_near_place(shot.view.ray(static_cast<float>(shot.k.cx), static_cast<float>(shot.k.cy)),
                      shot.view.forward);
  }
}

TEST(CameraModel, PointsLandWhereTheTextbooksPinholeHasThem) {
  for (const Shot& shot : random_shots())
    for (const glm::vec2& at : {glm::vec2(0, 0), glm::vec2(640, 480), glm::vec2(17.5f, 402.25f)}) {
      const glm::dvec3 p_rel = 30.0 * glm::dvec3(shot.view.ray(at.x, at.y));
      const glm::dvec2 expected = pinhole(shot.q, shot.k, p_rel), got = pixel_of(shot.view, p_rel);
      EXPECT_NEAR(expected.x, at.x, 5e-3);
      EXPECT_NEAR(expected.y, at.y, 5e-3);
      EXPECT_NEAR(got.x, at.x, 5e-3);
      EXPECT_NEAR(got.y, at.y, 5e-3);
    }
}

TEST(CameraModel, AViewGivesItsPoseAndItsMatrixBack) {
  for (const Shot& shot : random_shots()) {
    const OpticalPose pose = camera_pose(shot.view);
    EXPECT_EQ(pose.eye_world, shot.view.eye_world);
    EXPECT_GE(pose.world_from_optical.w, 0.0);
    const glm::dquat& q = pose.world_from_optical;
    EXPECT_NEAR(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, 1.0, 1e-15);
    EXPECT_NEAR(std::abs(q.w * shot.q.w + q.x * shot.q.x + q.y * shot.q.y + q.z * shot.q.z), 1.0,
                1e-12);
    expect_near_place(rotate(q, {0.3, -2.0, 1.0}), rotate(shot.q, {0.3, -2.0, 1.0}), 1e-6);
    EXPECT_NEAR(pose.k.fx, shot.k.fx, 1e-4);
    EXPECT_NEAR(pose.k.fy, shot.k.fy, 1e-4);
    EXPECT_NEAR(pose.k.cx, shot.k.cx, 3e-4);
    EXPECT_NEAR(pose.k.cy, shot.k.cy, 3e-4);
    const View again =
        make_view(pose.eye_world, q, pose.k, shot.view.near_m, kWidth_px, kHeight_px);
    expect_near_place(again.right, shot.view.right);
    expect_near_place(again.up, shot.view.up);
    EXPECT_NEAR(again.tan_middle_x, shot.view.tan_middle_x, 1e-6);
  }
}

TEST(CameraModel, AMatrixMadeFromTheFieldOfViewGivesTheSameView) {
  const double fov_rad = 50.0 * kDegree, f = 240.0 / std::tan(0.5 * fov_rad);
  const View by_angles = make_view({1, 2, 3}, 0.7, -0.2, fov_rad, 0.1f, kWidth_px, kHeight_px);
  const View by_matrix = make_view({1, 2, 3}, camera_pose(by_angles).world_from_optical,
                                   {f, f, 320.0, 240.0}, 0.1f, kWidth_px, kHeight_px);
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      EXPECT_NEAR(by_matrix.clip_from_rel[c][r], by_angles.clip_from_rel[c][r], 1e-6);
  EXPECT_NEAR(by_matrix.tan_half_x, by_angles.tan_half_x, 1e-6);
  EXPECT_NEAR(by_matrix.tan_half_y, by_angles.tan_half_y, 1e-6);
  EXPECT_EQ(by_matrix.tan_middle_x, 0.0f);
  EXPECT_EQ(by_matrix.tan_middle_y, 0.0f);
}

TEST(CameraModel, AQuarterRollPutsTheRightSideDown) {
  const glm::dmat3 axes = camera_axes(0.0, 0.0, 90.0 * kDegree);
  expect_near_place(axes[0], {0, 0, -1});
  expect_near_place(axes[1], {0, 1, 0});
  expect_near_place(axes[2], {1, 0, 0});
  // What lies east, on the right of a level picture, is on top.
  const View view = make_view({}, axes, lens_of_fov(1.0, 100, 100), 0.1f, 100, 100);
  const glm::dvec2 east = pixel_of(view, {1, 10, 0});
  EXPECT_NEAR(east.x, 50.0, 1e-4);
  EXPECT_LT(east.y, 45.0);
}

TEST(CameraModel, RollKeepsTheLineOfSightAndAnOrthonormalFrame) {
  for (std::uint64_t i = 0; i < 100; ++i) {
    const auto u = [&](std::uint64_t n) { return 6.0 * random_uniform(82, 3 * i + n) - 3.0; };
    const glm::dmat3 level = camera_axes(u(0), 0.5 * u(1), 0.0);
    const glm::dmat3 rolled = camera_axes(u(0), 0.5 * u(1), u(2));
    EXPECT_EQ(rolled[1], level[1]);
    expect_near_place(glm::cross(rolled[0], rolled[1]), rolled[2], 1e-15);
    EXPECT_NEAR(glm::dot(rolled[0], level[0]), std::cos(u(2)), 1e-15);
    EXPECT_NEAR(glm::dot(rolled[0], level[2]), -std::sin(u(2)), 1e-15);
  }
}

// Inside all planes exactly if the point projects into the window.
TEST(CameraModel, FrustumPlanesContainExactlyWhatProjectsIntoTheWindow) {
  int inside = 0, outside = 0;
  std::uint64_t n = 0;
  for (const Shot& shot : random_shots()) {
    const View& view = shot.view;
    for (int trial = 0; trial < 100; ++trial) {
      const auto spread = [&] { return 2.0f * static_cast<float>(random_uniform(83, n++)) - 0.5f; };
      const glm::vec2 at(spread() * kWidth_px, spread() * kHeight_px);
      const glm::vec3 p_rel = 20.0f * view.ray(at.x, at.y);
      float nearest = INFINITY;
      for (const glm::vec4& plane : frustum_planes(view))
        nearest = std::min(nearest, glm::dot(glm::vec3(plane), p_rel) + plane.w);
      if (std::abs(nearest) < 1e-3f) continue;
      const bool visible = at.x > 0 && at.x < kWidth_px && at.y > 0 && at.y < kHeight_px;
      ASSERT_EQ(nearest > 0.0f, visible);
      ++(visible ? inside : outside);
    }
  }
  EXPECT_GT(inside, 3000);
  EXPECT_GT(outside, 3000);
}

TEST(CameraModelDeathTest, MatricesAndQuaternionsThatMeanNothingAreTheCallersMistake) {
  const glm::dquat q(1, 0, 0, 0);
  EXPECT_DEATH(make_view({}, q, {0.0, 1.0, 0.0, 0.0}, 0.1f, 8, 8), "fx=0 fy=1");
  EXPECT_DEATH(make_view({}, q, {1.0, std::nan(""), 0.0, 0.0}, 0.1f, 8, 8), "fy=nan");
  EXPECT_DEATH(camera_axes(glm::dquat(0, 0, 0, 0)), "world_from_optical=\\(0, 0, 0, 0\\)");
  EXPECT_DEATH(camera_axes(0.0, 0.0, INFINITY), "roll_rad=inf");
}

}  // namespace
}  // namespace swell
