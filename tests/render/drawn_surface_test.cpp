// The surface that is drawn and the surface that scene::Water answers are one: the same bits at
// every vertex.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/drawn_shots.h"

namespace swell::render {
namespace {

constexpr int kFrames = 12, kTriangles = 5000;
constexpr glm::ivec2 kSize_px(96, 54);

class DrawnSurface : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, DrawnSurface,
                         testing::Values("open_ocean", "lagoon", "sines", "beach",
                                         "open_ocean_radial"),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(DrawnSurface, HasTheHeightOfAQueryAtEveryVertex) {
  int moved = 0;
  draw_shots(load_shipped(GetParam()), kFrames, kSize_px, kTriangles,
             [&](const Shot&, const scene::WaterSurface& surface, const Surface& drawn) {
               ASSERT_GT(drawn.height_m.size(), 1000u);
               for (std::size_t v = 0; v < drawn.height_m.size(); ++v) {
                 ASSERT_EQ(drawn.height_m[v], surface.height(place_of(drawn, v))) << "vertex " << v;
                 moved += drawn.height_m[v] != 0.0f;
               }
             });
  EXPECT_GT(moved, 1000);
}

// The plane leaves all waves to the shading.
TEST(DrawnPlane, IsTwoFlatTriangles) {
  draw_shots(load_shipped("open_ocean_plane"), kFrames, kSize_px, kTriangles,
             [&](const Shot&, const scene::WaterSurface&, const Surface& drawn) {
               ASSERT_EQ(drawn.mesh.level.size(), 2u);
               for (const float height_m : drawn.height_m) ASSERT_EQ(height_m, 0.0f);
             });
}

// Inside a triangle the picture is flat: it cuts off at most what the slope does over its edges.
TEST_P(DrawnSurface, StaysBetweenItsVerticesWithinTheWavesSlope) {
  constexpr double kSteepest = 1.0;  // of these scenes' waves and fading
  double near_square = 0.0;
  int near = 0;
  draw_shots(load_shipped(GetParam()), kFrames, kSize_px, kTriangles,
             [&](const Shot&, const scene::WaterSurface& surface, const Surface& drawn) {
               for (std::size_t i = 0; i + 2 < drawn.mesh.indices.size(); i += 3) {
                 const std::uint32_t* v = &drawn.mesh.indices[i];
                 const glm::dvec2 a = place_of(drawn, v[0]), b = place_of(drawn, v[1]);
                 const glm::dvec2 c = place_of(drawn, v[2]), middle = (a + b + c) / 3.0;
                 const double flat = (static_cast<double>(drawn.height_m[v[0]]) +
                                      drawn.height_m[v[1]] + drawn.height_m[v[2]]) /
                                     3.0;
                 const double edge_m =
                     std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
                 const double cut_off_m = std::abs(flat - surface.height(middle));
                 ASSERT_LE(cut_off_m, kSteepest * edge_m);
                 if (edge_m > 1.0) continue;
                 near_square += cut_off_m * cut_off_m;
                 ++near;
               }
             });
  ASSERT_GT(near, 200);
  EXPECT_LT(std::sqrt(near_square / near), 0.02) << "rms over triangles with edges up to 1 m";
}

}  // namespace
}  // namespace swell::render
