// Rivers and lakes in pictures: they are drawn where queries say, flow without pulsing, and follow
// from the scene and the time alone.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "ocean/water_surface.h"
#include "render/labels/classes.h"
#include "render/labels/label_channels.h"
#include "render/lake_and_river.h"
#include "render/materials/river.h"
#include "render/materials/terrain.h"
#include "render/shot.h"
#include "render/view/meshes.h"
#include "render/world/world_state.h"
#include "scene/scene.h"
#include "scene/water.h"
#include "terrain/height_grid.h"

namespace swell::render {
namespace {

constexpr const char* kCameraAndLight = R"(
[camera]
eye_m = [25, -190, 14]
heading_deg = 335
pitch_deg = -28
fov_y_deg = 50
[sky]
cloud_cover = 0
sun_elevation_deg = 40
sun_azimuth_deg = 120
[wind]
speed_mps = 0
[coast]
model = "none"
)";

scene::Scene river_scene(const std::string& more = "") {
  return scene::parse_scene(std::string(kCameraAndLight) + kLakeAndRiver + "speed_mps = 1\n" + more,
                            "river.toml");
}

const World& river_world() {
  static const World world = world_of(river_scene());
  return world;
}

// What a small frame of a world shows.
struct Frame : Shot {
  explicit Frame(const World& world, double t_s = 2.0, const FrameOptions& options = {},
                 int threads = 1)
      : Shot(world, view_of(world, t_s, 160, 120), t_s, options, threads) {}

  glm::dvec3 point(int x, int y) const {
    const VisibilityBuffer& buffer = state().visibility;
    const int size = buffer.grid.tile_size_px, tile = y / size * buffer.grid.tiles_x + x / size;
    const float depth_m =
        view.near_m / buffer.depth_of(tile)[static_cast<std::size_t>(y % size * size + x % size)];
    const glm::vec3 ray = view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
    return view.eye_world + glm::dvec3(depth_m * ray);
  }

