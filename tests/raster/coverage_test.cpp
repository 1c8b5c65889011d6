// Which pixels does a triangle cover? Exactly those that 64-bit integers say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "raster/picture.h"
#include "trials.h"

namespace swell::raster {
namespace {

// Up to 256 triangles, each in a cell of its own, so that each can be checked by itself.
constexpr int kCellPx = 32, kCellsPerRow = 16;
constexpr Viewport kCellsView{kCellPx * kCellsPerRow, kCellPx* kCellsPerRow};

constexpr int kBatches = trials(400);

struct Batch {
  std::vector<Triangle> triangles;
  std::vector<glm::vec4> p_clip;
  std::vector<std::uint32_t> indices;

  Draw draw() const { return {.p_clip = p_clip, .indices = indices}; }
  void add(const Triangle& t, Viewport viewport) {
    triangles.push_back(t);
    for (const Point& p : t) {
      indices.push_back(static_cast<std::uint32_t>(p_clip.size()));
      p_clip.push_back(clip_from_fx8(p, 0.5, 1.0, viewport));
    }
  }
};

// Sizes from 1/32 px to the box; a third on multiples of 1/2 px; a quarter with two equal y, a
// quarter with two equal x; either winding.
Triangle random_triangle(Random& random, int box_px) {
  Triangle t;
  const std::int64_t limit = 256 * std::int64_t{box_px};
  const double size = std::exp2(random.between(-5.0, std::log2(box_px))) * 256.0;
  const double cx = random.between(0, static_cast<double>(limit));
  const double cy = random.between(0, static_cast<double>(limit));
  const bool coarse = random.integer(0, 2) == 0;
  for (Point& p : t) {
    p.x = std::clamp<std::int64_t>(std::llround(cx + random.between(-size, size)), 0, limit);
    p.y = std::clamp<std::int64_t>(std::llround(cy + random.between(-size, size)), 0, limit);
    if (coarse) p = {(p.x + 64) / 128 * 128, (p.y + 64) / 128 * 128};
  }
  const std::int64_t kind = random.integer(0, 3);
  if (kind == 0) t[1].y = t[0].y;
  if (kind == 1) t[2].x = t[0].x;
  return t;
}

Batch random_batch(Random& random) {
  Batch batch;
  for (int cell = 0; cell < kCellsPerRow * kCellsPerRow; ++cell) {
    Triangle t = random_triangle(random, kCellPx);
    for (Point& p : t) {
      p.x += 256 * kCellPx * (cell % kCellsPerRow);
      p.y += 256 * kCellPx * (cell / kCellsPerRow);
    }
    batch.add(t, kCellsView);
  }
  return batch;
}

struct CoverageTally {
  int wrong = 0, covered = 0, rule_matters = 0;
};

// Compares the triangle's cell with the oracle.
void check_cell(const Picture& picture, const Triangle& t, int cell, CoverageTally& tally) {
  const int x0 = cell % kCellsPerRow * kCellPx, y0 = cell / kCellsPerRow * kCellPx;
  bool matters = false;
  for (int y = y0; y < y0 + kCellPx; ++y) {
    for (int x = x0; x < x0 + kCellPx; ++x) {
      const bool expected = covers(t, x, y);
      const bool drawn = picture.primitive_at(x, y) == static_cast<std::uint32_t>(cell);
      const bool empty = picture.primitive_at(x, y) == kNoPrimitive;
      tally.wrong += expected ? !drawn : !empty;
      tally.covered += expected;
      matters |= expected != covers(t, x, y, Ties::kBottomLeft);
    }
  }
  tally.rule_matters += matters;
}

// RAS-01. The picture of the first configuration is checked pixel by pixel, the others bit by bit
// against it.
TEST(Coverage, HundredThousandTrianglesEqualTheIntegerOracleOnEveryConfiguration) {
  Random random(1);
  Workers one(1), three(3);
  CoverageTally tally;
  for (int b = 0; b < kBatches; ++b) {
    const Batch batch = random_batch(random);
    const Draw draw = batch.draw();
    std::optional<Picture> first;
    for (const Configuration& c : all_configurations(kThreadCounts)) {
      // Every batch runs on every SIMD target; tile sizes and thread counts take turns.
      const bool turn = (c.tile_size_px / 16 + c.threads + b) % 3 == 0;
      if (first && !turn) continue;
      const ScopedSimdTarget target(c.target);
      Picture picture = draw_picture(std::span(&draw, 1), kCellsView, c.tile_size_px,
                                     c.threads == 1 ? one : three);
      if (first) {
        ASSERT_TRUE(picture.same_bits(*first)) << "batch " << b << " tile " << c.tile_size_px;
      } else {
        first = std::move(picture);
      }
    }
    for (int cell = 0; cell < static_cast<int>(batch.triangles.size()); ++cell) {
      check_cell(*first, batch.triangles[cell], cell, tally);
    }
  }
  EXPECT_EQ(tally.wrong, 0);
  EXPECT_GT(tally.covered, 2500 * kBatches);
  // Otherwise the test proves nothing about the fill rule.
  EXPECT_GT(tally.rule_matters, 2 * kBatches);
  RecordProperty("rule_matters", tally.rule_matters);
}

int wrong_pixels(const Picture& picture, const Triangle& t) {
  int wrong = 0;
  for (int y = 0; y < picture.height_px; ++y) {
    for (int x = 0; x < picture.width_px; ++x) {
      wrong += (picture.primitive_at(x, y) == 0) != covers(t, x, y);
    }
  }
  return wrong;
}

// 24-bit coordinates and 48-bit products: what no 32-bit edge function could hold.
TEST(Coverage, TrianglesUpToTheGuardBandEqualTheIntegerOracle) {
  constexpr Viewport kView{256, 256};
  Random random(2);
  int wrong = 0, covered = 0;
  for (int n = 0; n < trials(400); ++n) {
    const std::int64_t limit = 256 * (n % 4 == 0 ? 12288 : n % 4 == 1 ? 3000 : 400);
    Triangle t;
    for (Point& p : t)
      p = {random.integer(-limit + 65536, limit), random.integer(-limit + 65536, limit)};
    if (n % 8 == 0)
      t = {{{-limit + 65536, -limit + 65536}, {limit, -limit + 65536 + n}, {n, limit}}};
    for (const Configuration& c : all_configurations(std::span(kThreadCounts, 1))) {
      if (c.tile_size_px != 16 << (n % 3)) continue;
      const ScopedSimdTarget target(c.target);
      Batch batch;
      batch.add(t, kView);
      const Picture picture = draw_picture(batch.draw(), kView, c.tile_size_px);
      EXPECT_EQ(picture.statistics.clipped, 0u);
      wrong += wrong_pixels(picture, t);
      covered += picture.covered;
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(covered, trials(1'000'000));
}

std::int64_t nearest_even(std::int64_t numerator, std::int64_t denominator) {
  const std::int64_t floor =
      (numerator - ((numerator % denominator) + denominator) % denominator) / denominator;
  const std::int64_t twice_rest = 2 * (numerator - floor * denominator);
  const bool up = twice_rest > denominator || (twice_rest == denominator && floor % 2 != 0);
  return floor + up;
}

// RAS-03: vertices on the 1/4096 px grid, half of them exactly between two steps of 1/256 px.
TEST(Coverage, VerticesSnapToTheNearestEvenStepOf1Over256) {
  constexpr Viewport kView{32, 32};
  Random random(3);
  int wrong = 0;
  for (int n = 0; n < 3000; ++n) {
    Batch batch;
    Triangle snapped;
    for (Point& p : snapped) {
      std::int64_t x = random.integer(0, 32 * 4096), y = random.integer(0, 32 * 4096);
      if (random.integer(0, 1) == 0) x = x / 16 * 16 + 8, y = y / 16 * 16 + 8;
      p = {nearest_even(x, 16), nearest_even(y, 16)};
      batch.indices.push_back(static_cast<std::uint32_t>(batch.p_clip.size()));
      batch.p_clip.push_back(clip_from_window(static_cast<double>(x) / 4096.0,
                                              static_cast<double>(y) / 4096.0, 0.5, 2.0, kView));
    }
    wrong += wrong_pixels(draw_picture(batch.draw(), kView, 32), snapped);
  }
  EXPECT_EQ(wrong, 0);
}

// Pixels farther than 3/256 px from every edge that are drawn and should not be, or reverse.
int clearly_wrong_pixels(const Picture& picture, const std::vector<glm::vec4>& p,
                         Viewport viewport) {
  const ExactLine lines[] = {
      {p[0], p[1], viewport}, {p[1], p[2], viewport}, {p[2], p[0], viewport}};
  int wrong = 0;
  for (int y = 0; y < viewport.height_px; ++y) {
    for (int x = 0; x < viewport.width_px; ++x) {
      double low = 1e300, high = -1e300, nearest = 1e300;
      for (const ExactLine& line : lines) {
        const double d = line.distance(x + 0.5, y + 0.5);
        low = std::min(low, d), high = std::max(high, d), nearest = std::min(nearest, std::abs(d));
      }
      const bool inside = low > 0.0 || high < 0.0;
      if (nearest > 3.0 / 256.0) wrong += inside != (picture.primitive_at(x, y) == 0);
    }
  }
  return wrong;
}

// RAS-07.
TEST(Coverage, VerticesFarBeyondTheGuardBandLeaveEveryPixelRight) {
  constexpr Viewport kView{64, 48};
  Random random(4);
  int wrong = 0, covered = 0;
  std::uint64_t clipped = 0;
  for (int n = 0; n < 1500; ++n) {
    Batch batch;
    for (std::uint32_t i = 0; i < 3; ++i) {
      constexpr double kFar[] = {1, 10, 30000, 1e5, 1e6, 1e30};
      const double far = kFar[random.integer(0, 5)];
      const double w = random.integer(0, 7) == 0 ? 1e-6 : random.between(0.2, 16.0);
      batch.p_clip.push_back(clip_from_window(32 + far * random.between(-1, 1) * 32,
                                              24 + far * random.between(-1, 1) * 24, 0.5, w,
                                              kView));
      batch.indices.push_back(i);
    }
    const Picture picture = draw_picture(batch.draw(), kView, 16);
    wrong += clearly_wrong_pixels(picture, batch.p_clip, kView);
    covered += picture.covered;
    clipped += picture.statistics.clipped;
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(covered, 100'000);
  EXPECT_GT(clipped, 700u);
}

// RAS-08 (b): any rotation of the vertices, also of triangles that are clipped.
TEST(Coverage, RotatingTheVerticesChangesNoBit) {
  constexpr Viewport kView{64, 64};
  Random random(5);
  for (int n = 0; n < trials(1500); ++n) {
    Batch batch;
    for (int i = 0; i < 3; ++i) {
      const double w = n % 3 == 0 ? random.between(-1.0, 3.0) : random.between(0.5, 3.0);
      batch.p_clip.push_back(glm::vec4(random.between(-3, 3), random.between(-3, 3), 0.4, w));
    }
    batch.indices = {0, 1, 2};
    const Picture first = draw_picture(batch.draw(), kView);
    batch.indices = {1, 2, 0};
    ASSERT_TRUE(draw_picture(batch.draw(), kView).same_bits(first)) << n;
    batch.indices = {2, 0, 1};
    ASSERT_TRUE(draw_picture(batch.draw(), kView).same_bits(first)) << n;
  }
}

// RAS-08 (a), (e): the same window positions, moved by whole pixels, in a larger viewport.
TEST(Coverage, MovingByWholePixelsInAnotherViewportMovesTheSameBits) {
  constexpr Viewport kSmall{64, 64}, kLarge{256, 128};
  Random random(6);
  for (int n = 0; n < 300; ++n) {
    const Triangle t = random_triangle(random, 64);
    const int dx = static_cast<int>(random.integer(0, 192)),
              dy = static_cast<int>(random.integer(0, 64));
    Batch batch, moved;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const double depth = static_cast<double>(random.integer(1, 64)) / 64.0;
      batch.p_clip.push_back(clip_from_fx8(t[i], depth, 1.0, kSmall));
      moved.p_clip.push_back(
          clip_from_fx8({t[i].x + 256 * dx, t[i].y + 256 * dy}, depth, 1.0, kLarge));
    }
    batch.indices = moved.indices = {0, 1, 2};
    const Picture a = draw_picture(batch.draw(), kSmall), b = draw_picture(moved.draw(), kLarge);
    ASSERT_EQ(a.covered, b.covered) << n;
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        ASSERT_EQ(a.primitive_at(x, y), b.primitive_at(x + dx, y + dy));
        ASSERT_EQ(a.depth_at(x, y), b.depth_at(x + dx, y + dy));
      }
    }
  }
}

TEST(Coverage, CullLeavesOutTheNamedWinding) {
  constexpr Viewport kView{32, 32};
  Batch batch;  // right, then down: clockwise on the screen
  batch.add({{{0, 0}, {4096, 0}, {0, 4096}}}, kView);
  Draw draw = batch.draw();
  draw.cull = Cull::kCounterClockwise;
  EXPECT_GT(draw_picture(draw, kView).covered, 0);
  draw.cull = Cull::kClockwise;
  const Picture culled = draw_picture(draw, kView);
  EXPECT_EQ(culled.covered, 0);
  EXPECT_EQ(culled.statistics.culled_facing, 1u);
}

}  // namespace
}  // namespace swell::raster
