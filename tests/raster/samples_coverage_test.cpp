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

constexpr int kSampleCounts[] = {4, 8};

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

struct Mesh {
  std::vector<glm::vec4> p_clip;
  std::vector<std::uint32_t> indices;
};

// How many triangles, each drawn alone, cover each sample.
std::vector<int> times_covered(const Mesh& mesh, Viewport viewport, int samples) {
  std::vector<int> times;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Draw draw{.p_clip = mesh.p_clip, .indices = std::span(mesh.indices).subspan(i, 3)};
    const SamplePicture picture = draw_sample_picture(draw, viewport, samples, 16 << (i % 3));
    times.resize(picture.primitive.size());
    for (std::size_t s = 0; s < times.size(); ++s) times[s] += picture.primitive[s] == 0;
  }
  return times;
}

void add_quads(Mesh& mesh, std::uint32_t cells) {
  for (std::uint32_t y = 0; y < cells; ++y) {
    for (std::uint32_t x = 0; x < cells; ++x) {
      const std::uint32_t a = y * (cells + 1) + x, b = a + 1, c = a + cells + 1, d = c + 1;
      for (const std::uint32_t i : {a, b, c, c, b, d}) mesh.indices.push_back(i);
    }
  }
}

// AAX-01 with a surface to each triangle: their masks add up to every sample once.
TEST(MeshSamples, JitteredGridsCoverEachSampleOnce) {
  constexpr Viewport kView{32, 16};
  Random random(3);
  for (const int samples : kSampleCounts) {
    // Cells from smaller than the gaps between samples to wider than a tile.
    for (const std::uint32_t cells : {2u, 9u, 24u}) {
      Mesh mesh;
      const double step_x = 40.0 / cells, step_y = 24.0 / cells;
      const double jitter = std::min(0.3, 3.0 / step_x);
      for (std::uint32_t i = 0; i < (cells + 1) * (cells + 1); ++i) {
        const double x = -4 + step_x * (i % (cells + 1) + random.between(-jitter, jitter));
        const double y = -4 + step_y * (i / (cells + 1) + random.between(-jitter, jitter));
        mesh.p_clip.push_back(clip_from_window(x, y, 0.5, random.between(0.3, 5.0), kView));
      }
      add_quads(mesh, cells);
      const std::vector<int> times = times_covered(mesh, kView, samples);
      EXPECT_EQ(static_cast<std::size_t>(std::count(times.begin(), times.end(), 1)), times.size());
    }
  }
}

// Corners on the samples themselves, all edges along rows, columns and diagonals of the pattern.
TEST(MeshSamples, AFanAroundASampleCoversItOnce) {
  constexpr Viewport kView{32, 32};
  for (const int samples : kSampleCounts) {
    for (int s = 0; s < samples; ++s) {
      const Point centre = sample_point(11, 13, s, samples);
      Mesh mesh;
      mesh.p_clip.push_back(clip_from_fx8(centre, 0.5, 1.0, kView));
      constexpr int kSlices = 16;
      for (int i = 0; i < kSlices; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kSlices;
        mesh.p_clip.push_back(clip_from_fx8({centre.x + 4096 * std::lround(3 * std::cos(angle)),
                                             centre.y + 4096 * std::lround(3 * std::sin(angle))},
                                            0.5, 1.0, kView));
        for (const int v : {0, 1 + i, 1 + (i + 1) % kSlices}) {
          mesh.indices.push_back(static_cast<std::uint32_t>(v));
        }
      }
      const std::vector<int> times = times_covered(mesh, kView, samples);
      EXPECT_EQ(static_cast<std::size_t>(std::count(times.begin(), times.end(), 1)), times.size());
    }
  }
}

// A floor from behind the eye to far away, in several random versions.
TEST(MeshSamples, AFloorCutByTheNearPlaneHasNoHoles) {
  constexpr Viewport kView{64, 32};
  constexpr std::uint32_t kCells = 12;
  Random random(4);
  std::uint64_t clipped = 0;
  for (int n = 0; n < 40; ++n) {
    Mesh mesh;
    for (std::uint32_t i = 0; i < (kCells + 1) * (kCells + 1); ++i) {
      const double right = -60.0 + 10.0 * (i % (kCells + 1) + random.between(-0.3, 0.3));
      const double ahead = -25.0 + 10.0 * (i / (kCells + 1) + random.between(-0.3, 0.3));
      mesh.p_clip.push_back(glm::vec4(right, -1.5, 0.1, ahead));
    }
    add_quads(mesh, kCells);
    const Draw draw{.p_clip = mesh.p_clip, .indices = mesh.indices};
    const SamplePicture picture = draw_sample_picture(draw, kView, kSampleCounts[n % 2], 16);
    clipped += picture.statistics.clipped;
    for (int y = 18; y < kView.height_px; ++y) {
      for (int x = 0; x < kView.width_px; ++x) ASSERT_EQ(picture.coverage(x, y), 1.0);
    }
  }
  EXPECT_GT(clipped, 80u);
}

// AAX-06: a mast 0.3 px wide, as it creeps to the right, keeps its brightness.
TEST(ThinCoverage, ALeaningMastCoversItsArea) {
  constexpr Viewport kView{64, 256};
  for (const int samples : kSampleCounts) {
    for (int step = 0; step < 16; ++step) {
      const double x = 20.0 + step / 16.0;
      Mesh mesh;
      for (const glm::dvec2& p : {glm::dvec2(x, 20.0), glm::dvec2(x + 0.3, 20.0),
                                  glm::dvec2(x + 10.0, 220.0), glm::dvec2(x + 10.3, 220.0)}) {
        mesh.p_clip.push_back(clip_from_window(p.x, p.y, 0.5, 1.0, kView));
      }
      mesh.indices = {0, 1, 2, 2, 1, 3};
      const SamplePicture picture =
          draw_sample_picture({.p_clip = mesh.p_clip, .indices = mesh.indices}, kView, samples);
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
  Mesh mesh;
  for (const glm::dvec2& p : {glm::dvec2(30.1, 20.0), glm::dvec2(30.4, 20.0),
                              glm::dvec2(30.1, 220.0), glm::dvec2(30.4, 220.0)}) {
    mesh.p_clip.push_back(clip_from_window(p.x, p.y, 0.5, 1.0, kView));
  }
  mesh.indices = {0, 1, 2, 2, 1, 3};
  const Draw draw{.p_clip = mesh.p_clip, .indices = mesh.indices};
  EXPECT_EQ(draw_picture(draw, kView).covered, 0);
  const SamplePicture four = draw_sample_picture(draw, kView, 4);
  const SamplePicture eight = draw_sample_picture(draw, kView, 8);
  for (int y = 20; y < 220; ++y) {
    ASSERT_EQ(four.coverage(30, y), 0.5) << y;
    ASSERT_EQ(eight.coverage(30, y), 0.25) << y;
  }
}

}  // namespace
}  // namespace swell::raster