  // Calls visit(x, y) for each pixel that shows a river.
  template <class Visit>
  void for_river(const Visit& visit) const {
    for (int y = 0; y < view.height_px; ++y)
      for (int x = 0; x < view.width_px; ++x)
        if (shows(SurfaceKind::kRivers, x, y)) visit(x, y);
  }
};

TEST(DrawnRivers, LieWhereQueriesSay) {
  const Frame frame(river_world());
  const scene::Water water(river_world().scene());
  ocean::SeaFrame sea;
  Workers workers(1);
  const scene::WaterSurface surface = water.at(2.0, sea, workers);
  // At the water's edge the drawn land is a little off.
  int river = 0, off = 0;
  frame.for_river([&](int x, int y) {
    const glm::dvec3 p = frame.point(x, y);
    off += std::abs(static_cast<double>(surface.height(glm::dvec2(p))) - p.z) > 0.03;
    ++river;
  });
  EXPECT_GT(river, 1500);
  EXPECT_LT(off, river / 200);
}

TEST(DrawnRivers, CanBeLeftOut) {
  const Frame dry(river_world(), 2.0, {.without = {Part::kRivers}});
  EXPECT_TRUE(dry.state().meshes.rivers.indices.empty());
  Frame(river_world()).for_river([&](int x, int y) {
    EXPECT_TRUE(dry.shows(SurfaceKind::kTerrain, x, y) || dry.shows(SurfaceKind::kWater, x, y));
  });
}

TEST(DrawnRivers, AreWaterInLabels) {
  FrameOptions options;
  options.labels.add(Label::kClass);
  const Frame frame(river_world(), 2.0, options);
  frame.for_river([&](int x, int y) {
    const std::uint32_t c = frame.target.labels.klass[frame.at(x, y)];
    EXPECT_TRUE(c == kWaterClass || c == kFoamClass) << c;
  });
}

// The lake fills the picture; its river comes down to the sea.
TEST(DrawnRivers, MirrorInTheSeasLevelAndInOneMore) {
  const Frame frame(river_world());
  const RiverMesh& rivers = frame.state().meshes.rivers;
  ASSERT_EQ(rivers.mirror_count, 1u);
  EXPECT_NEAR(rivers.mirror[0].level_m, 4.0f, 0.5f);
  EXPECT_EQ(rivers.mirror[0].share, 1.0f);
  int low = 0, high = 0;
  for (std::size_t n = 0; n < rivers.looks_into.size(); ++n) {
    const glm::vec3 p = rivers.p_rel[rivers.indices[3 * n]];
    const double level_m = frame.view.eye_world.z + static_cast<double>(p.z);
    if (level_m < 1.4) {
      ++low;
      EXPECT_TRUE(rivers.looks_into[n] & kSeaMirror);
      float sea = 0.0f;  // waves of the sea may lift it
      for (std::size_t k = 3 * n; k < 3 * n + 3; ++k)
        sea = std::max(sea, rivers.sea_share[rivers.indices[k]]);
      if (sea == 0.0f) {
        EXPECT_FALSE(rivers.looks_into[n] & kRiverMirror);
      }
    } else if (level_m > 2.7) {
      ++high;
      EXPECT_EQ(rivers.looks_into[n], kRiverMirror);
    }
  }
  EXPECT_GT(std::min(low, high), 20);

  // What is drawn of both: the lake with its bank, from low above it.
  const Frame bare(river_world(), 2.0, {.without = {Part::kReflection}});
  int changed = 0;
  frame.for_river([&](int x, int y) { changed += frame.codes(x, y) != bare.codes(x, y); });
  EXPECT_GT(changed, 100);
}

// Nearly straight down, north on top.
scene::Scene seen_from_above(glm::dvec3 eye_m, const std::string& more = "") {
  scene::Scene scene = river_scene(more);
  scene.camera.eye_m = eye_m;
  scene.camera.heading_rad = 0.0;
  scene.camera.pitch_rad = radians(-89.0);
  return scene;
}

// As at the sea's floor, into which a mouth passes. From 1.2 m up they are gravel, whatever the
// land is.
TEST(DrawnRivers, BedsAreOfTheLandsSandNearTheSea) {
  scene::Scene scene = seen_from_above({0.0, -80.0, 90.0});
  const World sand = world_of(scene);
  scene.terrain->ground.sand = {0.6f, 0.05f, 0.05f};
  const World red_sand = world_of(scene);
  const FrameOptions options{.keep_linear = true, .without = {Part::kReflection}};
  const Frame a(sand, 2.0, options), b(red_sand, 2.0, options);
  int high = 0, low = 0;
  float green = 0.0f, green_of_red = 0.0f;
  a.for_river([&](int x, int y) {
    const double level_m = a.point(x, y).z;
    if (level_m > 1.25) {
      EXPECT_EQ(a.linear(x, y), b.linear(x, y));
      ++high;
    } else if (level_m < 0.6) {
      green += a.linear(x, y).g;
      green_of_red += b.linear(x, y).g;
      ++low;
    }
  });
  EXPECT_GT(std::min(high, low), 100);
  EXPECT_LT(green_of_red, 0.8f * green);
}

TEST(DrawnRivers, HaveCausticsOnTheirBeds) {
  scene::Scene scene = seen_from_above({-6.0, -100.0, 7.0});
  scene.sea.wind_speed_mps = 5.0;
  const World world = world_of(scene);
  const Frame a(world, 2.0, {.keep_linear = true, .without = {Part::kReflection}}),
      b(world, 2.0, {.keep_linear = true, .without = {Part::kReflection, Part::kCaustics}});
  int river = 0, changed = 0;
  float light = 0.0f, light_without = 0.0f;
  a.for_river([&](int x, int y) {
    const float green = a.linear(x, y).g, green_without = b.linear(x, y).g;
    light += green;
    light_without += green_without;
    changed += std::abs(green - green_without) > 0.02f * green_without;
    ++river;
  });
  EXPECT_GT(river, 5000);
  EXPECT_GT(changed, river / 3);
  // The waves only move the light about.
  EXPECT_NEAR(light / light_without, 1.0f, 0.05f);
  const Frame small_tiles(
      world, 2.0, {.tile_size_px = 32, .keep_linear = true, .without = {Part::kReflection}}, 2);
  EXPECT_EQ(small_tiles.target.linear, a.target.linear);
}

// The foam that a sphere at `position` adds to the river's, south of it, from where the water
// comes, and north.
glm::vec2 foam_at_sphere(glm::dvec2 position, const std::string& more) {
  const World world = world_of(seen_from_above(
      {position, 25.0}, fmt::format("[[object]]\nkind = \"sphere\"\nsize_m = [2, 2, 2]\ndraught = "
                                    "0.5\nposition_m = [{}, {}]\n{}",
                                    position.x, position.y, more)));
  FrameOptions options;
  options.labels.add(Label::kFoam);
  const Frame with(world, 0.0, options);
  options.without = {Part::kHulls};
  const Frame without(world, 0.0, options);
  glm::vec2 added(0.0f);
  with.for_river([&](int x, int y) {
    const std::size_t i = with.at(x, y);
    added[with.point(x, y).y > position.y] +=
        with.target.labels.foam[i] - without.target.labels.foam[i];
  });
  return added;
}

TEST(DrawnRivers, AreWhiteInTheLeeOfWhatStandsInThem) {
  const glm::vec2 moored = foam_at_sphere({-8.0, -100.0}, "");
  EXPECT_GT(moored.y, 20.0f);
  EXPECT_GT(moored.y, 2.0f * moored.x);
  EXPECT_GT(moored.x, 2.0f);
  // What goes its own way makes a wake, what drifts goes with the water, and still water runs
  // against nothing.
  EXPECT_EQ(foam_at_sphere({-8.0, -100.0}, "drift = true\n"), glm::vec2(0.0f));
  EXPECT_EQ(foam_at_sphere({-8.0, -100.0}, "wake = false\npath_m = [[-8, -100], [-8, -90]]\n"),
            glm::vec2(0.0f));
  EXPECT_EQ(foam_at_sphere({0.0, -202.0}, ""), glm::vec2(0.0f));
}

// The river's own currents, which pictures' ripples are carried by and queries answer.
TEST(DrawnRivers, PartBeforeARockForPicturesAndQueriesAlike) {
  const scene::Scene with = river_scene(
      "[[object]]\nkind = \"rock\"\nsize_m = [3, 3, 3]\nposition_m = [-8, -100]\n"
      "height_m = 1.4\n");
  const World world = world_of(with);
  const scene::Water water(with), open(river_scene());
  ocean::SeaFrame sea, open_sea;
  Workers workers(1);
  const scene::WaterSurface surface = water.at(2.0, sea, workers);
  const scene::WaterSurface open_surface = open.at(2.0, open_sea, workers);
  // In the rock, beside it, and before it on either side.
  const std::array<glm::dvec2, 5> p = {
      {{-8.0, -100.0}, {-5.4, -100.0}, {-10.6, -100.0}, {-6.8, -101.8}, {-9.2, -101.8}}};
  std::array<glm::vec2, 5> v, free;
  surface.currents(p, v);
  open_surface.currents(p, free);
  EXPECT_LT(glm::length(v[0]), 0.2f * glm::length(free[0]));
  EXPECT_GT(v[1].y, 1.15f * free[1].y);
  EXPECT_GT(v[2].y, 1.15f * free[2].y);
  EXPECT_GT(v[3].x, free[3].x + 0.1f);
  EXPECT_LT(v[4].x, free[4].x - 0.1f);
  for (std::size_t n = 0; n < p.size(); ++n) {
    const auto drawn = world.state().inland->at(p[n]);
    EXPECT_EQ(glm::vec2(drawn->east_mps, drawn->north_mps), v[n]) << n;
  }
}

// RIV-05: the contrast of the carried ripples over their period, where every phase passes.
TEST(DrawnRivers, RipplesDoNotPulse) {
  std::vector<double> deviation;
  for (int n = 0; n < 12; ++n) {
    const Frame frame(river_world(), 10.0 + n * 0.125);
    std::vector<double> values;
    frame.for_river([&](int x, int y) { values.push_back(frame.codes(x, y).g); });
    double mean = 0.0, square = 0.0;
    for (const double v : values) mean += v / static_cast<double>(values.size());
    for (const double v : values)
      square += (v - mean) * (v - mean) / static_cast<double>(values.size());
    deviation.push_back(std::sqrt(square));
  }
  const auto [least, most] = std::ranges::minmax(deviation);
  EXPECT_LT(most / least, 1.1);
  EXPECT_GT(least, 1.0);
}

// A river reads only the land's colours, in the terrain's square and around it.
TEST(DrawnRivers, KeepNoLandOfTheirOwn) {
  EXPECT_LT(sizeof(River), sizeof(Terrain));
  EXPECT_LT(sizeof(River{}.ground), sizeof(SlopeLayer));
}

TEST(DrawnRivers, AreTheSameBitsWithAnyThreadsAndAfterAnyFrame) {
  const World& world = river_world();
  const Frame one(world, 7.5);
  EXPECT_EQ(Frame(world, 7.5, {}, 3).target.rgba, one.target.rgba);
  EXPECT_EQ(Frame(world, 7.5, {.tile_size_px = 32}, 2).target.rgba, one.target.rgba);
  Frame history(world, 1.0);
  Workers workers(2);
  render_frame(world, history.view, 7.5, {}, history.workspace, history.target, workers);
  EXPECT_EQ(history.target.rgba, one.target.rgba);
}

}  // namespace
}  // namespace swell::render
