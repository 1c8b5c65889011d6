// Rivers and lakes in pictures: they are drawn where queries say, flow without pulsing, and follow
// from the scene and the time alone.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "render/frame.h"
#include "render/labels/classes.h"
#include "render/labels/label_channels.h"
#include "render/lake_and_river.h"
#include "render/view/meshes.h"
#include "render/workspace.h"
#include "render/world/world_state.h"
#include "scene/scene.h"
#include "scene/water.h"

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

const World& river_world() {
  static const World world(
      scene::parse_scene(std::string(kCameraAndLight) + kLakeAndRiver + "speed_mps = 1\n",
                         "river.toml"),
      1);
  return world;
}

// What a small frame of a world shows.
struct Frame {
  Workspace workspace;
  Target target;
  View view;

  Frame(const World& world, double t_s, const FrameOptions& options = {}, int threads = 1)
      : view(scene::camera_view(world.scene().camera, t_s, 160, 120)) {
    Workers workers(threads);
    render_frame(world, view, t_s, options, workspace, target, workers);
  }

  std::uint32_t primitive(int x, int y) const {
    const VisibilityBuffer& buffer = workspace.state().visibility;
    return buffer.primitive_of(tile(x, y))[at(x, y)];
  }
  bool shows_river(int x, int y) const {
    const VisibilityBuffer& buffer = workspace.state().visibility;
    return buffer.covered[static_cast<std::size_t>(tile(x, y))] > 0 &&
           workspace.state().window.primitives.holds(SurfaceKind::kRivers, primitive(x, y));
  }
  glm::dvec3 point(int x, int y) const {
    const VisibilityBuffer& buffer = workspace.state().visibility;
    const float depth_m = view.near_m / buffer.depth_of(tile(x, y))[at(x, y)];
    const glm::vec3 ray = view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
    return view.eye_world + glm::dvec3(depth_m * ray);
  }
  std::vector<double> river_brightness() const {
    std::vector<double> values;
    for (int y = 0; y < view.height_px; ++y)
      for (int x = 0; x < view.width_px; ++x) {
        const std::uint32_t p = target.rgba[static_cast<std::size_t>(y * view.width_px + x)];
        if (shows_river(x, y)) values.push_back((p >> 8) & 0xffu);
      }
    return values;
  }

 private:
  int tile(int x, int y) const {
    const raster::TileGrid& grid = workspace.state().visibility.grid;
    return y / grid.tile_size_px * grid.tiles_x + x / grid.tile_size_px;
  }
  std::size_t at(int x, int y) const {
    const int size = workspace.state().visibility.grid.tile_size_px;
    return static_cast<std::size_t>(y % size * size + x % size);
  }
};

TEST(DrawnRivers, LieWhereQueriesSay) {
  const World& world = river_world();
  const Frame frame(world, 2.0);
  const scene::Water water(world.scene());
  ocean::SeaFrame sea;
  Workers workers(1);
  const scene::WaterSurface surface = water.at(2.0, sea, workers);
  // At the water's edge the drawn land is a little off.
  int river = 0, off = 0;
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) {
      if (!frame.shows_river(x, y)) continue;
      const glm::dvec3 p = frame.point(x, y);
      off += std::abs(static_cast<double>(surface.height(glm::dvec2(p))) - p.z) > 0.03;
      ++river;
    }
  EXPECT_GT(river, 1500);
  EXPECT_LT(off, river / 200);
}

TEST(DrawnRivers, CanBeLeftOut) {
  const World& world = river_world();
  FrameOptions without;
  without.without = {Part::kRivers};
  const Frame with(world, 2.0), dry(world, 2.0, without);
  EXPECT_TRUE(dry.workspace.state().meshes.rivers.indices.empty());
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x)
      if (with.shows_river(x, y)) {
        const PrimitiveRanges& shown = dry.workspace.state().window.primitives;
        EXPECT_TRUE(shown.holds(SurfaceKind::kTerrain, dry.primitive(x, y)) ||
                    shown.holds(SurfaceKind::kWater, dry.primitive(x, y)));
      }
}

TEST(DrawnRivers, AreWaterInLabels) {
  const World& world = river_world();
  FrameOptions options;
  options.labels.add(Label::kClass);
  const Frame frame(world, 2.0, options);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x)
      if (frame.shows_river(x, y)) {
        const std::uint32_t c =
            frame.target.labels.klass[static_cast<std::size_t>(y * frame.view.width_px + x)];
        EXPECT_TRUE(c == kWaterClass || c == kFoamClass) << c;
      }
}

// The lake fills the picture; its river comes down to the sea.
TEST(DrawnRivers, MirrorInTheSeasLevelAndInOneMore) {
  const World& world = river_world();
  const Frame frame(world, 2.0);
  const RiverMesh& rivers = frame.workspace.state().meshes.rivers;
  ASSERT_TRUE(rivers.mirror_level_m);
  EXPECT_NEAR(*rivers.mirror_level_m, 4.0f, 0.5f);
  EXPECT_EQ(rivers.mirror_share, 1.0f);
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
  FrameOptions without;
  without.without = {Part::kReflection};
  const Frame bare(world, 2.0, without);
  int changed = 0;
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) {
      const auto i = static_cast<std::size_t>(y * 160 + x);
      changed += frame.shows_river(x, y) && frame.target.rgba[i] != bare.target.rgba[i];
    }
  EXPECT_GT(changed, 100);
}

// RIV-05: the contrast of the carried ripples over their period, where every phase passes.
TEST(DrawnRivers, RipplesDoNotPulse) {
  const World& world = river_world();
  std::vector<double> deviation;
  for (int n = 0; n < 12; ++n) {
    const std::vector<double> values = Frame(world, 10.0 + n * 0.125).river_brightness();
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

TEST(DrawnRivers, AreTheSameBitsWithAnyThreadsAndAfterAnyFrame) {
  const World& world = river_world();
  const Frame one(world, 7.5);
  FrameOptions small_tiles;
  small_tiles.tile_size_px = 32;
  EXPECT_EQ(Frame(world, 7.5, {}, 3).target.rgba, one.target.rgba);
  EXPECT_EQ(Frame(world, 7.5, small_tiles, 2).target.rgba, one.target.rgba);
  Frame history(world, 1.0);
  Workers workers(2);
  render_frame(world, history.view, 7.5, {}, history.workspace, history.target, workers);
  EXPECT_EQ(history.target.rgba, one.target.rgba);
}

}  // namespace
}  // namespace swell::render
