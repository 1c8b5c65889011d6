// The surface that is drawn and the surface that scene::Water answers are one: the same bits at
// every vertex.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ocean/water_surface.h"
#include "render/drawn_looks.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

constexpr int kFrames = 12, kTriangles = 5000;
constexpr glm::ivec2 kSurfaceSize_px(96, 54);

class DrawnSurface : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, DrawnSurface,
                         testing::Values("open_ocean", "lagoon", "sines", "beach",
                                         "open_ocean_radial", "waves_maps"),
                         [](const auto& test) { return std::string(test.param); });

void expect_queried_heights(const scene::Scene& scene) {
  int moved = 0;
  draw_looks(scene, kFrames, kSurfaceSize_px, kTriangles,
             [&](const Look& look, const scene::WaterSurface& surface, const Surface& drawn) {
               ASSERT_GT(drawn.height_m.size(), 1000u);
               for (std::size_t v = 0; v < drawn.height_m.size(); ++v) {
                 const double distance_m =
                     glm::distance(glm::dvec3(place_of(drawn, v), 0.0), look.view.eye_world);
                 if (distance_m > 0.79 * drawn.statistics.reach_m) continue;  // waves fade
                 ASSERT_EQ(drawn.height_m[v], surface.height(place_of(drawn, v))) << "vertex " << v;
                 moved += drawn.height_m[v] != 0.0f;
               }
             });
  EXPECT_GT(moved, 1000);
}

TEST_P(DrawnSurface, HasTheHeightOfAQueryAtEveryVertex) {
  expect_queried_heights(load_shipped(GetParam()));
}

// HFC-01.
TEST(DrawnCrests, HaveTheHeightOfAQueryAtEveryVertex) {
  scene::Scene scene = load_shipped("open_ocean");
  scene.sea.choppiness = 1.0;
  expect_queried_heights(scene);
}

// Four fronts of surf that lift the water, in a bay and round a headland.
TEST(DrawnFronts, HaveTheHeightOfAQueryAtEveryVertex) {
  expect_queried_heights(load_shipped("papers/maps_7"));
}

TEST(DrawnCrests, CanBeLeftOut) {
  scene::Scene scene = load_shipped("open_ocean");
  scene.sea.choppiness = 1.0;
  const World world = world_of(scene);
  Shot film;
  const auto is_sharp = [&](PartSet without) {
    film.draw(world, view_of(world, 0.0, 64, 36), 0.0, {.without = without});
    return !film.state().sea->frame.patches[0].displaced_x_m.empty();
  };
  EXPECT_TRUE(is_sharp({}));
  EXPECT_FALSE(is_sharp({Part::kCrests}));
}

// The plane leaves all waves to the shading.
TEST(DrawnPlane, IsTwoFlatTriangles) {
  draw_looks(load_shipped("open_ocean_plane"), kFrames, kSurfaceSize_px, kTriangles,
             [&](const Look&, const scene::WaterSurface&, const Surface& drawn) {
               ASSERT_EQ(drawn.mesh.level.size(), 2u);
               for (const float height_m : drawn.height_m) ASSERT_EQ(height_m, 0.0f);
             });
}

// Inside a triangle the picture is flat: it cuts off at most what the slope does over its edges.
TEST_P(DrawnSurface, StaysBetweenItsVerticesWithinTheWavesSlope) {
  constexpr double kSteepest = 1.0;  // of these scenes' waves and fading
  double near_square = 0.0;
  int near = 0;
  draw_looks(load_shipped(GetParam()), kFrames, kSurfaceSize_px, kTriangles,
             [&](const Look&, const scene::WaterSurface& surface, const Surface& drawn) {
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

// The longest edge of the drawn triangle that holds a place, and the drawn height there.
struct DrawnPlace {
  double edge_m = 0.0, height_m = NAN;
};
DrawnPlace drawn_at(const Surface& drawn, glm::dvec2 p) {
  for (std::size_t i = 0; i + 2 < drawn.mesh.indices.size(); i += 3) {
    const std::uint32_t* v = &drawn.mesh.indices[i];
    const glm::dvec2 a = place_of(drawn, v[0]), b = place_of(drawn, v[1]),
                     c = place_of(drawn, v[2]);
    const auto cross = [](glm::dvec2 u, glm::dvec2 w) { return u.x * w.y - u.y * w.x; };
    const double area = cross(b - a, c - a);
    const double wb = cross(p - a, c - a) / area, wc = cross(b - a, p - a) / area;
    if (wb < 0.0 || wc < 0.0 || wb + wc > 1.0) continue;
    return {std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)}),
            (1.0 - wb - wc) * drawn.height_m[v[0]] + wb * drawn.height_m[v[1]] +
                wc * drawn.height_m[v[2]]};
  }
  return {};
}

// The mean over the buoys of a scene of the triangle's edge under each and of the distance between
// its waterline and the drawn sea.
struct Afloat {
  double edge_m = 0.0, gap_m = 0.0, largest_gap_m = 0.0;
  int count = 0;
};
World buoys(double nearer) {
  scene::Scene scene = load_shipped("buoys");
  scene.detail.objects = nearer;
  return world_of(scene);
}

Afloat draw_buoys(const World& world, double t_s) {
  const Shot shot(world, view_of(world, t_s, 320, 180), t_s, {.water_triangles = 10000});
  Afloat result;
  for (const scene::ObjectPose& pose : shot.state().meshes.objects.poses) {
    const DrawnPlace place = drawn_at(shot.state().meshes.water, glm::dvec2(pose.position_world));
    const double gap_m = std::abs(place.height_m - pose.position_world.z);
    result.edge_m += place.edge_m;
    result.gap_m += gap_m;
    result.largest_gap_m = std::max(result.largest_gap_m, gap_m);
    ++result.count;
  }
  result.edge_m /= result.count;
  result.gap_m /= result.count;
  return result;
}

// Waves of Hs = 1.9 m, buoys up to 900 m away.
TEST(DrawnObjects, FloatOnTheDrawnSeaWhoseTrianglesAreFinerUnderThem) {
  const World refined = buoys(8.0), plain = buoys(1.0);
  for (const double t_s : {0.0, 4.0, 33.0}) {
    const Afloat with = draw_buoys(refined, t_s), without = draw_buoys(plain, t_s);
    ASSERT_GT(with.count, 10);
    EXPECT_LT(with.edge_m, without.edge_m / 4.0);
    EXPECT_LT(with.gap_m, without.gap_m / 3.0);
    EXPECT_LT(with.gap_m, 0.08);
    EXPECT_LT(with.largest_gap_m, 0.4);
  }
}

}  // namespace
}  // namespace swell::render
