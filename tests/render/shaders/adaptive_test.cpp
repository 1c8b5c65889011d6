// Adaptive shading: close to the full picture, the same however it is drawn, exact in its labels.
#include <gtest/gtest.h>

#include <string_view>

#include "math/simd_target.h"
#include "render/labelled_frame.h"
#include "render/measures.h"
#include "render/shot.h"

namespace swell::render {
namespace {

using scene::ShadingRate;

constexpr double kAdaptiveTime_s = 5.0;
constexpr glm::ivec2 kOddSize_px(203, 117);

Shot shaded(const World& world, ShadingRate rate, glm::ivec2 size_px,
            const FrameOptions& asked = {}, int threads = 2) {
  FrameOptions options = asked;
  options.shading = rate;
  return Shot(world, view_of(world, kAdaptiveTime_s, size_px.x, size_px.y), kAdaptiveTime_s,
              options, threads);
}

class AdaptiveShadingOf : public testing::TestWithParam<const char*> {
 protected:
  void TearDown() override {
    if (simd_target_available(SimdTarget::kAvx512)) select_simd_target(SimdTarget::kAvx512);
  }
  const World& world_ = shipped_world(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Scenes, AdaptiveShadingOf,
                         testing::Values("open_ocean", "lagoon", "beach", "harbour", "river"),
                         [](const auto& test) { return std::string(test.param); });

void expect_close(const Shot& some, const Shot& full) {
  double squares = 0.0;
  int far = 0, count = 0;
  for (std::size_t i = 0; i < full.target.rgba.size(); ++i)
    for (int shift = 0; shift < 24; shift += 8) {
      const int error = static_cast<int>(full.target.rgba[i] >> shift & 255) -
                        static_cast<int>(some.target.rgba[i] >> shift & 255);
      squares += error * error;
      far += std::abs(error) > 12;
      ++count;
    }
  EXPECT_GE(10.0 * std::log10(255.0 * 255.0 * count / squares), 46.0);
  EXPECT_LE(far, count / 1000);
}

TEST_P(AdaptiveShadingOf, IsCloseToTheFullPicture) {
  expect_close(shaded(world_, ShadingRate::kAdaptive, {640, 360}),
               shaded(world_, ShadingRate::kFull, {640, 360}));
}

// Grass beside sand of its brightness, and grain as fine as pixels.
TEST(AdaptiveShading, IsCloseToTheFullPictureOfLandFromAbove) {
  scene::Scene scene = load_shipped("lagoon");
  scene.camera.eye_m = {0.0, 0.0, 60.0};
  scene.camera.pitch_rad = glm::radians(-89.0);
  const World world = world_of(scene);
  expect_close(shaded(world, ShadingRate::kAdaptive, {640, 360}),
               shaded(world, ShadingRate::kFull, {640, 360}));
}

// A pole two pixels wide at the bottom of a pool, seen through its surface: pale blue tiles have
// more blue than red, and the pole has less.
TEST(AdaptiveShading, LeavesThinThingsUnderWaterWhole) {
  const World& world = shipped_world("pool");
  const Shot full = shaded(world, ShadingRate::kFull, {640, 360});
  const Shot some = shaded(world, ShadingRate::kAdaptive, {640, 360});
  const auto is_yellow = [](const Shot& shot, int x, int y) {
    const std::uint32_t rgba = shot.target.rgba[shot.at(x, y)];
    return (rgba & 255) > (rgba >> 16 & 255);
  };
  int yellow = 0;
  for (int y = 165; y < 192; ++y)
    for (int x = 250; x < 270; ++x) {
      if (!full.shows(SurfaceKind::kWater, x, y) || !is_yellow(full, x, y)) continue;
      EXPECT_TRUE(is_yellow(some, x, y)) << x << ' ' << y;
      ++yellow;
    }
  EXPECT_GT(yellow, 20);
}

TEST_P(AdaptiveShadingOf, CountsWhatItFillsIn) {
  const FrameStatistics some = shaded(world_, ShadingRate::kAdaptive, {640, 360}).statistics;
  EXPECT_EQ(some.shaded_pixels + some.interpolated_pixels, some.visible_pixels);
  EXPECT_GT(some.interpolated_pixels, some.visible_pixels / 20);
  EXPECT_GT(some.shaded_pixels, some.visible_pixels * 5 / 16);
}

// Blocks of 16 pixels are those of the picture, whatever the tiles.
TEST_P(AdaptiveShadingOf, IsTheSameBitsForAnyThreadsTilesSimdTargetAndLabels) {
  select_simd_target(simd_targets().front());
  const Shot reference = shaded(world_, ShadingRate::kAdaptive, kOddSize_px);
  for (const int tile : {16, 32, 64})
    for (const bool has_labels : {false, true}) {
      FrameOptions options{.tile_size_px = tile};
      if (has_labels) options.labels = LabelSet::all();
      const Shot other =
          shaded(world_, ShadingRate::kAdaptive, kOddSize_px, options, 1 + tile / 16);
      EXPECT_EQ(difference(other.target, reference.target), "") << tile << has_labels;
      EXPECT_EQ(other.statistics.shaded_pixels, reference.statistics.shaded_pixels);
    }
  if (!simd_target_available(SimdTarget::kAvx512)) return;
  select_simd_target(SimdTarget::kAvx512);
  EXPECT_EQ(
      difference(shaded(world_, ShadingRate::kAdaptive, kOddSize_px).target, reference.target), "");
}

// Of a block's columns in even and odd rows: how far away the neighbours are that a column may lie
// between, 0 where it is always shaded.
constexpr std::string_view kToLeft[2] = {"0121012101210120", "0101210121012100"};
constexpr std::string_view kToRight[2] = {"0121012101210110", "0101210121012100"};

TEST_P(AdaptiveShadingOf, FillsInBetweenPixelsOfTheSameSurface) {
  const Shot full = shaded(world_, ShadingRate::kFull, kOddSize_px);
  const Shot some = shaded(world_, ShadingRate::kAdaptive, kOddSize_px);
  const auto kind_at = [&](int x, int y) {
    for (const SurfaceKind kind : kAllSurfaces)
      if (full.shows(kind, x, y)) return static_cast<int>(kind);
    return -1;
  };
  int filled = 0;
  for (int y = 0; y < kOddSize_px.y; ++y)
    for (int x = 0; x < kOddSize_px.x; ++x) {
      if (full.target.rgba[full.at(x, y)] == some.target.rgba[some.at(x, y)]) continue;
      const int left = kToLeft[y % 2][x % 16] - '0', right = kToRight[y % 2][x % 16] - '0';
      const int kind = kind_at(x, y);
      ASSERT_GT(left, 0) << x << ' ' << y;
      ASSERT_LT(x + right, kOddSize_px.x);
      ASSERT_NE(kind, -1);
      ASSERT_NE(kind, static_cast<int>(SurfaceKind::kObjects));
      ASSERT_NE(kind, static_cast<int>(SurfaceKind::kTrees));
      ASSERT_EQ(kind_at(x - left, y), kind) << x << ' ' << y;
      ASSERT_EQ(kind_at(x + right, y), kind) << x << ' ' << y;
      ++filled;
    }
  EXPECT_GT(filled, 100);
}

TEST_P(AdaptiveShadingOf, ChangesNoLabel) {
  const View view = view_of(world_, kAdaptiveTime_s, 160, 90);
  const LabelledFrame full(world_, view, kAdaptiveTime_s, {.shading = ShadingRate::kFull});
  const LabelledFrame some(world_, view, kAdaptiveTime_s, {.shading = ShadingRate::kAdaptive});
  EXPECT_EQ(full.labels().depth_m, some.labels().depth_m);
  EXPECT_EQ(full.labels().foam, some.labels().foam);
  EXPECT_EQ(full.labels().normal, some.labels().normal);
  EXPECT_NE(difference(full.target, some.target), "");
}

TEST(ShadingRates, ComeFromTheSceneUnlessTheOptionsHaveOne) {
  scene::Scene scene = load_shipped("reef");
  EXPECT_EQ(scene.picture.shading, ShadingRate::kAdaptive);
  scene.picture.shading = ShadingRate::kFull;
  EXPECT_EQ(scene::parse_scene(scene::dump_scene(scene), "test.toml").picture.shading,
            ShadingRate::kFull);
  const World world = world_of(scene);
  const Shot own = small_shot(world, kAdaptiveTime_s);
  EXPECT_EQ(own.statistics.interpolated_pixels, 0u);
  FrameOptions options = few_triangles();
  options.shading = ShadingRate::kAdaptive;
  EXPECT_GT(small_shot(world, kAdaptiveTime_s, options).statistics.interpolated_pixels, 0u);
}

// Pictures that are kept as linear light have every pixel shaded.
TEST(ShadingRates, OfLinearPicturesAreFull) {
  const Shot linear =
      shaded(shipped_world("reef"), ShadingRate::kAdaptive, kOddSize_px, {.keep_linear = true});
  EXPECT_EQ(linear.statistics.interpolated_pixels, 0u);
  const Shot full = shaded(shipped_world("reef"), ShadingRate::kFull, kOddSize_px);
  EXPECT_EQ(difference(linear.target, full.target), "");
}

TEST(ShadingRates, OfSceneFilesAreAdaptiveOrFull) {
  try {
    scene::parse_scene("[picture]\nshading = \"half\"\n", "test.toml");
    ADD_FAILURE();
  } catch (const scene::SceneError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("picture.shading"), std::string::npos) << message;
    EXPECT_NE(message.find("adaptive"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace swell::render
