// Meshes have no sample that none of their triangles covers, or two, clipped or not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "raster/sample_picture.h"
#include "trials.h"

namespace swell::raster {
namespace {

struct SampledMesh {
  std::vector<glm::vec4> p_clip;
  std::vector<std::uint32_t> indices;
};

// How many triangles, each drawn alone, cover each sample.
std::vector<int> times_covered(const SampledMesh& mesh, Viewport viewport, int samples) {
  std::vector<int> times;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Draw draw{.p_clip = mesh.p_clip, .indices = std::span(mesh.indices).subspan(i, 3)};
    const SamplePicture picture = draw_sample_picture(draw, viewport, samples, 16 << (i % 3));
    times.resize(picture.primitive.size());
    for (std::size_t s = 0; s < times.size(); ++s) times[s] += picture.primitive[s] == 0;
  }
  return times;
}

void add_quads(SampledMesh& mesh, std::uint32_t cells) {
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
      SampledMesh mesh;
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
      SampledMesh mesh;
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

// Samples farther than 3/256 px from every edge that are drawn and should not be, or reverse.
int clearly_wrong_samples(const SamplePicture& picture, const std::vector<glm::vec4>& p,
                          Viewport viewport) {
  const ExactLine lines[] = {
      {p[0], p[1], viewport}, {p[1], p[2], viewport}, {p[2], p[0], viewport}};
  int wrong = 0;
  for (std::size_t i = 0; i < picture.primitive.size(); ++i) {
    const int pixel = static_cast<int>(i) / picture.samples;
    const Point at = sample_point(pixel % picture.width_px, pixel / picture.width_px,
                                  static_cast<int>(i) % picture.samples, picture.samples);
    double low = 1e300, high = -1e300, nearest = 1e300;
    for (const ExactLine& line : lines) {
      const double d =
          line.distance(static_cast<double>(at.x) / 256.0, static_cast<double>(at.y) / 256.0);
      low = std::min(low, d), high = std::max(high, d), nearest = std::min(nearest, std::abs(d));
    }
    const bool inside = low > 0.0 || high < 0.0;
    if (nearest > 3.0 / 256.0) wrong += inside != (picture.primitive[i] == 0);
  }
  return wrong;
}

// RAS-07 of samples.
TEST(ClippedSamples, VerticesFarBeyondTheGuardBandLeaveEverySampleRight) {
  constexpr Viewport kView{48, 32};
  constexpr double kFar[] = {1, 10, 30000, 1e5, 1e6, 1e30};
  Random random(5);
  int wrong = 0, covered = 0;
  std::uint64_t clipped = 0;
  for (int n = 0; n < trials(200); ++n) {
    SampledMesh mesh{{}, {0, 1, 2}};
    for (int i = 0; i < 3; ++i) {
      const double far = kFar[random.integer(0, 5)];
      const double w = random.integer(0, 7) == 0 ? 1e-6 : random.between(0.2, 16.0);
      mesh.p_clip.push_back(clip_from_window(24 + far * random.between(-1, 1) * 24,
                                             16 + far * random.between(-1, 1) * 16, 0.5, w, kView));
    }
    const SamplePicture picture = draw_sample_picture(
        {.p_clip = mesh.p_clip, .indices = mesh.indices}, kView, kSampleCounts[n % 2], 16);
    wrong += clearly_wrong_samples(picture, mesh.p_clip, kView);
    covered += static_cast<int>(std::count(picture.primitive.begin(), picture.primitive.end(), 0u));
    clipped += picture.statistics.clipped;
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(covered, trials(200) * 1000);
  EXPECT_GT(clipped, static_cast<std::uint64_t>(trials(200) / 3));
}

// A floor from behind the eye to far away, in several random versions.
TEST(MeshSamples, AFloorCutByTheNearPlaneHasNoHoles) {
  constexpr Viewport kView{64, 32};
  constexpr std::uint32_t kCells = 12;
  Random random(4);
  std::uint64_t clipped = 0;
  for (int n = 0; n < 40; ++n) {
    SampledMesh mesh;
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

}  // namespace
}  // namespace swell::raster
