// Pictures with smooth edges are the same bits however they are made.
#include <gtest/gtest.h>

#include "math/simd_target.h"
#include "render/drawn_looks.h"
#include "render/edges/edge_frames.h"
#include "trials.h"

namespace swell::render {
namespace {

constexpr double kSameBitsTime_s = 2.0;
constexpr glm::ivec2 kSizes_px[] = {{201, 117}, {63, 65}, {130, 31}};

class SmoothEdgesOf : public testing::TestWithParam<const char*> {
 protected:
  void TearDown() override {
    if (simd_target_available(SimdTarget::kAvx512)) select_simd_target(SimdTarget::kAvx512);
  }
};
INSTANTIATE_TEST_SUITE_P(Scenes, SmoothEdgesOf,
                         testing::Values("lagoon", "buoys", "beach", "harbour", "open_ocean"),
                         [](const auto& test) { return std::string(test.param); });

// The picture's colours after and before the tone curve.
using Picture = std::pair<std::vector<std::uint32_t>, std::vector<float>>;

struct Way {
  int threads, tile_size_px;
  SimdTarget simd;
};

Picture draw(const World& world, glm::ivec2 size_px, int samples, const Way& way) {
  select_simd_target(way.simd);
  EdgeRenderer renderer(world, kSameBitsTime_s, way.threads);
  renderer.options.tile_size_px = way.tile_size_px;
  renderer.options.keep_linear = true;
  renderer.draw(view_of(world, kSameBitsTime_s, size_px.x, size_px.y), samples);
  return {renderer.target.rgba, renderer.target.linear};
}

TEST_P(SmoothEdgesOf, AreTheSameBitsForAnyThreadsTilesAndSimdTarget) {
  const World& world = shipped_world(GetParam());
  for (const glm::ivec2& size_px : kSizes_px) {
    for (const int samples : {4, 8}) {
      const Picture reference = draw(world, size_px, samples, {1, 64, simd_targets().front()});
      EXPECT_FALSE(reference == draw(world, size_px, 0, {1, 64, simd_targets().front()}));
      for (const SimdTarget simd : simd_targets()) {
        if (!simd_target_available(simd)) continue;
        for (const Way& way : {Way{2, 16, simd}, {3, 32, simd}, {2, 64, simd}}) {
          EXPECT_TRUE(draw(world, size_px, samples, way) == reference)
              << size_px.x << 'x' << size_px.y << ' ' << samples << " samples, " << way.threads
              << " threads, tile " << way.tile_size_px << ' ' << simd_target_name(simd);
        }
      }
    }
  }
}

TEST_P(SmoothEdgesOf, AreTheSameBitsFromAnywhere) {
  const World& world = shipped_world(GetParam());
  for (int n = 0; n < std::max(1, trials(20)); ++n) {
    const Look look = random_look(n, 90 + 7 * n, 60 + 3 * n);
    const auto drawn = [&](const Way& way) {
      select_simd_target(way.simd);
      EdgeRenderer renderer(world, look.t_s, way.threads);
      renderer.options.tile_size_px = way.tile_size_px;
      renderer.draw(look.view, n % 2 == 0 ? 8 : 4);
      return renderer.target.rgba;
    };
    const auto reference = drawn({2, 64, simd_targets().front()});
    EXPECT_TRUE(drawn({1, 16, simd_targets().front()}) == reference) << "look " << n;
    if (simd_target_available(SimdTarget::kAvx512)) {
      EXPECT_TRUE(drawn({3, 32, simd_targets().back()}) == reference) << "look " << n;
    }
  }
}

// From below, from within and from far above the water, through a telescope and a fish-eye.
TEST(SmoothEdges, OfExtremeCamerasAreTheSameBitsAndFinite) {
  const World& world = shipped_world("lagoon");
  for (const double z_m : {-3.0, 0.0, 40000.0}) {
    for (const double fov_rad : {0.01, 3.1}) {
      const View view = make_view({0.0, 0.0, z_m}, 0.0, -0.3, fov_rad, 0.25f, 90, 48);
      std::vector<std::uint32_t> reference;
      for (const int tile : {64, 16}) {
        EdgeRenderer renderer(world, 1e9);
        renderer.options.tile_size_px = tile;
        renderer.options.keep_linear = true;
        renderer.draw(view, 8);
        EXPECT_EQ(renderer.statistics.shaded_pixels, renderer.statistics.visible_pixels);
        EXPECT_TRUE(std::ranges::all_of(renderer.target.linear,
                                        [](float x) { return std::isfinite(x) && x >= 0.0f; }));
        if (tile == 64) reference = renderer.target.rgba;
        EXPECT_TRUE(renderer.target.rgba == reference) << z_m << ' ' << fov_rad;
      }
    }
  }
}

// The smaller picture has the samples.
TEST(SmoothEdges, OfASmallerPictureAreEnlarged) {
  const World& world = shipped_world("buoys");
  const auto drawn = [&](int samples, int threads) {
    EdgeRenderer renderer(world, kSameBitsTime_s, threads);
    renderer.options.picture_scale = 0.75;
    renderer.draw(view_of(world, kSameBitsTime_s, 201, 117), samples);
    return renderer.target.rgba;
  };
  const auto reference = drawn(4, 1);
  EXPECT_EQ(reference.size(), std::size_t{201} * 117);
  EXPECT_TRUE(drawn(4, 3) == reference);
  EXPECT_FALSE(drawn(0, 1) == reference);
}

// Storage that has held other scenes, sizes and numbers of samples.
TEST_P(SmoothEdgesOf, OtherFramesLeaveNoTrace) {
  const World& world = shipped_world(GetParam());
  const auto frame = [](Shot& film, const World& shown, glm::ivec2 size_px, int samples, int tile) {
    const FrameOptions options{.tile_size_px = tile,
                               .water_triangles = 4000,
                               .terrain_triangles = 4000,
                               .edge_samples = samples};
    return film
        .draw(shown, view_of(shown, kSameBitsTime_s, size_px.x, size_px.y), kSameBitsTime_s,
              options)
        .rgba;
  };
  Shot film;
  constexpr glm::ivec2 kSize_px(201, 117);
  const auto next = [&](int samples) { return frame(film, world, kSize_px, samples, 64); };
  const auto alone = [&](int samples) {
    Shot fresh;
    return frame(fresh, world, kSize_px, samples, 64);
  };
  const auto expected_0 = alone(0), expected_4 = alone(4), expected_8 = alone(8);
  EXPECT_FALSE(expected_4 == expected_0);
  EXPECT_FALSE(expected_4 == expected_8);
  EXPECT_TRUE(next(0) == expected_0);
  EXPECT_TRUE(next(4) == expected_4);
  EXPECT_TRUE(next(0) == expected_0);
  frame(film, shipped_world("buoys"), {95, 130}, 8, 16);
  frame(film, shipped_world("lagoon"), {333, 77}, 4, 32);
  EXPECT_TRUE(next(8) == expected_8);
  EXPECT_TRUE(next(4) == expected_4);
  EXPECT_TRUE(next(0) == expected_0);
}

}  // namespace
}  // namespace swell::render
