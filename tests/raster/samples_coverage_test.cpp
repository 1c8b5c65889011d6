// How much of a pixel do its samples say is covered? Edges against exact area; meshes without
// seams.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "raster/sample_picture.h"

namespace swell::raster {
namespace {

// Area of the pixel's part where a (x - x0) + b (y - y0) >= 0, by cutting its square.
double half_plane_area(const Point& on_line, double a, double b, int x, int y) {
  const glm::dvec2 square[] = {{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}};
  std::vector<glm::dvec2> kept;
  const auto side = [&](const glm::dvec2& p) {
    return a * (p.x - static_cast<double>(on_line.x) / 256.0) +
           b * (p.y - static_cast<double>(on_line.y) / 256.0);
  };
  for (int i = 0; i < 4; ++i) {
    const glm::dvec2 p = square[i], q = square[(i + 1) % 4];
    const double dp = side(p), dq = side(q);
    if (dp >= 0.0) kept.push_back(p);
    if ((dp < 0.0) != (dq < 0.0)) kept.push_back(p + (q - p) * (dp / (dp - dq)));
  }
  double doubled = 0.0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const glm::dvec2 p = kept[i], q = kept[(i + 1) % kept.size()];
    doubled += p.x * q.y - q.x * p.y;
  }
  return 0.5 * doubled;
}

struct EdgeError {
  double sum_of_squares = 0.0, largest = 0.0;
  int pixels = 0;
  std::set<double> levels;

  double rms() const { return std::sqrt(sum_of_squares / pixels); }
};

// Draws the half plane right of a line at `angle` (turning clockwise on the screen) through
// (x_px, y_px) as one triangle far larger than the viewport, and compares the pixels on its edge.
void add_half_plane(double angle, double x_px, double y_px, int samples, EdgeError& error) {
  constexpr Viewport kView{32, 32};
  const auto at = [&](double along, double across) {
    const double x = x_px + along * std::cos(angle) - across * std::sin(angle);
    const double y = y_px + along * std::sin(angle) + across * std::cos(angle);
    return Point{std::llround(256.0 * x), std::llround(256.0 * y)};
  };
  const Triangle t = {at(-200.0, 0.0), at(200.0, 0.0), at(0.0, 300.0)};
  FlatSoup soup;
  soup.add(t, 0.5f, kView);
  const SamplePicture picture = draw_sample_picture(soup.draw(), kView, samples);
  const auto a = static_cast<double>(t[0].y - t[1].y), b = static_cast<double>(t[1].x - t[0].x);
  for (int y = 0; y < kView.height_px; ++y) {
    for (int x = 0; x < kView.width_px; ++x) {
      const double area = half_plane_area(t[0], a, b, x, y);
      const double coverage = picture.coverage(x, y);
      if (area <= 1e-9 || area >= 1.0 - 1e-9) {
        ASSERT_NEAR(coverage, area, 1e-8);
        continue;
      }
      error.sum_of_squares += (coverage - area) * (coverage - area);
      error.largest = std::max(error.largest, std::abs(coverage - area));
      error.levels.insert(coverage);
      ++error.pixels;
    }
  }
}

// AAX-02. The lower bounds show that the measure measures.
void expect_near_table(const EdgeError& error, double rms, double largest) {
  EXPECT_LT(error.rms(), 1.1 * rms);
  EXPECT_GT(error.rms(), 0.8 * rms);
  EXPECT_LT(error.largest, 1.1 * largest);
  EXPECT_GT(error.largest, 0.6 * largest);
}

TEST(EdgeCoverage, HalfPlanesAt360AnglesErrAsLittleAsThePatternAllows) {
  Random random(1);
  EdgeError four, eight;
  for (int degree = 0; degree < 360; ++degree) {
    const double angle = (degree + random.uniform()) * std::numbers::pi / 180.0;
    for (int n = 0; n < 4; ++n) {
      const double x = random.between(10.0, 22.0), y = random.between(10.0, 22.0);
      add_half_plane(angle, x, y, 4, four);
      add_half_plane(angle, x, y, 8, eight);
    }
  }
  expect_near_table(four, 0.0912, 0.31);
  expect_near_table(eight, 0.0567, 0.23);
  EXPECT_GT(eight.pixels, 40'000);
}

TEST(EdgeCoverage, NearlyLevelAndNearlyUprightEdgesClimbInEvenSteps) {
  Random random(2);
  EdgeError four, eight;
  for (int n = 0; n < 400; ++n) {
    const double angle = 0.5 * std::numbers::pi * n + random.between(-0.01, 0.01);
    const double x = random.between(10.0, 22.0), y = random.between(10.0, 22.0);
    add_half_plane(angle, x, y, 4, four);
    add_half_plane(angle, x, y, 8, eight);
  }
  expect_near_table(four, 0.072, 0.125);
  expect_near_table(eight, 0.036, 0.0625);
  EXPECT_EQ(four.levels.size(), 5u);
  EXPECT_EQ(eight.levels.size(), 9u);
}

struct Mast {
  std::vector<glm::vec4> p_clip;
  std::vector<std::uint32_t> indices = {0, 1, 2, 2, 1, 3};

  Draw draw() const { return {.p_clip = p_clip, .indices = indices}; }
};

// 0.3 px wide, 200 px tall, from x_px to the right by lean_px.
Mast make_mast(double x_px, double lean_px, Viewport viewport) {
  Mast mast;
  for (const glm::dvec2& p :
       {glm::dvec2(x_px, 20.0), glm::dvec2(x_px + 0.3, 20.0), glm::dvec2(x_px + lean_px, 220.0),
        glm::dvec2(x_px + lean_px + 0.3, 220.0)}) {
    mast.p_clip.push_back(clip_from_window(p.x, p.y, 0.5, 1.0, viewport));
  }
  return mast;
}

// AAX-06: a mast as it creeps to the right keeps its brightness.
TEST(ThinCoverage, ALeaningMastCoversItsArea) {
  constexpr Viewport kView{64, 256};
  for (const int samples : kSampleCounts) {
    for (int step = 0; step < 16; ++step) {
      const Mast mast = make_mast(20.0 + step / 16.0, 10.0, kView);
      const SamplePicture picture = draw_sample_picture(mast.draw(), kView, samples);
      const auto none =
          std::count(picture.primitive.begin(), picture.primitive.end(), kNoPrimitive);
      const double covered =
          static_cast<double>(picture.primitive.size() - static_cast<std::size_t>(none)) / samples;
      EXPECT_NEAR(covered, 60.0, 6.0) << samples << " samples, step " << step;
    }
  }
}

// From 1.6/16 to 6.4/16 px: no pixel centre, but the columns of two samples of 4 and two of 8.
TEST(ThinCoverage, AnUprightMastBetweenPixelCentresIsSeenBySamplesAlone) {
  constexpr Viewport kView{64, 256};
  const Mast mast = make_mast(30.1, 0.0, kView);
  EXPECT_EQ(draw_picture(mast.draw(), kView).covered, 0);
  const SamplePicture four = draw_sample_picture(mast.draw(), kView, 4);
  const SamplePicture eight = draw_sample_picture(mast.draw(), kView, 8);
  for (int y = 20; y < 220; ++y) {
    ASSERT_EQ(four.coverage(30, y), 0.5) << y;
    ASSERT_EQ(eight.coverage(30, y), 0.25) << y;
  }
}

}  // namespace
}  // namespace swell::raster
