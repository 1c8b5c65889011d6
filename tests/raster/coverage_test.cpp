// Which pixels does a triangle cover? Exactly those that 64-bit integers say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "raster/picture.h"

namespace swell::raster {
namespace {

constexpr int kThreads[] = {1, 3};

// Up to 256 triangles, each in a cell of its own, so that each can be checked by itself.
constexpr int kCellPx = 32, kCellsPerRow = 16;
constexpr Viewport kCells{kCellPx * kCellsPerRow, kCellPx* kCellsPerRow};

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
    batch.add(t, kCells);
  }
  return batch;
}

struct Tally {
  int wrong = 0, covered = 0, rule_matters = 0;
};

// Compares the triangle's cell with the oracle.
void check_cell(const Picture& picture, const Triangle& t, int cell, Tally& tally) {
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
  Tally tally;
  constexpr int kBatches = 400;
  for (int b = 0; b < kBatches; ++b) {
    const Batch batch = random_batch(random);
    const Draw draw = batch.draw();
    std::optional<Picture> first;
    for (const Configuration& c : all_configurations(kThreads)) {
      // Every batch runs on every SIMD target; tile sizes and thread counts take turns.
      const bool turn = (c.tile_size_px / 16 + c.threads + b) % 3 == 0;
      if (first && !turn) continue;
      const ScopedSimdTarget target(c.target);
      Picture picture =
          draw_picture(std::span(&draw, 1), kCells, c.tile_size_px, c.threads == 1 ? one : three);
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
  EXPECT_GT(tally.covered, 1'000'000);
  // Otherwise the test proves nothing about the fill rule.
  EXPECT_GT(tally.rule_matters, 1000);
  RecordProperty("rule_matters", tally.rule_matters);
}

}  // namespace
}  // namespace swell::raster
