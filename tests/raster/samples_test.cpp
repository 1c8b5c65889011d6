// Which triangle is seen at each sample of a pixel? The one that 64-bit integers say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "raster/sample_picture.h"
#include "trials.h"

namespace swell::raster {
namespace {

TEST(SamplePattern, HasThePositionsOfTheVulkanSpecification) {
  for (const int samples : kSampleCounts) {
    const std::span<const SamplePosition> positions = sample_positions(samples);
    ASSERT_EQ(static_cast<int>(positions.size()), samples);
    std::set<int> rows, columns;
    for (int s = 0; s < samples; ++s) {
      const Point expected = sample_point(0, 0, s, samples);
      EXPECT_EQ(positions[s].x_fx8, expected.x);
      EXPECT_EQ(positions[s].y_fx8, expected.y);
      columns.insert(positions[s].x_fx8);
      rows.insert(positions[s].y_fx8);
    }
    // No two share a row or a column, so a near-level edge has samples + 1 steps.
    EXPECT_EQ(static_cast<int>(rows.size()), samples);
    EXPECT_EQ(static_cast<int>(columns.size()), samples);
  }
  ASSERT_EQ(sample_positions(0).size(), 1u);
  EXPECT_EQ(sample_positions(0)[0].x_fx8, 128);
  EXPECT_EQ(sample_positions(0)[0].y_fx8, 128);
}

// A vertical edge at 8/16 px: the left half of a pixel. By hand from the positions above.
TEST(Samples, LeftHalfOfAPixelHoldsTheSamplesLeftOfItsCentre) {
  constexpr Viewport kView{32, 32};
  FlatSoup soup;
  soup.add({{{256 * 5 + 128, -256 * 10}, {256 * 5 + 128, 256 * 70}, {-256 * 40, 256 * 30}}}, 0.5f,
           kView);
  const SamplePicture four = draw_sample_picture(soup.draw(), kView, 4);
  const SamplePicture eight = draw_sample_picture(soup.draw(), kView, 8);
  constexpr bool kLeftOf4[] = {true, false, true, false};
  constexpr bool kLeftOf8[] = {false, true, false, true, true, true, false, false};
  for (int s = 0; s < 4; ++s) EXPECT_EQ(four.primitive_at(5, 9, s) == 0, kLeftOf4[s]) << s;
  for (int s = 0; s < 8; ++s) EXPECT_EQ(eight.primitive_at(5, 9, s) == 0, kLeftOf8[s]) << s;
  EXPECT_EQ(four.coverage(4, 9), 1.0);
  EXPECT_EQ(four.coverage(6, 9), 0.0);
}

struct SampleTally {
  int wrong = 0, covered = 0, rule_matters = 0;
};

// A loop over all triangles for every sample.
void check_against_oracle(const SamplePicture& picture, const FlatSoup& soup, SampleTally& tally) {
  for (int y = 0; y < picture.height_px; ++y) {
    for (int x = 0; x < picture.width_px; ++x) {
      for (int s = 0; s < picture.samples; ++s) {
        const Point p = sample_point(x, y, s, picture.samples);
        float depth = -1.0f;
        std::uint32_t expected = kNoPrimitive;
        for (std::uint32_t n = 0; n < soup.triangles.size(); ++n) {
          const bool inside = covers_point(soup.triangles[n], p);
          tally.rule_matters += inside != covers_point(soup.triangles[n], p, Ties::kBottomLeft);
          if (!inside || soup.z[n] <= depth) continue;
          depth = soup.z[n];
          expected = n;
        }
        const std::size_t i = picture.index(x, y, s);
        tally.wrong +=
            picture.primitive[i] != expected || picture.depth[i] != std::max(depth, 0.0f);
        tally.covered += expected != kNoPrimitive;
      }
    }
  }
}

// The first configuration is checked sample by sample, the others bit by bit against it.
TEST(Samples, SoupsOfAnyTrianglesEqualTheIntegerOracleOnEveryConfiguration) {
  constexpr Viewport kView{64, 128};
  Random random(1);
  Workers one(1), three(3);
  SampleTally tally;
  std::uint64_t for_samples = 0, degenerate = 0;
  constexpr int kSoups = trials(40);
  for (int n = 0; n < kSoups; ++n) {
    const int samples = kSampleCounts[n % 2];
    const FlatSoup soup = random_flat_soup(random, 40, kView);
    const Draw draw = soup.draw();
    std::optional<SamplePicture> first;
    for (const Configuration& c : all_configurations(kThreadCounts)) {
      const ScopedSimdTarget target(c.target);
      SamplePicture picture = draw_sample_picture(std::span(&draw, 1), kView, samples,
                                                  c.tile_size_px, c.threads == 1 ? one : three);
      if (first) {
        ASSERT_TRUE(picture.same_bits(*first)) << "soup " << n << " tile " << c.tile_size_px;
      } else {
        first = std::move(picture);
      }
    }
    for_samples += first->statistics.set_up_for_samples;
    degenerate += first->statistics.culled_degenerate;
    check_against_oracle(*first, soup, tally);
  }
  EXPECT_EQ(tally.wrong, 0);
  EXPECT_GT(tally.covered, 10'000 * kSoups);
  // Otherwise the test proves nothing about these.
  EXPECT_GT(tally.rule_matters, 5 * kSoups);
  EXPECT_GT(for_samples, static_cast<std::uint64_t>(kSoups / 2));
  EXPECT_GT(degenerate, static_cast<std::uint64_t>(kSoups / 10));
}

// 24-bit coordinates and 48-bit products.
TEST(Samples, TrianglesUpToTheGuardBandEqualTheIntegerOracle) {
  constexpr Viewport kView{64, 64};
  Random random(2);
  SampleTally tally;
  for (int n = 0; n < trials(300); ++n) {
    const std::int64_t limit = 256 * (n % 3 == 0 ? 12288 : n % 3 == 1 ? 3000 : 400);
    Triangle t;
    for (Point& p : t) {
      p = {random.integer(-limit + 16384, limit), random.integer(-limit + 16384, limit)};
    }
    // Through the viewport's middle, or the first corner far off and the others near.
    if (n % 2 == 0) t[1] = {8192 - t[0].x / 64, 8192 - t[0].y / 64};
    FlatSoup soup;
    soup.add(t, 0.25f, kView);
    for (const Configuration& c : all_configurations(std::span(kThreadCounts, 1))) {
      if (c.tile_size_px != 16 << (n % 3)) continue;
      const ScopedSimdTarget target(c.target);
      const SamplePicture picture =
          draw_sample_picture(soup.draw(), kView, kSampleCounts[n % 2], c.tile_size_px);
      EXPECT_EQ(picture.statistics.clipped, 0u);
      check_against_oracle(picture, soup, tally);
    }
  }
  EXPECT_EQ(tally.wrong, 0);
  EXPECT_GT(tally.covered, trials(300) * 1000);
}

// A triangle in each gap of the pattern, a few 1/256 px wide around one sample of one pixel.
TEST(Samples, ATriangleBetweenPixelCentresCoversTheSampleItHolds) {
  constexpr Viewport kView{64, 64};
  for (const int samples : kSampleCounts) {
    for (int s = 0; s < samples; ++s) {
      for (const Point& pixel : {Point{0, 0}, Point{15, 16}, Point{63, 63}, Point{31, 0}}) {
        const int x = static_cast<int>(pixel.x), y = static_cast<int>(pixel.y);
        const Point p = sample_point(x, y, s, samples);
        FlatSoup soup;
        soup.add({{{p.x - 3, p.y - 2}, {p.x + 4, p.y - 1}, {p.x, p.y + 3}}}, 0.5f, kView);
        const SamplePicture picture = draw_sample_picture(soup.draw(), kView, samples, 16);
        EXPECT_EQ(picture.statistics.set_up_for_samples, 1u);
        EXPECT_EQ(picture.primitive_at(x, y, s), 0u) << samples << " samples, number " << s;
        EXPECT_EQ(std::count(picture.primitive.begin(), picture.primitive.end(), 0u), 1);
        EXPECT_EQ(draw_picture(soup.draw(), kView, 16).statistics.culled_between_pixels, 1u);
      }
    }
  }
  // On the border of four pixels no sample is near.
  FlatSoup soup;
  soup.add({{{2560 - 3, 2560 - 2}, {2560 + 4, 2560 - 1}, {2560, 2560 + 3}}}, 0.5f, kView);
  for (const int samples : kSampleCounts) {
    EXPECT_EQ(draw_sample_picture(soup.draw(), kView, samples).statistics.culled_between_pixels,
              1u);
  }
}

// Slight triangles with an edge through one sample: top and left edges own it, the others do not.
TEST(Samples, OnATopOrLeftEdgeBelongToTheTriangle) {
  constexpr Viewport kView{64, 64};
  for (const int samples : kSampleCounts) {
    for (int s = 0; s < samples; ++s) {
      const Point p = sample_point(32, 17, s, samples);
      const Point left{p.x - 3, p.y}, right{p.x + 4, p.y}, up{p.x, p.y - 3}, down{p.x, p.y + 5};
      const auto owned = [&](const Triangle& t) {
        FlatSoup soup;
        soup.add(t, 0.5f, kView);
        return draw_sample_picture(soup.draw(), kView, samples, 32).primitive_at(32, 17, s) == 0;
      };
      EXPECT_TRUE(owned({left, right, down})) << samples << " samples, number " << s;
      EXPECT_TRUE(owned({up, down, right})) << samples << " samples, number " << s;
      EXPECT_FALSE(owned({left, right, up})) << samples << " samples, number " << s;
      EXPECT_FALSE(owned({up, down, left})) << samples << " samples, number " << s;
    }
  }
}

// As RAS-10 of the centres: by barycentric weights in long double.
TEST(Samples, DepthLiesOnTheVerticesPlaneAtTheSamplesOwnPosition) {
  constexpr Viewport kView{64, 64};
  Random random(3);
  int checked = 0;
  for (int n = 0; n < 200; ++n) {
    const int samples = kSampleCounts[n % 2];
    Triangle t;
    std::vector<glm::vec4> p_clip;
    long double z[3];
    for (int i = 0; i < 3; ++i) {
      t[i] = {random.integer(0, 16384), random.integer(0, 16384)};
      z[i] = static_cast<long double>(static_cast<float>(std::exp2(random.between(-8.0, 0.0))));
      p_clip.push_back(clip_from_fx8(t[i], static_cast<double>(z[i]), 1.0, kView));
    }
    const auto edge = [&](const Point& a, const Point& b, const Point& c) {
      return static_cast<long double>((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    };
    const long double area = edge(t[0], t[1], t[2]);
    if (std::abs(area) < 400 * 65536.0L) continue;  // slivers have gradients without bound
    constexpr std::uint32_t kIndices[] = {0, 1, 2};
    const SamplePicture picture =
        draw_sample_picture({.p_clip = p_clip, .indices = kIndices}, kView, samples);
    const double tolerance = 4 * ulp(static_cast<float>(std::max({z[0], z[1], z[2]})));
    for (std::size_t i = 0; i < picture.depth.size(); ++i) {
      if (picture.primitive[i] == kNoPrimitive) continue;
      const int pixel = static_cast<int>(i) / samples;
      const Point p = sample_point(pixel % 64, pixel / 64, static_cast<int>(i) % samples, samples);
      const long double plane =
          (edge(t[1], t[2], p) * z[0] + edge(t[2], t[0], p) * z[1] + edge(t[0], t[1], p) * z[2]) /
          area;
      ASSERT_NEAR(double{picture.depth[i]}, static_cast<double>(plane), tolerance);
      ++checked;
    }
  }
  EXPECT_GT(checked, 100'000);
}

// What a random mask gets is what the full mask gave at the same pixels, in the mask's order.
TEST(Samples, EachMarkedPixelGetsItsSamplesWhateverElseIsMarked) {
  constexpr Viewport kView{100, 70};
  Random random(4);
  Workers one(1);
  for (int n = 0; n < trials(60); ++n) {
    const int samples = kSampleCounts[n % 2], size = 16 << (n / 2 % 3);
    const FlatSoup soup = random_flat_soup(random, 40, {128, 128});
    const Draw draw = soup.draw();
    const SamplePicture whole = draw_sample_picture(draw, kView, samples, 64);
    Pass pass;
    prepare_pass(std::span(&draw, 1), kView, size, pass, one, samples);
    const TileGrid grid = tile_grid(kView, size);
    for (int tile = 0; tile < grid.count(); ++tile) {
      PixelMask mask;
      std::vector<std::uint32_t> expected;
      for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
          if (random.integer(0, 1 << (n % 5)) != 0) continue;
          mask.add(x, y);
          const int wx = tile % grid.tiles_x * size + x, wy = tile / grid.tiles_x * size + y;
          for (int s = 0; s < samples; ++s) {
            const bool in_view = wx < kView.width_px && wy < kView.height_px;
            expected.push_back(in_view ? whole.primitive_at(wx, wy, s) : kNoPrimitive);
          }
        }
      }
      std::vector<float> depth(expected.size());
      std::vector<std::uint32_t> primitive(expected.size());
      const int covered = draw_samples(pass, tile, mask, depth, primitive);
      ASSERT_EQ(primitive, expected) << n;
      ASSERT_EQ(covered, static_cast<int>(expected.size()) -
                             std::count(expected.begin(), expected.end(), kNoPrimitive));
    }
  }
}

}  // namespace
}  // namespace swell::raster
