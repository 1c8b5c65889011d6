// Far vertices that leave waves out stay within the error that was allowed, and leave many out.
#include "render/sea/background.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

#include "ocean/water_surface.h"
#include "render/drawn_looks.h"

namespace swell::render {
namespace {

constexpr glm::ivec2 kSize_px(320, 180);

class EachSea : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, EachSea,
                         testing::Values("open_ocean", "sines", "beach", "open_ocean_radial"),
                         [](const auto& test) { return std::string(test.param); });

// Where a place is seen, in pixels; nothing outside the picture.
std::optional<glm::dvec2> seen_at(const View& view, glm::vec2 offset, float z_m) {
  const float z_rel = z_m - static_cast<float>(view.eye_world.z);
  const glm::vec4 p_clip = view.clip_from_rel * glm::vec4(offset, z_rel, 1.0f);
  if (p_clip.w <= view.near_m || std::abs(p_clip.x) > p_clip.w || std::abs(p_clip.y) > p_clip.w)
    return std::nullopt;
  return glm::dvec2(view.width_px, view.height_px) * 0.5 * glm::dvec2(p_clip) /
         static_cast<double>(p_clip.w);
}

TEST_P(EachSea, BackgroundIsDrawnWithinItsError) {
  for (const double error_px : {0.25, 2.0}) {
    scene::Scene scene = load_shipped(GetParam());
    scene.detail.background_error_px = error_px;
    int seen = 0, left_out = 0;
    double worst_px = 0.0;
    draw_looks(scene, 8, kSize_px, 5000,
               [&](const Look& look, const scene::WaterSurface& surface, const Surface& drawn) {
                 for (std::size_t v = 0; v < drawn.height_m.size(); ++v) {
                   const auto drawn_px = seen_at(look.view, drawn.offset[v], drawn.height_m[v]);
                   if (!drawn_px || !shows_all_waves(drawn, look.view, v)) continue;
                   ++seen;
                   const float height_m = surface.height(place_of(drawn, v));
                   left_out += height_m != drawn.height_m[v];
                   if (const auto true_px = seen_at(look.view, drawn.offset[v], height_m))
                     worst_px = std::max(worst_px, glm::distance(*drawn_px, *true_px));
                 }
               });
    EXPECT_LE(worst_px, error_px + 0.002) << "rounding of float positions";
    ASSERT_GT(seen, 1000);
    if (error_px > 1.0) {
      EXPECT_GT(left_out, 100) << "of " << seen;
    }
  }
}

TEST(Background, KnowsWhatARisingPointDoesOnTheScreen) {
  // Level view north from 10 m up, 500 pixels per unit of slope: 1 m at 1000 m is half a pixel.
  const View view = make_view({0, 0, 10}, 0.0, 0.0, 2.0 * 0.7853981633974483, 0.1f, 1000, 1000);
  ocean::SeaDescription flat;
  flat.spectrum = false;
  const ocean::Sea sea(flat);
  const Background background(view, sea, 1.0f, 0.5f);
  EXPECT_EQ(background.detail_at({0.0f, 1003.0f}), 0);
  EXPECT_EQ(background.detail_at({0.0f, 998.0f}), 1) << "nothing but sines";
  EXPECT_EQ(background.detail_at({0.0f, -5000.0f}), background.most_detail()) << "behind the eye";
}

TEST(Background, LeavesOutShortWavesFirst) {
  const View view = make_view({0, 0, 10}, 0.0, -0.05, 0.9, 0.1f, 1280, 720);
  const ocean::Sea sea({});
  const Background background(view, sea, static_cast<float>(sea.height_bound_m()), 0.5f);
  int last = background.most_detail();
  EXPECT_EQ(last, 3);
  EXPECT_EQ(background.detail_at({0.0f, 5.0f}), 3);
  std::array<int, 4> count{};
  for (float y_m = 5.0f; y_m < 30000.0f; y_m *= 1.1f) {
    const int detail = background.detail_at({0.3f * y_m, y_m});
    EXPECT_LE(detail, last) << "rises with distance";
    ++count[static_cast<std::size_t>(last = detail)];
  }
  for (const int each : count) EXPECT_GT(each, 3);
}

}  // namespace
}  // namespace swell::render
