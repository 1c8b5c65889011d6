// Which pixels need samples? Every one that holds a covered sample, and few others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "raster/sample_picture.h"
#include "trials.h"

namespace swell::raster {
namespace {

bool holds_covered_sample(const Triangle& t, int x, int y, int samples) {
  for (int s = 0; s < samples; ++s) {
    if (covers_point(t, sample_point(x, y, s, samples))) return true;
  }
  return false;
}

// True if the triangle and the pixel's square have no point in common: some edge of either one
// separates them. In whole 1/256 px.
bool is_apart(const Triangle& t, int x, int y) {
  const std::int64_t x0 = 256 * std::int64_t{x}, y0 = 256 * std::int64_t{y};
  const auto [left, right] = std::minmax({t[0].x, t[1].x, t[2].x});
  const auto [top, bottom] = std::minmax({t[0].y, t[1].y, t[2].y});
  if (right < x0 || left > x0 + 256 || bottom < y0 || top > y0 + 256) return true;
  const std::int64_t area =
      (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (t[1].y - t[0].y);
  for (int i = 0; i < 3; ++i) {
    const Point &a = t[i], &b = t[(i + 1) % 3];
    bool any_inside = false;
    for (const Point& p :
         {Point{x0, y0}, Point{x0 + 256, y0}, Point{x0, y0 + 256}, Point{x0 + 256, y0 + 256}}) {
      const std::int64_t e = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
      any_inside |= area > 0 ? e >= 0 : e <= 0;
    }
    if (!any_inside) return true;
  }
  return false;
}

struct MarkTally {
  int missed = 0, apart = 0, covered = 0, marked = 0;
};

void check_marks(const std::vector<int>& marks, const Triangle& t, Viewport viewport, int samples,
                 MarkTally& tally) {
  for (int y = 0; y < viewport.height_px; ++y) {
    for (int x = 0; x < viewport.width_px; ++x) {
      const bool marked = marks[y * viewport.width_px + x] != 0;
      const bool covered = holds_covered_sample(t, x, y, samples);
      tally.missed += covered && !marked;
      tally.apart += marked && is_apart(t, x, y);
      tally.covered += covered;
      tally.marked += marked;
    }
  }
}

TEST(Marks, HoldEveryPixelWithACoveredSampleAndNoneApartFromTheTriangle) {
  constexpr Viewport kView{128, 64};
  Random random(1);
  MarkTally tally;
  for (int n = 0; n < trials(1000); ++n) {
    const int samples = kSampleCounts[n % 2];
    FlatSoup soup;
    Triangle t = any_triangle(random, kView);
    const std::int64_t area =
        (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (t[1].y - t[0].y);
    if (area == 0) t[2].y += 40;
    soup.add(t, 0.5f, kView);
    const Draw draw = soup.draw();
    const std::vector<int> marks =
        mark_picture(std::span(&draw, 1), kView, samples, 16 << (n % 3), 0, 1);
    check_marks(marks, t, kView, samples, tally);
    for (const Configuration& c : all_configurations(std::array{1})) {
      const ScopedSimdTarget target(c.target);
      ASSERT_EQ(mark_picture(std::span(&draw, 1), kView, samples, c.tile_size_px, 0, 1), marks);
    }
  }
  EXPECT_EQ(tally.missed, 0);
  EXPECT_EQ(tally.apart, 0);
  EXPECT_GT(tally.covered, trials(1000) * 300);
  // Not much more than needed.
  EXPECT_LT(tally.marked, 1.03 * tally.covered);
}

TEST(Marks, FollowALeaningMastNotItsBox) {
  constexpr Viewport kView{128, 256};
  for (const int samples : kSampleCounts) {
    for (const double lean : {0.0, 3.0, 40.0, -70.0}) {
      const double x = 80.0 + 0.1;
      FlatSoup soup;
      const auto at = [](double px, double py) {
        return Point{std::llround(256.0 * px), std::llround(256.0 * py)};
      };
      const Point a = at(x, 20), b = at(x + 0.3, 20), c = at(x + lean, 220),
                  d = at(x + lean + 0.3, 220);
      soup.add({a, b, c}, 0.5f, kView);
      soup.add({c, b, d}, 0.5f, kView);
      const Draw draw = soup.draw();
      const std::vector<int> marks = mark_picture(std::span(&draw, 1), kView, samples, 64, 0, 2);
      const SamplePicture picture = draw_sample_picture(draw, kView, samples);
      int total = 0;
      for (int y = 0; y < kView.height_px; ++y) {
        int in_row = 0;
        for (int column = 0; column < kView.width_px; ++column) {
          const int marked = marks[y * kView.width_px + column];
          in_row += marked;
          ASSERT_TRUE(marked != 0 || picture.coverage(column, y) == 0.0) << column << ", " << y;
        }
        // A row's part of the mast is at most 0.3 + 70 / 200 px wide.
        EXPECT_LE(in_row, 3) << "lean " << lean << " row " << y;
        total += in_row;
      }
      EXPECT_GE(total, 170);
      EXPECT_LE(total, 400);
    }
  }
}

TEST(Marks, AreOfTheNamedPrimitivesOnlyAlsoAmongManyChunks) {
  constexpr Viewport kView{128, 64};
  Random random(2);
  // Two draws with numbers of their own and more triangles than a chunk holds.
  FlatSoup soups[2];
  for (FlatSoup& soup : soups) {
    for (int n = 0; n < 1500; ++n) {
      const Point p{random.integer(0, 256 * 128), random.integer(0, 256 * 64)};
      soup.add({{p, {p.x + 300, p.y + 40}, {p.x + 90, p.y + 280}}}, 0.5f, kView);
    }
  }
  std::vector<Draw> draws = {soups[0].draw(), soups[1].draw()};
  draws[0].first_primitive = 10'000;
  draws[1].first_primitive = 70;
  struct Range {
    std::uint32_t first, end;
  };
  for (const Range& range : {Range{11'022, 11'027}, Range{1569, 10'001}, Range{70, 71},
                             Range{0, 70}, Range{1570, 10'000}, Range{11'499, kNoPrimitive}}) {
    const std::vector<int> marks = mark_picture(draws, kView, 8, 32, range.first, range.end);
    std::vector<int> expected(marks.size());
    for (int d = 0; d < 2; ++d) {
      for (std::uint32_t n = 0; n < 1500; ++n) {
        const std::uint32_t primitive = draws[d].first_primitive + n;
        if (primitive < range.first || primitive >= range.end) continue;
        const Draw alone{.p_clip = draws[d].p_clip, .indices = draws[d].indices.subspan(3 * n, 3)};
        const std::vector<int> one = mark_picture(std::span(&alone, 1), kView, 8, 32, 0, 1);
        for (std::size_t i = 0; i < one.size(); ++i) expected[i] |= one[i];
      }
    }
    ASSERT_EQ(marks, expected) << range.first << " to " << range.end;
  }
}

TEST(Marks, AreAddedToThoseThatStandAlready) {
  constexpr Viewport kView{32, 32};
  FlatSoup soup;
  soup.add({{{512, 512}, {1024, 512}, {512, 1024}}}, 0.5f, kView);
  const Draw draw = soup.draw();
  Pass pass;
  Workers workers(1);
  prepare_pass(std::span(&draw, 1), kView, 32, pass, workers, 4);
  PixelMask mask;
  mask.add(31, 30);
  mark_touched(pass, 0, 0, 1, mask);
  EXPECT_TRUE(mask.has(31, 30));
  EXPECT_TRUE(mask.has(2, 2));
  EXPECT_FALSE(mask.has(4, 4));
  EXPECT_EQ(mask.count(),
            4);  // three of the 2 x 2 box hold samples, the fourth's corner is touched
  mask.clear();
  EXPECT_EQ(mask.count(), 0);
}

// AAX-03: asking for samples changes no bit of the centre pass.
TEST(CentrePass, KeepsItsBitsAndCountWhenSamplesAreAskedFor) {
  Random random(3);
  Workers workers(1);
  std::uint64_t more = 0;
  for (int n = 0; n < trials(200); ++n) {
    const Viewport viewport{1 + n % 130, static_cast<int>(random.integer(1, 130))};
    const int size = 16 << (n % 3);
    const FlatSoup soup = random_flat_soup(random, 50, {128, 128});
    Draw draw = soup.draw();
    draw.cull = static_cast<Cull>(n % 5 % 3);
    const Picture before = draw_picture(std::span(&draw, 1), viewport, size, workers);
    for (const int samples : kSampleCounts) {
      for (const Configuration& c : all_configurations(std::array{1})) {
        if (c.tile_size_px != size) continue;
        const ScopedSimdTarget target(c.target);
        const Picture after = draw_picture(std::span(&draw, 1), viewport, size, workers, samples);
        ASSERT_TRUE(after.same_bits(before)) << n;
        const PassStatistics &a = before.statistics, &b = after.statistics;
        ASSERT_EQ(a.set_up_for_samples, 0u);
        ASSERT_EQ(a.set_up, b.set_up - b.set_up_for_samples);
        ASSERT_EQ(a.culled_between_pixels, b.culled_between_pixels + b.set_up_for_samples);
        ASSERT_LE(a.binned, b.binned);
        more += b.set_up_for_samples;
      }
    }
  }
  EXPECT_GT(more, 100u);
}

using SamplesDeathTest = testing::Test;

TEST(SamplesDeathTest, CallersMistakesStopWithTheirValues) {
  Pass pass;
  Workers workers(1);
  EXPECT_DEATH(prepare_pass({}, {20, 20}, 16, pass, workers, 2), "samples=2");
  EXPECT_DEATH(prepare_pass({}, {20, 20}, 16, pass, workers, -4), "samples=-4");
  PixelMask mask;
  mask.add(15, 15);
  std::vector<float> depth(4), shallow(3);
  std::vector<std::uint32_t> primitive(4), fewer(3);
  prepare_pass({}, {20, 20}, 16, pass, workers);
  EXPECT_DEATH(mark_touched(pass, 0, 0, 1, mask), "samples=0");
  EXPECT_DEATH(draw_samples(pass, 0, mask, depth, primitive), "samples=0");
  prepare_pass({}, {20, 20}, 16, pass, workers, 4);
  EXPECT_DEATH(mark_touched(pass, 4, 0, 1, mask), "tile=4 tiles=4");
  EXPECT_DEATH(mark_touched(pass, 0, 2, 1, mask), "first_primitive=2 end_primitive=1");
  EXPECT_DEATH(draw_samples(pass, -1, mask, depth, primitive), "tile=-1 tiles=4");
  EXPECT_DEATH(draw_samples(pass, 0, mask, shallow, primitive), "depth=3 primitive=4 of 4");
  EXPECT_DEATH(draw_samples(pass, 0, mask, depth, fewer), "depth=4 primitive=3 of 4");
  EXPECT_EQ(draw_samples(pass, 0, mask, depth, primitive), 0);
  mask.add(16, 3);
  EXPECT_DEATH(draw_samples(pass, 0, mask, depth, primitive), "tile_size_px=16");
  mask.clear();
  mask.add(3, 16);
  EXPECT_DEATH(draw_samples(pass, 0, mask, depth, primitive), "tile_size_px=16");
}

}  // namespace
}  // namespace swell::raster
