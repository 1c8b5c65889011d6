// A mast thinner than a pixel, that leans by two pixels, while the camera turns (AAX-06).
#include <gtest/gtest.h>

#include <numeric>

#include "render/edges/edge_frames.h"
#include "render/edges/edge_scenes.h"
#include "trials.h"

namespace swell::render {
namespace {

constexpr glm::ivec2 kMastSize_px(48, 96);
constexpr int kTopRow = 8, kBottomRow = 40;  // rows in which it stands before the sky
constexpr double kRows = kBottomRow - kTopRow, kLean = 2.0 / kRows;
constexpr double kSide_m = 0.05, kDistance_m = 60.0, kStep_px = 0.1;

// How much of a picture's pixels is mast, as the samples have it: by pixel of the rows.
std::vector<double> covered(const EdgeRenderer& r) {
  const std::vector<Centre> centres = r.centres();
  const auto of_pixel = r.fragments();
  std::vector<double> shares;
  for (int i = kTopRow * kMastSize_px.x; i < kBottomRow * kMastSize_px.x; ++i) {
    const auto pixel = static_cast<std::size_t>(i);
    double mast = of_pixel[pixel].empty() && r.kind_of(centres[pixel].primitive) == 3;
    for (const EdgeFragment& f : of_pixel[pixel])
      if (r.kind_of(f.primitive) == 3)
        mast += static_cast<double>(f.samples) / r.state().edges.samples;
    shares.push_back(mast);
  }
  return shares;
}

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// The sums of the rows of such a picture.
std::vector<double> rows_of(const std::vector<double>& pixels) {
  std::vector<double> rows;
  for (auto at = pixels.begin(); at != pixels.end(); at += kMastSize_px.x)
    rows.push_back(std::accumulate(at, at + kMastSize_px.x, 0.0));
  return rows;
}

double variance_of(const std::vector<double>& values) {
  const double mean = sum_of(values) / static_cast<double>(values.size());
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return squares / static_cast<double>(values.size());
}

// A white mast before the sky, and the sky alone.
class Mast : public testing::TestWithParam<double> {
 protected:
  static scene::Scene mast_scene() {
    scene::Scene scene = plain_scene();
    scene.objects = {white_box({0.0, kDistance_m}, {kSide_m, kSide_m, 24.0})};
    return scene;
  }

  View view_of_width(double width_px, double lean) const {
    const double focal_px = width_px * kDistance_m / kSide_m;
    return north_view(1.0, std::atan(lean), 2.0 * std::atan(0.5 * kMastSize_px.y / focal_px),
                      kMastSize_px.x, kMastSize_px.y);
  }

  // Calls visit(renderer, n) after frame n of the camera's turn, for a lean either way.
  template <class Visit>
  void turn_camera(int samples, const Visit& visit) {
    EdgeRenderer renderer(with_);
    for (const double lean : {kLean, -kLean}) {
      for (int n = 0; n < trials(40); ++n) {
        renderer.draw(moved(view_of_width(GetParam(), lean), {kStep_px * n, 0.0}), samples);
        visit(renderer, n);
      }
    }
  }

  World without_ = world_of(plain_scene()), with_ = world_of(mast_scene());

  // The brightness that the mast adds to each pixel of the finished picture, in that of a pixel all
  // mast.
  std::vector<double> brightness(const EdgeRenderer& r) {
    if (sky_.empty()) {
      EdgeRenderer without(without_), near(with_);
      without.draw(view_of_width(GetParam(), kLean), 0);
      sky_ = without.target.rgba;
      near.draw(view_of_width(40.0, 0.0), 0);
      mast_ = display_light(near.target.rgba[20 * kMastSize_px.x + kMastSize_px.x / 2], 1);
    }
    std::vector<double> pixels;
    for (int i = kTopRow * kMastSize_px.x; i < kBottomRow * kMastSize_px.x; ++i) {
      const auto pixel = static_cast<std::size_t>(i);
      const double sky = display_light(sky_[pixel], 1);
      pixels.push_back((display_light(r.target.rgba[pixel], 1) - sky) / (mast_ - sky));
    }
    return pixels;
  }

