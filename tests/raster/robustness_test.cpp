// Input no one should send: no crash, nothing written elsewhere, and a count of what was left out.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "allocation_count.h"
#include "raster/sample_picture.h"

namespace swell::raster {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kDenormal = 1e-42f;

PassStatistics draw_one(const std::array<glm::vec4, 3>& p, std::span<const float> distance = {}) {
  constexpr std::uint32_t kIndices[] = {0, 1, 2};
  const Picture picture =
      draw_picture({.p_clip = p, .indices = kIndices, .clip_distance = {distance}}, {37, 23});
  EXPECT_EQ(picture.covered, 0);
  EXPECT_EQ(picture.statistics.submitted, 1u);
  return picture.statistics;
}

constexpr glm::vec4 kA(-0.5f, -0.5f, 0.5f, 1.0f), kB(0.5f, -0.5f, 0.5f, 1.0f),
    kC(0.0f, 0.5f, 0.5f, 1.0f);

// RAS-11.
TEST(Degenerate, TrianglesWithoutAreaAreCounted) {
  EXPECT_EQ(draw_one({kA, kA, kA}).culled_degenerate, 1u);
  EXPECT_EQ(draw_one({kA, kB, kA}).culled_degenerate, 1u);
  EXPECT_EQ(draw_one({kA, kB, 0.5f * (kA + kB)}).culled_degenerate, 1u);
}

TEST(Degenerate, ATriangleBetweenPixelCentresIsCounted) {
  constexpr Viewport kView{32, 32};
  const std::array<glm::vec4, 3> p = {clip_from_window(5 + 1 / 256.0, 5, 0.5, 1, kView),
                                      clip_from_window(5, 5, 0.5, 1, kView),
                                      clip_from_window(5, 5 + 1 / 256.0, 0.5, 1, kView)};
  constexpr std::uint32_t kIndices[] = {0, 1, 2};
  const Picture picture = draw_picture({.p_clip = p, .indices = kIndices}, kView);
  EXPECT_EQ(picture.covered, 0);
  EXPECT_EQ(picture.statistics.culled_between_pixels, 1u);
}

TEST(Degenerate, NaNsAndInfinitiesAnywhereDropTheTriangle) {
  for (const float bad : {kNan, -kNan, kInfinity, -kInfinity}) {
    for (int vertex = 0; vertex < 3; ++vertex) {
      for (int component = 0; component < 4; ++component) {
        std::array<glm::vec4, 3> p = {kA, kB, kC};
        p[vertex][component] = bad;
        EXPECT_EQ(draw_one(p).culled_degenerate, 1u);
      }
      std::array<float, 3> distance = {1, 1, 1};
      distance[vertex] = bad;
      EXPECT_EQ(draw_one({kA, kB, kC}, distance).culled_degenerate, 1u);
    }
  }
}

TEST(Degenerate, TrianglesWithoutPositiveWAreOutside) {
  for (const float w : {0.0f, -0.0f, kDenormal, -kDenormal, -1.0f, -1e30f}) {
    std::array<glm::vec4, 3> p = {kA, kB, kC};
    for (glm::vec4& v : p) v.w = w;
    EXPECT_EQ(draw_one(p).culled_outside, 1u) << w;
  }
}

TEST(Degenerate, TrianglesWhollyBeyondOnePlaneAreOutside) {
  for (const glm::vec4& shift :
       {glm::vec4(3, 0, 0, 0), glm::vec4(-3, 0, 0, 0), glm::vec4(0, 3, 0, 0),
        glm::vec4(0, -3, 0, 0), glm::vec4(0, 0, 3, 0), glm::vec4(0, 0, -3, 0)}) {
    EXPECT_EQ(draw_one({kA + shift, kB + shift, kC + shift}).culled_outside, 1u);
  }
  const std::array<float, 3> behind = {-1, -2, -3};
  EXPECT_EQ(draw_one({kA, kB, kC}, behind).culled_outside, 1u);
}

float raw_float(Random& random) {
  switch (random.integer(0, 5)) {
    case 0:
      return std::bit_cast<float>(static_cast<std::uint32_t>(random.bits()));
    case 1: {
      constexpr float kSpecial[] = {kNan,           kInfinity, -kInfinity, 0.0f,
                                    -0.0f,          kDenormal, -kDenormal, 3.4028235e38f,
                                    -3.4028235e38f, 1.0f,      -1.0f,      1e-30f};
      return kSpecial[random.integer(0, 11)];
    }
    case 2:
      return static_cast<float>(std::exp2(random.between(-60, 100)));
    default:
      return static_cast<float>(random.between(-2, 2));
  }
}

struct Soup {
  std::vector<glm::vec4> p_clip;
  std::vector<std::uint32_t> indices;
  std::vector<float> clip_distance;
};

Soup random_soup(Random& random) {
  Soup soup;
  const std::int64_t vertices = random.integer(3, 40), triangles = random.integer(0, 64);
  for (std::int64_t v = 0; v < vertices; ++v) {
    glm::vec4 p;
    for (int i = 0; i < 4; ++i) p[i] = raw_float(random);
    if (random.integer(0, 1) == 0) p.w = std::abs(p.w), p.z = p.w * 0.5f;
    soup.p_clip.push_back(p);
    soup.clip_distance.push_back(raw_float(random));
  }
  for (std::int64_t i = 0; i < 3 * triangles; ++i) {
    soup.indices.push_back(static_cast<std::uint32_t>(random.integer(0, vertices - 1)));
  }
  return soup;
}

// ROB-30, ROB-22: raw bits, widths and heights from 1 to 70, every configuration the same bits.
// draw_picture checks guards, borders, depths and counts.
TEST(Fuzz, RawBitsGiveTheSamePictureOnEveryConfiguration) {
  constexpr int kThreads[] = {1, 4};
  Random random(1);
  Workers one(1), four(4);
  int covered = 0;
  for (int n = 0; n < 700; ++n) {
    const Viewport viewport{1 + n % 70, static_cast<int>(random.integer(1, 70))};
    const Soup soup = random_soup(random);
    Draw draw{.p_clip = soup.p_clip, .indices = soup.indices};
    if (n % 3 == 0) draw.clip_distance[0] = soup.clip_distance;
    draw.cull = static_cast<Cull>(n % 5 % 3);
    const Picture first = draw_picture(std::span(&draw, 1), viewport, 64, one);
    covered += first.covered;
    const PassStatistics& s = first.statistics;
    ASSERT_EQ(s.submitted, soup.indices.size() / 3);
    ASSERT_LE(s.submitted, s.culled_outside + s.culled_facing + s.culled_degenerate +
                               s.culled_between_pixels + s.set_up);
    const int samples = n % 2 == 0 ? 4 : 8;
    const SamplePicture at_samples = draw_sample_picture(draw, viewport, samples);
    for (const Configuration& c : all_configurations(kThreads)) {
      const ScopedSimdTarget target(c.target);
      Workers& workers = c.threads == 1 ? one : four;
      ASSERT_TRUE(draw_picture(std::span(&draw, 1), viewport, c.tile_size_px, workers, n % 2 * 8)
                      .same_bits(first))
          << n;
      // Ten times the work of the pixel centres.
      if (n % 5 != 0) continue;
      ASSERT_TRUE(
          draw_sample_picture(std::span(&draw, 1), viewport, samples, c.tile_size_px, workers)
              .same_bits(at_samples))
          << n;
    }
  }
  EXPECT_GT(covered, 50'000);
}

TEST(Statistics, CountEachTriangleOnce) {
  constexpr Viewport kView{64, 64};
  constexpr glm::vec4 kBehind(0.0f, 3.0f, 0.5f, -1.0f);
  const std::vector<glm::vec4> p = {kA,
                                    kB,
                                    kC,
                                    kA + glm::vec4(4, 0, 0, 0),
                                    kB + glm::vec4(4, 0, 0, 0),
                                    kC + glm::vec4(4, 0, 0, 0),
                                    kBehind};
  const std::vector<std::uint32_t> indices = {0, 1, 2, 0, 2, 1, 3, 4, 5, 0, 0, 1, 0, 1, 6};
  Draw draw{.p_clip = p, .indices = indices};
  draw.cull = Cull::kClockwise;  // a, b, c is counter-clockwise on the screen
  const PassStatistics s = draw_picture(draw, kView, 64).statistics;
  EXPECT_EQ(s.submitted, 5u);
  EXPECT_EQ(s.culled_facing + s.culled_outside + s.culled_degenerate, 3u);
  EXPECT_EQ(s.culled_outside, 1u);
  EXPECT_EQ(s.culled_degenerate, 1u);
  EXPECT_EQ(s.clipped, 1u);
  EXPECT_GE(s.set_up, 2u);
  EXPECT_EQ(s.binned, s.set_up);  // one tile
}

TEST(Bins, ABigTriangleIsListedOnlyInTilesItTouches) {
  constexpr Viewport kView{256, 256};
  const std::array<glm::vec4, 3> p = {glm::vec4(-1, 1, 0.5, 1), glm::vec4(1, 1, 0.5, 1),
                                      glm::vec4(-1, -1, 0.5, 1)};
  constexpr std::uint32_t kIndices[] = {0, 1, 2};
  const Draw draw{.p_clip = p, .indices = kIndices};
  Pass pass;
  Workers workers(1);
  prepare_pass(std::span(&draw, 1), kView, 16, pass, workers);
  for (int tile = 0; tile < 256; ++tile) {
    EXPECT_EQ(tile_has_triangles(pass, tile), tile % 16 + tile / 16 <= 15) << tile;
  }
  EXPECT_EQ(pass_statistics(pass).binned, 136u);
}

TEST(Bins, AnEmptyPassHasNoTriangles) {
  Pass pass;
  Workers workers(1);
  prepare_pass({}, {33, 17}, 16, pass, workers);
  for (int tile = 0; tile < 6; ++tile) EXPECT_FALSE(tile_has_triangles(pass, tile));
  std::vector<float> depth(256, 5.0f);
  std::vector<std::uint32_t> primitive(256, 5);
  EXPECT_EQ(draw_tile(pass, 5, depth, primitive), 0);
  EXPECT_EQ(depth, std::vector<float>(256, 0.0f));
  EXPECT_EQ(primitive, std::vector<std::uint32_t>(256, kNoPrimitive));
}

TEST(Storage, ARepeatedPassAllocatesNothing) {
  Random random(3);
  const Soup soup = random_soup(random);
  const Draw draw{.p_clip = soup.p_clip, .indices = soup.indices};
  Pass pass;
  Workers workers(1);
  std::vector<float> depth(256);
  std::vector<std::uint32_t> primitive(256);
  PixelMask mask;
  std::vector<float> sample_depth(256 * 8);
  std::vector<std::uint32_t> sample_primitive(256 * 8);
  std::uint64_t before = 0;
  for (int frame = 0; frame < 10; ++frame) {
    if (frame == 2) before = allocation_count();
    prepare_pass(std::span(&draw, 1), {100, 100}, 16, pass, workers, 8);
    for (int tile = 0; tile < 49; ++tile) {
      draw_tile(pass, tile, depth, primitive);
      mark_touched(pass, tile, 0, kNoPrimitive, mask);
      draw_samples(pass, tile, full_mask(16), sample_depth, sample_primitive);
    }
  }
  EXPECT_EQ(allocation_count(), before);
}

using RobustnessDeathTest = testing::Test;

TEST(RobustnessDeathTest, CallersMistakesStopWithTheirValues) {
  const std::array<glm::vec4, 3> p = {kA, kB, kC};
  constexpr std::uint32_t kIndices[] = {0, 1, 3};
  const Draw draw{.p_clip = p, .indices = kIndices};
  Pass pass;
  Workers workers(1);
  EXPECT_DEATH(prepare_pass(std::span(&draw, 1), {8, 8}, 16, pass, workers), "index=3");
  EXPECT_DEATH(prepare_pass({}, {8, 8}, 24, pass, workers), "tile_size_px=24");
  EXPECT_DEATH(prepare_pass({}, {0, 8}, 16, pass, workers), "viewport=0x8");
  EXPECT_DEATH(prepare_pass({}, {8, 8193}, 16, pass, workers), "viewport=8x8193");
}

}  // namespace
}  // namespace swell::raster
