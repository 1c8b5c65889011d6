// The depth of a pixel, and which of several triangles is seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "raster/picture.h"

namespace swell::raster {
namespace {

struct Scene {
  std::vector<glm::vec4> p_clip;
  std::vector<std::uint32_t> indices;

  Draw draw() const { return {.p_clip = p_clip, .indices = indices}; }
  void add(const std::array<glm::vec4, 3>& triangle) {
    for (const glm::vec4& p : triangle) {
      indices.push_back(static_cast<std::uint32_t>(p_clip.size()));
      p_clip.push_back(p);
    }
  }
  // A triangle that covers everything at one depth.
  void add_screen(float z, float w) {
    add({glm::vec4(-w, -w, z, w), glm::vec4(3 * w, -w, z, w), glm::vec4(-w, 3 * w, z, w)});
  }
};

// A triangle on the 1/256 grid with given depths, in a power-of-two viewport, so that nothing
// rounds before the rasterizer's own arithmetic.
struct KnownTriangle {
  Triangle t;
  std::array<double, 3> z;
  std::array<glm::vec4, 3> p_clip;
};

KnownTriangle random_known(Random& random, Viewport viewport) {
  KnownTriangle k;
  for (int i = 0; i < 3; ++i) {
    k.t[i] = {random.integer(0, 256 * viewport.width_px),
              random.integer(0, 256 * viewport.height_px)};
    k.z[i] = double{static_cast<float>(std::exp2(random.between(-8.0, 0.0)))};
    k.p_clip[i] = clip_from_fx8(k.t[i], k.z[i], 1.0, viewport);
  }
  return k;
}

// The plane through the three vertices at a pixel centre, by barycentric weights in long double.
double plane_at(const KnownTriangle& k, int x, int y) {
  const auto cross = [](long double ax, long double ay, long double bx, long double by) {
    return ax * by - ay * bx;
  };
  const long double px = 256.0L * x + 128, py = 256.0L * y + 128;
  long double sum = 0, area = 0;
  for (int i = 0; i < 3; ++i) {
    const Point &a = k.t[(i + 1) % 3], &b = k.t[(i + 2) % 3];
    const long double ax = static_cast<long double>(a.x), ay = static_cast<long double>(a.y);
    const long double bx = static_cast<long double>(b.x), by = static_cast<long double>(b.y);
    const long double e = cross(bx - ax, by - ay, px - ax, py - ay);
    sum += e * k.z[i];
    area += e;
  }
  return static_cast<double>(sum / area);
}

// RAS-10: affine, and near the exact plane. The error grows with the gradient's share: a step of
// 64 px in float costs half an ULP of the larger of the terms that are added.
TEST(Depth, LiesOnTheVerticesPlaneWithinFourUlpOfTheLargestDepth) {
  constexpr Viewport kView{64, 64};
  Random random(1);
  int checked = 0;
  for (int n = 0; n < 400; ++n) {
    const KnownTriangle k = random_known(random, kView);
    Scene scene;
    scene.add(k.p_clip);
    const Picture picture = draw_picture(scene.draw(), kView);
    if (picture.covered < 200) continue;  // slivers have gradients without bound
    const auto [low, high] = std::minmax({k.z[0], k.z[1], k.z[2]});
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        if (picture.primitive_at(x, y) == kNoPrimitive) continue;
        const double z = double{picture.depth_at(x, y)};
        ASSERT_NEAR(z, plane_at(k, x, y), 4 * ulp(static_cast<float>(high)));
        ASSERT_GE(z, low);
        ASSERT_LE(z, high);
        ++checked;
        if (x == 0 || x == 63 || picture.primitive_at(x - 1, y) == kNoPrimitive ||
            picture.primitive_at(x + 1, y) == kNoPrimitive) {
          continue;
        }
        const double second =
            double{picture.depth_at(x - 1, y)} - 2 * z + double{picture.depth_at(x + 1, y)};
        ASSERT_LE(std::abs(second), 4 * ulp(static_cast<float>(high)));
      }
    }
  }
  EXPECT_GT(checked, 50'000);
}

// The sea's own case: on a level ground to the horizon near / w is proportional to the row below
// the horizon. Snapped vertices turn the plane a little.
TEST(Depth, ALevelGroundToTheHorizonHasTheDepthOfItsRow) {
  constexpr Viewport kView{256, 128};
  const auto ground = [&](double x_m, double depth_m) {
    return glm::vec4(x_m, -2.0, 0.1, depth_m);  // 2 m below the eye, 90 degrees
  };
  Scene scene;
  scene.add({ground(-3, 2.5), ground(900, 1000), ground(-900, 1000)});
  scene.add({ground(-3, 2.5), ground(3, 2.5), ground(900, 1000)});
  const Picture picture = draw_picture(scene.draw(), kView);
  int checked = 0;
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 256; ++x) {
      if (picture.primitive_at(x, y) == kNoPrimitive) continue;
      const double exact = 0.1 * (y + 0.5 - 64) / (2.0 * 64);
      EXPECT_NEAR(double{picture.depth_at(x, y)}, exact, 1e-5) << x << "," << y;
      ++checked;
    }
  }
  EXPECT_GT(checked, 5000);
}