 private:
  std::vector<std::uint32_t> sky_;
  double mast_ = 0.0;
};
INSTANTIATE_TEST_SUITE_P(Widths, Mast, testing::Values(0.3, 0.45, 0.7), [](const auto& test) {
  return std::to_string(std::lround(100.0 * test.param)) + "HundredthsOfAPixel";
});

TEST_P(Mast, HasTheBrightnessOfItsWidthInEveryFrame) {
  const double expected = kRows * GetParam();
  for (const int samples : {4, 8}) {
    turn_camera(samples, [&](const EdgeRenderer& r, int) {
      EXPECT_NEAR(sum_of(brightness(r)), expected, 0.1 * expected) << samples;
      EXPECT_NEAR(sum_of(covered(r)), expected, 0.1 * expected) << samples;
    });
  }
}

// The columns of samples stand 1/N apart; those of one row reach over the lean of a row.
TEST_P(Mast, IsBrokenInNoRow) {
  for (const int samples : {4, 8}) {
    const double part = 1.0 / samples;
    turn_camera(samples, [&](const EdgeRenderer& r, int) {
      for (const double row : rows_of(covered(r))) {
        ASSERT_GE(row, std::max(part, GetParam() - part - kLean)) << samples;
        ASSERT_LE(row, GetParam() + part + kLean) << samples;
      }
    });
  }
}

// Without samples a row shows the mast in GetParam() of the frames, and nothing in the others.
TEST_P(Mast, FlickersLessThanATenthAsMuchAsWithoutSamples) {
  const auto variance_with = [&](int samples) {
    std::vector<double> rows;
    turn_camera(samples, [&](const EdgeRenderer& r, int) {
      const std::vector<double> found = rows_of(brightness(r));
      rows.insert(rows.end(), found.begin(), found.end());
    });
    return variance_of(rows);
  };
  const double without = variance_with(0), with_4 = variance_with(4), with_8 = variance_with(8);
  EXPECT_NEAR(without, GetParam() * (1.0 - GetParam()), 0.03);
  EXPECT_LT(with_4, 0.1 * without);
  EXPECT_LT(with_8, 0.05 * without);
}

// A step of a tenth of a pixel passes at most one of 4 samples of a pixel, or two of 8.
TEST_P(Mast, CreepsWithoutJumps) {
  const auto largest_step = [&](int samples) {
    double largest = 0.0;
    std::vector<double> before;
    turn_camera(samples, [&](const EdgeRenderer& r, int n) {
      const std::vector<double> pixels = covered(r);
      if (n > 0)
        for (std::size_t i = 0; i < pixels.size(); ++i)
          largest = std::max(largest, std::abs(pixels[i] - before[i]));
      before = pixels;
    });
    return largest;
  };
  EXPECT_EQ(largest_step(0), 1.0);
  EXPECT_LE(largest_step(4), 0.25);
  EXPECT_LE(largest_step(8), 0.25);
}

// Upright in the middle of the picture, where two pixels meet: no centre is in it. Columns of
// samples stand (k + 1/2) / N to either side.
TEST_P(Mast, BetweenTheCentresIsFoundInTilesThatShowNothingElse) {
  for (const int samples : {4, 8}) {
    const double expected = 2.0 / samples * std::round(0.5 * GetParam() * samples);
    for (const int tile_size_px : {16, 64}) {
      EdgeRenderer renderer(with_);
      renderer.options.tile_size_px = tile_size_px;
      renderer.draw(view_of_width(GetParam(), 0.0), samples);
      for (const Centre& centre : renderer.centres())
        ASSERT_NE(renderer.kind_of(centre.primitive), 3);
      for (const double row : rows_of(covered(renderer))) ASSERT_EQ(row, expected);
      for (const double row : rows_of(brightness(renderer)))
        ASSERT_NEAR(row, expected, 0.03) << samples << " samples, tile " << tile_size_px;
    }
  }
}

// A part is shaded as the triangle that most of its samples show. The mast's dark side, which is
// thinner than 1/256 pixel, costs one or two samples: its own, and the other one of a part of two.
TEST_P(Mast, ShowsItsFrontInEveryRow) {
  turn_camera(8, [&](const EdgeRenderer& r, int) {
    const std::vector<double> rows = rows_of(brightness(r)), shares = rows_of(covered(r));
    for (std::size_t y = 0; y < rows.size(); ++y)
      ASSERT_GE(rows[y], shares[y] - 2.0 / 8.0 - 0.03) << "row " << y;
  });
}

}  // namespace
}  // namespace swell::render
