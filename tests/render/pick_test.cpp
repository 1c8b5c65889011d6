// What a pick finds is what the rasterizer has drawn there, and what a query answers.
#include "render/pick.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/drawn_shots.h"

namespace swell::render {
namespace {

constexpr glm::ivec2 kSize_px(160, 90);

// A frame of a shipped scene at 3 s.
struct Drawn {
  explicit Drawn(const scene::Scene& scene)
      : world(scene), view(scene::camera_view(scene.camera, t_s, kSize_px.x, kSize_px.y)) {
    FrameOptions options;
    options.water_triangles = 4000;
    Workers workers(2);
    Target target;
    render_frame(world, view, t_s, options, workspace, target, workers);
  }

  std::optional<Pick> pick_at(glm::vec2 at_px) {
    return pick(world, view, workspace, at_px, scratch);
  }

  const double t_s = 3.0;
  World world;
  View view;
  Workspace workspace;
  PickScratch scratch;
};

struct DrawnPixel {
  bool is_water = false, is_land = false;
  int triangle = 0;
  double depth_m = 0.0;
};

DrawnPixel pixel_at(Drawn& drawn, int x, int y) {
  Workspace::State& ws = drawn.workspace.state();
  const int tile_px = ws.visibility.grid.tile_size_px;
  const int tile = y / tile_px * ws.visibility.grid.tiles_x + x / tile_px;
  if (ws.visibility.covered[static_cast<std::size_t>(tile)] < 0) return {};
  const auto at = static_cast<std::size_t>(y % tile_px * tile_px + x % tile_px);
  const float depth = ws.visibility.depth_of(tile)[at];
  if (depth <= 0.0f) return {};
  const auto id = static_cast<int>(ws.visibility.primitive_of(tile)[at]);
  const int water = static_cast<int>(ws.water.mesh.level.size());
  return {id < water, id >= water, id < water ? id : id - water,
          static_cast<double>(drawn.view.near_m / depth)};
}

class PickEachScene : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, PickEachScene,
                         testing::Values("open_ocean", "beach", "open_ocean_radial",
                                         "open_ocean_plane"),
                         [](const auto& test) { return std::string(test.param); });

void expect_query_answer(const Pick& found, const scene::WaterSurface& surface) {
  const glm::dvec2 p(found.p_world);
  glm::vec2 slope;
  surface.slopes({&p, 1}, {&slope, 1});
  EXPECT_EQ(found.model_height_m, static_cast<double>(surface.height(p)));
  EXPECT_EQ(found.slope, glm::dvec2(slope));
}

// Vertices snap to 1/256 of a pixel when they are drawn: at edges the neighbour may be, and what is
// seen edge-on gets another depth.
TEST_P(PickEachScene, IsTheTriangleThatThePixelShowsAndAsksTheSurfaceThere) {
  Drawn drawn(load_shipped(GetParam()));
  const World::State& world = drawn.world.state();
  const scene::WaterSurface water(*world.sea, drawn.workspace.state().sea, world.scene.area,
                                  world.terrain.get(), world.coast.get());
  int surface = 0, same = 0, as_deep = 0, sky = 0;
  for (int y = 1; y < kSize_px.y; y += 3) {
    for (int x = 1; x < kSize_px.x; x += 3) {
      const DrawnPixel pixel = pixel_at(drawn, x, y);
      const glm::vec2 at_px = glm::vec2(x, y) + 0.5f;
      const auto found = drawn.pick_at(at_px);
      if (!pixel.is_water && !pixel.is_land) {
        sky += !found;
        continue;
      }
      ++surface;
      if (!found || found->is_water != pixel.is_water || found->triangle != pixel.triangle)
        continue;
      ++same;
      const glm::dvec3 rel = found->p_world - drawn.view.eye_world;
      const double depth_m = glm::dot(rel, glm::dvec3(drawn.view.forward));
      as_deep += std::abs(depth_m - pixel.depth_m) < 2e-3 * pixel.depth_m;
      ASSERT_LT(glm::distance(glm::dvec3(drawn.view.ray(at_px.x, at_px.y)), rel / depth_m), 1e-6);
      ASSERT_NEAR(glm::length(rel), found->distance_m, 1e-9 * found->distance_m);
      if (pixel.is_water) expect_query_answer(*found, water);
    }
  }
  EXPECT_GT(surface, 500);
  EXPECT_GT(sky, 50);
  EXPECT_GE(same, 0.98 * surface);
  EXPECT_GE(as_deep, 0.98 * same);
}

TEST(Pick, OfTheSkyIsNothing) {
  scene::Scene scene = load_shipped("open_ocean");
  scene.camera.pitch_rad = 1.2;
  Drawn drawn(scene);
  EXPECT_FALSE(drawn.pick_at({80.0f, 45.0f}));
}

}  // namespace
}  // namespace swell::render
