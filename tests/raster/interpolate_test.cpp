// Perspective-correct weights against exact arithmetic on the snapped positions.
#include "raster/interpolate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "raster/picture.h"

namespace swell::raster {
namespace {

constexpr Viewport kInterpolatedView{64, 64};

struct Known {
  Triangle t;
  std::array<glm::vec4, 3> p_clip;
};

// Window positions on the grid (exact, as w are powers of two), w ratio up to 2^log2_ratio.
Known random_known(Random& random, int log2_ratio) {
  Known k;
  for (int i = 0; i < 3; ++i) {
    k.t[i] = {random.integer(0, 64 * 256), random.integer(0, 64 * 256)};
    const double w = std::exp2(static_cast<double>(random.integer(0, log2_ratio)));
    k.p_clip[i] = clip_from_fx8(k.t[i], 0.5, w, kInterpolatedView);
  }
  return k;
}

struct Exact {
  std::array<long double, 3> weight;
  long double w_clip;
};

// b_i = (e_i / w_i) / sum(e_j / w_j), at window point (x, y) [1/256 px].
Exact exact_at(const Known& k, long double x, long double y) {
  Exact exact{};
  long double sum = 0, area = 0;
  for (int i = 0; i < 3; ++i) {
    const Point &a = k.t[(i + 1) % 3], &b = k.t[(i + 2) % 3];
    const long double e =
        static_cast<long double>(b.x - a.x) * (y - static_cast<long double>(a.y)) -
        static_cast<long double>(b.y - a.y) * (x - static_cast<long double>(a.x));
    exact.weight[i] = e / k.p_clip[i].w;
    sum += exact.weight[i];
    area += e;
  }
  for (long double& w : exact.weight) w /= sum;
  exact.w_clip = area / sum;
  return exact;
}

std::int64_t doubled_area(const Triangle& t) {
  return std::abs((t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (t[1].y - t[0].y));
}

// RAS-09.
TEST(Interpolate, WeightsEqualTheExactOnesAtEveryCoveredPixel) {
  Random random(1);
  int checked = 0;
  for (int n = 0; n < 1500; ++n) {
    const Known k = random_known(random, n % 2 == 0 ? 3 : 9);
    if (doubled_area(k.t) < 2 * 65536) continue;  // 1 square pixel
    const TriangleInterpolator interpolator(k.p_clip, kInterpolatedView);
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        if (!covers(k.t, x, y)) continue;
        const SurfacePoint point = interpolator.at(x, y);
        const Exact exact = exact_at(k, 256.0L * x + 128, 256.0L * y + 128);
        double sum = 0.0;
        for (int i = 0; i < 3; ++i) {
          ASSERT_NEAR(double{point.weight[i]}, static_cast<double>(exact.weight[i]), 1e-7);
          ASSERT_GE(point.weight[i], 0.0f);
          ASSERT_LE(point.weight[i], 1.0f);
          sum += double{point.weight[i]};
        }
        ASSERT_NEAR(sum, 1.0, 2e-7);
        ASSERT_NEAR(double{point.w_clip} / static_cast<double>(exact.w_clip), 1.0, 1.2e-7);
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 100'000);
}

// The rule of the Vulkan and OpenGL conformance tests: within the exact range over a box of 1/128
// px.
TEST(Interpolate, AttributesLieInTheExactRangeAroundThePixelCentre) {
  Random random(2);
  for (int n = 0; n < 300; ++n) {
    const Known k = random_known(random, 3);
    if (doubled_area(k.t) < 2 * 65536) continue;
    const TriangleInterpolator interpolator(k.p_clip, kInterpolatedView);
    for (int y = 0; y < 64; y += 3) {
      for (int x = 0; x < 64; x += 3) {
        if (!covers(k.t, x, y)) continue;
        const SurfacePoint point = interpolator.at(x, y);
        for (int i = 0; i < 3; ++i) {
          long double low = 1e9L, high = -1e9L;
          for (const long double dx : {-1.0L, 1.0L}) {
            for (const long double dy : {-1.0L, 1.0L}) {
              const Exact e = exact_at(k, 256.0L * x + 128 + dx, 256.0L * y + 128 + dy);
              low = std::min(low, e.weight[i]), high = std::max(high, e.weight[i]);
            }
          }
          ASSERT_GE(point.weight[i], static_cast<float>(low) - 1e-7f);
          ASSERT_LE(point.weight[i], static_cast<float>(high) + 1e-7f);
        }
      }
    }
  }
}

TEST(Interpolate, EdgeDistancesAreWindowDistances) {
  // A right triangle with legs along x = 8 and y = 8; its long edge is x + y = 48.
  const std::array<glm::vec4, 3> p = {clip_from_window(8, 8, 0.5, 1, kInterpolatedView),
                                      clip_from_window(40, 8, 0.5, 4, kInterpolatedView),
                                      clip_from_window(8, 40, 0.5, 16, kInterpolatedView)};
  for (const std::array<int, 3> order : {std::array{0, 1, 2}, std::array{0, 2, 1}}) {
    const TriangleInterpolator interpolator({p[order[0]], p[order[1]], p[order[2]]},
                                            kInterpolatedView);
    const SurfacePoint point = interpolator.at(12, 20);
    EXPECT_NEAR(point.edge_distance_px[0], (48.0 - 12.5 - 20.5) / std::sqrt(2.0), 1e-5);
    EXPECT_NEAR(point.edge_distance_px[order[1] == 1 ? 1 : 2], 4.5, 1e-6);
    EXPECT_NEAR(point.edge_distance_px[order[1] == 1 ? 2 : 1], 12.5, 1e-6);
  }
}

// A ground through the eye's feet: one vertex behind the camera. The weights rebuild the point
// of the plane that the pixel's ray hits.
TEST(Interpolate, ATriangleThatReachesBehindTheCameraHasTheWeightsOfItsPlane) {
  const auto ground = [](double x_m, double depth_m) { return glm::vec4(x_m, -2.0, 0.1, depth_m); };
  const std::array<glm::vec4, 3> p = {ground(-30, 40), ground(30, 40), ground(0, -20)};
  const TriangleInterpolator interpolator(p, kInterpolatedView);
  for (int y = 40; y < 64; ++y) {
    const SurfacePoint point = interpolator.at(31, y);
    // y_ndc = -2 / w = 1 - (y + 0.5) / 32.
    const double w = 2.0 / ((y + 0.5) / 32 - 1.0);
    double rebuilt_w = 0.0, rebuilt_x = 0.0;
    for (int i = 0; i < 3; ++i) {
      rebuilt_w += double{point.weight[i]} * double{p[i].w};
      rebuilt_x += double{point.weight[i]} * double{p[i].x};
    }
    EXPECT_NEAR(rebuilt_w, w, 1e-5);
    EXPECT_NEAR(rebuilt_x, (31.5 / 32 - 1.0) * w, 1e-5);
    EXPECT_NEAR(double{point.w_clip}, w, 1e-6 * w);
    for (const float d : point.edge_distance_px) EXPECT_GT(d, 0.0f);
  }
}

}  // namespace
}  // namespace swell::raster
