// What a pick finds is what the rasterizer has drawn there, and what a query answers.
#include "render/measure/pick.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "ocean/water_surface.h"
#include "render/shot.h"
#include "render/world/world_state.h"
#include "scene/water.h"

namespace swell::render {
namespace {

constexpr glm::ivec2 kPickSize_px(160, 90);

// A frame of a scene at 3 s.
struct Drawn : Shot {
  explicit Drawn(const scene::Scene& scene, glm::ivec2 size_px = kPickSize_px)
      : Drawn(scene, scene.camera, size_px) {}
  Drawn(const scene::Scene& scene, const scene::Camera& camera, glm::ivec2 size_px = kPickSize_px)
      : world(world_of(scene)) {
    draw(world, scene::camera_view(camera, 3.0, size_px.x, size_px.y), 3.0,
         {.water_triangles = 4000});
  }

  std::optional<Pick> pick_at(glm::vec2 at_px) {
    return pick(world, view, workspace, at_px, scratch);
  }

  World world;
  PickScratch scratch;
};

struct DrawnPixel {
  Shown what = Shown::kWater;
  int triangle = 0;
  double depth_m = 0.0;
  std::size_t object = 0;
};

// The object that stands where the primitive's does.
std::size_t object_of(const Drawn& drawn, const ObjectPrimitive& primitive) {
  const std::vector<scene::FloatingObject>& objects = drawn.world.scene().objects;
  const glm::dvec3 bottom = drawn.view.eye_world + glm::dvec3(primitive.object->bottom_rel);
  const auto distance_m = [&](const scene::FloatingObject& object) {
    return glm::distance(object.position_m, glm::dvec2(bottom));
  };
  return static_cast<std::size_t>(std::ranges::min_element(objects, {}, distance_m) -
                                  objects.begin());
}

// Nothing where the sky is.
std::optional<DrawnPixel> pixel_at(const Drawn& drawn, int x, int y) {
  const FrameState& ws = drawn.state();
  const int tile_px = ws.visibility.grid.tile_size_px;
  const int tile = y / tile_px * ws.visibility.grid.tiles_x + x / tile_px;
  if (ws.visibility.covered[static_cast<std::size_t>(tile)] < 0) return std::nullopt;
  const auto at = static_cast<std::size_t>(y % tile_px * tile_px + x % tile_px);
  const float depth = ws.visibility.depth_of(tile)[at];
  if (depth <= 0.0f) return std::nullopt;
  const double depth_m = static_cast<double>(drawn.view.near_m / depth);
  const std::uint32_t id = drawn.primitive(x, y);
  const auto number_in = [&](SurfaceKind kind) {
    return static_cast<int>(id - ws.window.primitives.begin(kind));
  };
  if (drawn.shows(SurfaceKind::kWater, x, y))
    return DrawnPixel{Shown::kWater, number_in(SurfaceKind::kWater), depth_m};
  if (drawn.shows(SurfaceKind::kTerrain, x, y))
    return DrawnPixel{Shown::kLand, number_in(SurfaceKind::kTerrain), depth_m};
  const ObjectGeometry& drawn_objects = ws.meshes.objects;
  const ObjectPrimitive& primitive =
      drawn_objects.in_window()
          .primitives[static_cast<std::size_t>(number_in(SurfaceKind::kObjects))];
  const std::size_t object = object_of(drawn, primitive);
  const shapes::ObjectTriangle* first = drawn_objects.meshes[object]->triangles.data();
  return DrawnPixel{Shown::kObject, static_cast<int>(primitive.triangle - first), depth_m, object};
}

class PickEachScene : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, PickEachScene,
                         testing::Values("open_ocean", "beach", "open_ocean_radial",
                                         "open_ocean_plane", "buoys", "buoys_plane"),
                         [](const auto& test) { return std::string(test.param); });

void expect_query_answer(const Pick& found, const scene::WaterSurface& surface) {
  const glm::dvec2 p(found.p_world);
  glm::vec2 slope;
  surface.slopes({&p, 1}, {&slope, 1});
  EXPECT_EQ(found.model_height_m, static_cast<double>(surface.height(p)));
  EXPECT_EQ(found.slope, glm::dvec2(slope));
}

// How often a pick found what the pixel there shows.
struct Agreement {
  int pixels = 0, same = 0, as_deep = 0;
};

// Vertices snap to 1/256 of a pixel when they are drawn: at edges the neighbour may be, and what is
// seen edge-on gets another depth.
void compare(Drawn& drawn, glm::ivec2 at, const DrawnPixel& pixel, Agreement& agreement) {
  const glm::vec2 at_px = glm::vec2(at) + 0.5f;
  const auto found = drawn.pick_at(at_px);
  ++agreement.pixels;
  if (!found || found->what != pixel.what || found->triangle != pixel.triangle ||
      found->object != pixel.object)
    return;
  ++agreement.same;
  const glm::dvec3 rel = found->p_world - drawn.view.eye_world;
  glm::dvec3 sunk = rel;  // as the picture has it
  const double drop_per_m2 = drawn.state().window.drop_per_m2;
  sunk.z -= glm::dot(glm::dvec2(rel), glm::dvec2(rel)) * drop_per_m2;
  const double depth_m = glm::dot(sunk, glm::dvec3(drawn.view.forward));
  agreement.as_deep += std::abs(depth_m - pixel.depth_m) < 2e-3 * pixel.depth_m;
  ASSERT_LT(glm::distance(glm::dvec3(drawn.view.ray(at_px.x, at_px.y)), sunk / depth_m), 1e-6);
  ASSERT_NEAR(glm::length(rel), found->distance_m, 1e-9 * found->distance_m);
  if (pixel.what == Shown::kObject) {
    ASSERT_EQ(found->object_kind, drawn.world.scene().objects[pixel.object].kind);
  }
  if (pixel.what != Shown::kLand)
    expect_query_answer(*found, {drawn.world.state().water(), drawn.state().sea->frame});
}

TEST_P(PickEachScene, IsTheTriangleThatThePixelShowsAndAsksTheSurfaceThere) {
  Drawn drawn(load_shipped(GetParam()));
  Agreement agreement;
  int sky = 0;
  for (int y = 1; y < kPickSize_px.y; y += 3) {
    for (int x = 1; x < kPickSize_px.x; x += 3) {
      if (const auto pixel = pixel_at(drawn, x, y))
        compare(drawn, {x, y}, *pixel, agreement);
      else
        sky += !drawn.pick_at(glm::vec2(x, y) + 0.5f);
    }
  }
  EXPECT_GT(agreement.pixels, 500);
  EXPECT_GT(sky, 50);
  EXPECT_GE(agreement.same, 0.98 * agreement.pixels);
  EXPECT_GE(agreement.as_deep, 0.98 * agreement.same);
}

// Objects of every distance: near ones of many triangles, far ones of few pixels.
TEST(Pick, IsTheObjectThatThePixelShows) {
  constexpr glm::ivec2 kLarge_px(640, 360);
  Drawn drawn(load_shipped("buoys"), kLarge_px);
  Agreement agreement;
  std::set<std::size_t> seen;
  for (int y = 0; y < kLarge_px.y; ++y) {
    for (int x = y % 2; x < kLarge_px.x; x += 2) {
      const auto pixel = pixel_at(drawn, x, y);
      if (!pixel || pixel->what != Shown::kObject) continue;
      compare(drawn, {x, y}, *pixel, agreement);
      seen.insert(pixel->object);
    }
  }
  EXPECT_GT(agreement.pixels, 900);
  EXPECT_GE(seen.size(), 10);
  EXPECT_GE(agreement.same, 0.96 * agreement.pixels);
  EXPECT_GE(agreement.as_deep, 0.98 * agreement.same);
}

TEST(Pick, BeginsWhereThePictureDoes) {
  const scene::Scene scene = load_shipped("buoys");
  scene::Camera camera = scene.camera;
  camera.near_m = 40.0;  // two of the buoys and most of the water are nearer
  Drawn drawn(scene, camera);
  int same = 0, pixels = 0, empty = 0;
  for (int y = kPickSize_px.y / 2; y < kPickSize_px.y; y += 2) {
    for (int x = 0; x < kPickSize_px.x; x += 2, ++pixels) {
      const auto pixel = pixel_at(drawn, x, y);
      const auto found = drawn.pick_at(glm::vec2(x, y) + 0.5f);
      same += pixel ? found && found->what == pixel->what : !found;
      empty += !pixel;
    }
  }
  EXPECT_GT(empty, pixels / 2);
  EXPECT_GE(same, 0.98 * pixels);
}

TEST(PickDeathTest, RefusesPlacesThatAreNoNumbers) {
  Drawn drawn(load_shipped("open_ocean"));
  EXPECT_DEATH(drawn.pick_at({NAN, 45.0f}), "at_px=\\(nan, 45\\)");
  EXPECT_DEATH(drawn.pick_at({80.0f, INFINITY}), "at_px=\\(80, inf\\)");
}

TEST(Pick, OfTheSkyIsNothing) {
  scene::Scene scene = load_shipped("open_ocean");
  scene.camera.pitch_rad = 1.2;
  Drawn drawn(scene);
  EXPECT_FALSE(drawn.pick_at({80.0f, 45.0f}));
}

}  // namespace
}  // namespace swell::render
