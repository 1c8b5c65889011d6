#include "math/view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "constants.h"
#include "math/elementary.h"
#include "math/random.h"

namespace swell {
namespace {

View view_towards(double heading_deg, double pitch_deg) {
  return make_view({0, 0, 0}, heading_deg * kDegree, pitch_deg * kDegree, 60.0 * kDegree, 0.5f, 640,
                   360);
}

void expect_near(glm::vec3 a, glm::vec3 b, float tolerance = 1e-6f) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

struct Projection {
  double x_px, y_px, depth_value, w;
};

// The pipeline's path from a point to the window, in double precision.
Projection project(const View& view, glm::dvec3 p_rel) {
  const glm::dvec4 clip = glm::dmat4(view.clip_from_rel) * glm::dvec4(p_rel, 1.0);
  return {(clip.x / clip.w + 1.0) * 0.5 * view.width_px,
          (1.0 - clip.y / clip.w) * 0.5 * view.height_px, clip.z / clip.w, clip.w};
}

// Views that cover all headings, pitches, fields and shapes.
std::vector<View> many_views() {
  std::vector<View> views;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const auto u = [&](std::uint64_t k) { return random_uniform(71, 8 * i + k); };
    views.push_back(make_view({1e6 * u(0), -3e5, 20}, 2 * kPi * u(1), kPi * (u(2) - 0.5),
                              (10 + 120 * u(3)) * kDegree, static_cast<float>(0.01 + u(4)),
                              1 + static_cast<int>(2000 * u(5)),
                              1 + static_cast<int>(1000 * u(6))));
  }
  return views;
}

TEST(View, HeadingIsClockwiseFromNorth) {
  expect_near(view_towards(0, 0).forward, {0, 1, 0});
  expect_near(view_towards(0, 0).right, {1, 0, 0});
  expect_near(view_towards(90, 0).forward, {1, 0, 0});
  expect_near(view_towards(90, 0).right, {0, -1, 0});
  expect_near(view_towards(180, 0).forward, {0, -1, 0});
  expect_near(view_towards(270, 0).forward, {-1, 0, 0});
  expect_near(view_towards(-90, 0).forward, {-1, 0, 0});
}

TEST(View, PitchIsPositiveUpwards) {
  expect_near(view_towards(0, 0).up, {0, 0, 1});
  expect_near(view_towards(0, 90).forward, {0, 0, 1});
  expect_near(view_towards(0, 90).up, {0, -1, 0});
  expect_near(view_towards(0, -90).forward, {0, 0, -1});
  expect_near(view_towards(0, -90).up, {0, 1, 0});
  const float half = std::sqrt(0.5f);
  expect_near(view_towards(0, -45).forward, {0, half, -half});
}

TEST(View, AxesAreOrthonormalAndUpIsRightCrossForward) {
  for (const View& view : many_views()) {
    for (const glm::vec3& axis : {view.right, view.up, view.forward}) {
      EXPECT_NEAR(glm::length(axis), 1.0f, 2e-7f);
    }
    expect_near(glm::cross(view.right, view.forward), view.up);
  }
}

TEST(View, TheFieldOfViewReachesFromTheBottomToTheTopEdge) {
  const View view = view_towards(0, 0);
  EXPECT_NEAR(view.tan_half_y, std::tan(30.0 * kDegree), 1e-7);
  EXPECT_NEAR(view.tan_half_x, std::tan(30.0 * kDegree) * 640 / 360, 1e-6);
  expect_near(view.ray(320, 180), {0, 1, 0});
  expect_near(view.ray(320, 0), {0, 1, std::tan(30.0f * static_cast<float>(kDegree))});
  expect_near(view.ray(0, 180), {-view.tan_half_x, 1, 0});
  expect_near(view.ray(640, 360), {view.tan_half_x, 1, -view.tan_half_y});
}

TEST(View, AKnownPointFallsOnItsPixel) {
  // 10 m north, 1 m east and 2 m up, seen level with a right angle of view in a square window.
  const View view = make_view({5, 6, 7}, 0, 0, 90 * kDegree, 0.5f, 100, 100);
  const Projection p = project(view, {1, 10, 2});
  EXPECT_NEAR(p.x_px, 55.0, 1e-5);
  EXPECT_NEAR(p.y_px, 40.0, 1e-5);
  EXPECT_NEAR(p.w, 10.0, 1e-6);
  EXPECT_NEAR(p.depth_value, 0.05, 1e-7);
  EXPECT_EQ(view.eye_world, glm::dvec3(5, 6, 7));
}

TEST(View, APointOnARayProjectsBackToItsPixel) {
  for (const View& view : many_views()) {
    for (const float depth : {0.7f, 30.0f, 20000.0f}) {
      for (const float fx : {0.0f, 0.37f, 1.0f}) {
        const float x = fx * static_cast<float>(view.width_px);
        const float y = (1.0f - 0.8f * fx) * static_cast<float>(view.height_px);
        const glm::vec3 p_rel = view.ray(x, y) * depth;
        const Projection p = project(view, p_rel);
        // A few float roundings of the point move it sideways by e |ray| and its depth by as much,
        // which the division multiplies by the tangent of the view angle (< |ray|).
        const double px_per_unit = 0.5 * view.height_px / view.tan_half_y;
        const double length = glm::length(view.ray(x, y));
        const double tolerance = 5e-7 * px_per_unit * length * length;
        ASSERT_NEAR(p.x_px, x, tolerance);
        ASSERT_NEAR(p.y_px, y, tolerance);
        ASSERT_NEAR(p.w / depth, 1.0, 1e-5);
      }
    }
  }
}

TEST(View, DepthIsReversedOneAtNearAndZeroAtInfinity) {
  const View view = view_towards(30, -10);
  double last = 2.0;
  for (const double depth : {0.5, 1.0, 10.0, 1e4, 1e7}) {
    const Projection p = project(view, glm::dvec3(view.forward) * depth);
    EXPECT_NEAR(p.depth_value * depth, 0.5, 1e-6);
    EXPECT_LT(p.depth_value, last);
    last = p.depth_value;
  }
  EXPECT_NEAR(project(view, glm::dvec3(view.forward) * 0.5).depth_value, 1.0, 1e-6);
  EXPECT_EQ((view.clip_from_rel * glm::vec4(view.forward, 0.0f)).z, 0.0f);
}

TEST(FrustumPlanes, HaveUnitNormalsAndTheDocumentedOrder) {
  const View view = make_view({0, 0, 0}, 0, 0, 90 * kDegree, 0.5f, 100, 100);
  const auto planes = frustum_planes(view);
  const float half = std::sqrt(0.5f);
  const std::vector<glm::vec4> expected = {{half, half, 0, 0},
                                           {-half, half, 0, 0},
                                           {0, half, half, 0},
                                           {0, half, -half, 0},
                                           {0, 1, 0, -0.5f}};
  for (std::size_t i = 0; i < 5; ++i) {
    expect_near(glm::vec3(planes[i]), glm::vec3(expected[i]));
    EXPECT_EQ(planes[i].w, expected[i].w);
  }
}

// Inside all planes exactly if the point projects into the window, in front of the near plane.
TEST(FrustumPlanes, ContainExactlyWhatProjectsIntoTheWindow) {
  std::uint64_t n = 0;
  int inside_count = 0, outside_count = 0;
  for (const View& view : many_views()) {
    const auto planes = frustum_planes(view);
    for (int k = 0; k < 200; ++k) {
      const auto signed_unit = [&] { return 2.0 * random_uniform(72, n++) - 1.0; };
      // Spread around the frustum in view axes, some of it behind the eye.
      const double depth = 50.0 * (signed_unit() + 0.7);
      const glm::dvec3 p = glm::dvec3(view.forward) * depth +
                           glm::dvec3(view.right) * (60.0 * view.tan_half_x * signed_unit()) +
                           glm::dvec3(view.up) * (60.0 * view.tan_half_y * signed_unit());
      double nearest = std::numeric_limits<double>::infinity();
      for (const glm::vec4& plane : planes) {
        nearest = std::min(nearest, glm::dot(glm::dvec3(plane), p) + plane.w);
      }
      if (std::abs(nearest) < 1e-3) continue;  // too close to a plane for float normals
      const Projection q = project(view, p);
      const bool visible = q.w >= view.near_m && q.x_px >= 0 && q.x_px <= view.width_px &&
                           q.y_px >= 0 && q.y_px <= view.height_px;
      ASSERT_EQ(nearest > 0.0, visible) << "view " << n / 600 << " nearest " << nearest;
      ++(visible ? inside_count : outside_count);
    }
  }
  EXPECT_GT(inside_count, 2000);
  EXPECT_GT(outside_count, 2000);
}

TEST(View, LookingStraightUpAndDownHasNoNan) {
  for (const double pitch_deg : {-90.0, 90.0}) {
    for (int heading_deg = 0; heading_deg < 360; heading_deg += 15) {
      const View view = view_towards(heading_deg, pitch_deg);
      for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
          ASSERT_TRUE(std::isfinite(view.clip_from_rel[column][row]));
        }
      }
      for (const glm::vec4& plane : frustum_planes(view)) {
        ASSERT_TRUE(std::isfinite(plane.x + plane.y + plane.z + plane.w));
      }
      EXPECT_NEAR(glm::length(view.ray(0, 0)), glm::length(view_towards(0, 0).ray(0, 0)), 1e-5f);
    }
  }
}

}  // namespace
}  // namespace swell
