// Small triangles, which are drawn side by side, against those of any size, set up one by one.
#include "raster/small_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "raster/picture.h"

namespace swell::raster {
namespace {

constexpr Viewport kSmallView{200, 136};  // no multiple of a tile

struct SlopedSoup {
  std::vector<Triangle> triangles;
  std::vector<std::array<float, 3>> depth;
  std::vector<glm::vec4> p_clip;
  std::vector<std::uint32_t> indices;

  Draw draw() const { return {.p_clip = p_clip, .indices = indices}; }
};

// Slivers and all; every third is level, at one of three depths; many lie one on the other.
SlopedSoup random_sloped_soup(Random& random, int count) {
  SlopedSoup soup;
  for (int n = 0; n < count; ++n) {
    const std::int64_t x = random.integer(-512, 256 * kSmallView.width_px + 512);
    const std::int64_t y = random.integer(-512, 256 * kSmallView.height_px + 512);
    const auto wide = static_cast<std::int64_t>(std::exp2(random.between(6.0, 11.5)));
    const auto tall = static_cast<std::int64_t>(std::exp2(random.between(6.0, 11.5)));
    Triangle t;
    std::array<float, 3> depth;
    const auto level = static_cast<float>(random.integer(1, 3)) / 4.0f;
    for (std::size_t i = 0; i < 3; ++i) {
      t[i] = {x + random.integer(0, wide), y + random.integer(0, tall)};
      depth[i] = n % 3 == 0 ? level : static_cast<float>(random.uniform());
      soup.indices.push_back(static_cast<std::uint32_t>(soup.p_clip.size()));
      soup.p_clip.push_back(clip_from_fx8(t[i], double{depth[i]}, 1.0, kSmallView));
    }
    soup.triangles.push_back(t);
    soup.depth.push_back(depth);
  }
  return soup;
}

// The plane of a triangle at a pixel's centre, of any size.
float plane_depth(const SetupTriangle& t, int x, int y) {
  const auto to_px = [](int px, std::int32_t ref_fx8) {
    return static_cast<float>(px * 256 + 128 - ref_fx8) / 256.0f;
  };
  const float row = std::fma(t.dz_dy, to_px(y, t.y_ref_fx8), t.z_min);
  return std::clamp(std::fma(t.dz_dx, to_px(x, t.x_ref_fx8), row), t.z_min, t.z_max);
}

// A loop over all triangles.
Picture sloped_picture(const SlopedSoup& soup) {
  Picture picture{kSmallView.width_px, kSmallView.height_px, {}, {}, 0, {}};
  const auto pixels = static_cast<std::size_t>(kSmallView.width_px) * kSmallView.height_px;
  picture.depth.assign(pixels, -1.0f);
  picture.primitive.assign(pixels, kNoPrimitive);
  for (std::uint32_t n = 0; n < soup.triangles.size(); ++n) {
    const Triangle& t = soup.triangles[n];
    std::array<WindowVertex, 3> v;
    for (std::size_t i = 0; i < 3; ++i)
      v[i] = {static_cast<std::int32_t>(t[i].x), static_cast<std::int32_t>(t[i].y),
              soup.depth[n][i], 0};
    SetupTriangle setup;
    if (set_up_triangle(v[0], v[1], v[2], {Cull::kNone, kSmallView, 0}, n, setup) !=
        SetupResult::kReady)
      continue;
    for (int y = setup.min_y; y <= setup.max_y; ++y)
      for (int x = setup.min_x; x <= setup.max_x; ++x) {
        const auto i = static_cast<std::size_t>(y * kSmallView.width_px + x);
        const float z = plane_depth(setup, x, y);
        if (!covers(t, x, y) || !(z > picture.depth[i])) continue;
        picture.depth[i] = z;
        picture.primitive[i] = n;
      }
  }
  for (float& z : picture.depth) z = std::max(z, 0.0f);
  return picture;
}

TEST(SmallTriangles, HaveTheBitsOfThoseOfAnySize) {
  Random random(5);
  for (int n = 0; n < 6; ++n) {
    const SlopedSoup soup = random_sloped_soup(random, 20'000);
    const Draw draw = soup.draw();
    const Picture expected = sloped_picture(soup);
    const int covered = static_cast<int>(expected.primitive.size()) -
                        static_cast<int>(std::ranges::count(expected.primitive, kNoPrimitive));
    EXPECT_GT(covered, 9'000);
    for (const Configuration& c : all_configurations(kThreadCounts)) {
      const ScopedSimdTarget target(c.target);
      Workers workers(c.threads);
      for (const int samples : {0, 4}) {
        const Picture picture =
            draw_picture(std::span(&draw, 1), kSmallView, c.tile_size_px, workers, samples);
        ASSERT_EQ(picture.depth, expected.depth) << "tile " << c.tile_size_px;
        ASSERT_EQ(picture.primitive, expected.primitive) << "tile " << c.tile_size_px;
      }
    }
  }
}

// Each is listed where its samples lie, and is not drawn twice.
TEST(SmallTriangles, OnTheCornerOfFourTilesAreListedInAllOfThem) {
  const Triangle t = {{{63 * 256, 62 * 256}, {66 * 256, 63 * 256}, {63 * 256, 67 * 256}}};
  SlopedSoup soup;
  for (std::size_t i = 0; i < 3; ++i) {
    soup.indices.push_back(static_cast<std::uint32_t>(i));
    soup.p_clip.push_back(clip_from_fx8(t[i], 0.5, 1.0, kSmallView));
  }
  Workers workers(1);
  const Draw draw = soup.draw();
  const Picture picture = draw_picture(std::span(&draw, 1), kSmallView, 64, workers, 4);
  EXPECT_EQ(picture.statistics.binned, 4u);
  EXPECT_EQ(picture.statistics.set_up, 1u);
  for (int y = 60; y < 70; ++y)
    for (int x = 60; x < 70; ++x)
      EXPECT_EQ(picture.primitive_at(x, y) == 0, covers(t, x, y)) << x << " " << y;
}

}  // namespace
}  // namespace swell::raster