// RAS-10: triangles of one plane whose numbers need no rounding meet exactly.
TEST(Depth, CoplanarTrianglesOnTheGridMeetWithinOneUlp) {
  constexpr Viewport kView{64, 64};
  const auto vertex = [&](double x, double y) {
    return clip_from_window(x, y, (3.0 + 2.0 * x + 5.0 * y) / 1024.0, 1.0, kView);
  };
  const glm::vec4 a = vertex(0, 0), b = vertex(64, 0), c = vertex(0, 64), d = vertex(64, 64);
  Scene scene;
  scene.add({a, b, c});
  scene.add({b, d, c});
  const Picture picture = draw_picture(scene.draw(), kView);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const auto exact = static_cast<float>((3.0 + 2.0 * (x + 0.5) + 5.0 * (y + 0.5)) / 1024.0);
      ASSERT_NEAR(double{picture.depth_at(x, y)}, double{exact}, ulp(exact));
    }
  }
}

TEST(Depth, SurfacesTenEpsilonsApartResolveAtEveryDistance) {
  constexpr Viewport kView{16, 16};
  constexpr float kStep = 10.0f * std::numeric_limits<float>::epsilon();
  for (float w = 10.0f; w < 2e16f; w *= 10.0f) {
    for (const bool nearer_first : {false, true}) {
      Scene scene;
      scene.add_screen(0.1f, nearer_first ? w * (1.0f - kStep) : w);
      scene.add_screen(0.1f, nearer_first ? w : w * (1.0f - kStep));
      const Picture picture = draw_picture(scene.draw(), kView);
      const std::uint32_t nearer = nearer_first ? 0 : 1;
      EXPECT_EQ(std::count(picture.primitive.begin(), picture.primitive.end(), nearer), 256) << w;
    }
  }
}

TEST(Depth, InfinitelyFarTrianglesAreSeenWhereNothingElseIs) {
  constexpr Viewport kView{20, 20};
  Scene scene;
  scene.add_screen(0.0f, 1.0f);
  const Picture picture = draw_picture(scene.draw(), kView);
  EXPECT_EQ(picture.covered, 400);
  EXPECT_EQ(*std::max_element(picture.depth.begin(), picture.depth.end()), 0.0f);
}

// 1000 triangles of one depth and as many at random depths, in many chunks' worth of draws: the
// nearest wins, and of equally near ones the first, whatever thread did which chunk.
TEST(Order, TheFirstOfEquallyNearTrianglesWinsOnEveryConfiguration) {
  constexpr Viewport kView{200, 120};
  constexpr int kThreads[] = {1, 2, 3, 7};
  Random random(2);
  std::vector<Scene> scenes(3);
  std::vector<Draw> draws;
  std::vector<std::pair<Triangle, float>> all;
  for (Scene& scene : scenes) {
    for (int n = 0; n < 2500; ++n) {
      Triangle t;
      const std::int64_t cx = random.integer(0, 200 * 256), cy = random.integer(0, 120 * 256);
      const std::int64_t size = n % 50 == 0 ? 20000 : n % 2 == 0 ? 3000 : 800;
      for (Point& p : t) {
        p = {cx + random.integer(-size, size), cy + random.integer(-size, size)};
      }
      const float depth = static_cast<float>(random.integer(1, 4)) / 4.0f;
      std::array<glm::vec4, 3> p_clip;
      for (int i = 0; i < 3; ++i) p_clip[i] = clip_from_fx8(t[i], double{depth}, 1.0, kView);
      scene.add(p_clip);
      all.push_back({t, depth});
    }
  }
  std::uint32_t first = 0;
  for (const Scene& scene : scenes) {
    draws.push_back(scene.draw());
    draws.back().first_primitive = first;
    first += 2500;
  }

  // The oracle: a loop over all triangles.
  std::vector<std::uint32_t> expected(200 * 120, kNoPrimitive);
  std::vector<float> depth(expected.size(), -1.0f);
  for (std::uint32_t n = 0; n < all.size(); ++n) {
    const auto& [t, z] = all[n];
    const auto [x0, x1] = std::minmax({t[0].x, t[1].x, t[2].x});
    const auto [y0, y1] = std::minmax({t[0].y, t[1].y, t[2].y});
    for (int y = std::max(0, static_cast<int>(y0 / 256) - 1); y < 120 && y <= y1 / 256; ++y) {
      for (int x = std::max(0, static_cast<int>(x0 / 256) - 1); x < 200 && x <= x1 / 256; ++x) {
        if (z <= depth[y * 200 + x] || !covers(t, x, y)) continue;
        depth[y * 200 + x] = z;
        expected[y * 200 + x] = n;
      }
    }
  }
  for (const int threads : kThreads) {
    Workers workers(threads);
    for (const Configuration& c : all_configurations(std::span(&threads, 1))) {
      const ScopedSimdTarget target(c.target);
      const Picture picture = draw_picture(draws, kView, c.tile_size_px, workers);
      ASSERT_EQ(picture.primitive, expected) << threads << " threads, tile " << c.tile_size_px;
    }
  }
}

}  // namespace
}  // namespace swell::raster
