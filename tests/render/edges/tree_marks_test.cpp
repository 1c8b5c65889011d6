// Which pixels are looked at for smooth edges where trees stand on land: known answers for pictures
// of a few pixels, and those of a wood against those of lone trees.
#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "render/edges/edge_frames.h"
#include "render/tile/discontinuities.h"
#include "scene/scene.h"

namespace swell::render {
namespace {

using Place = std::pair<int, int>;  // x, y [px]

constexpr std::uint32_t kOpenLand = 0, kLoneTree = 10, kWoodTree = 11;
constexpr int kSide = 32;

// Land with some trees, all at one depth: primitive 10 is of a lone tree, 11 of one of a wood.
class MarkedPicture {
 public:
  explicit MarkedPicture(int tile_size_px) {
    visibility_.grid = raster::tile_grid(kViewport, tile_size_px);
    const auto tiles = static_cast<std::size_t>(visibility_.grid.count());
    visibility_.depth.assign(tiles * visibility_.tile_pixels(), 0.01f);
    visibility_.primitive.assign(tiles * visibility_.tile_pixels(), kOpenLand);
    visibility_.covered.assign(tiles, tile_size_px * tile_size_px);
    visibility_.water_pixels.assign(tiles, 0);
  }

  void show(Place place, std::uint32_t primitive) {
    const int size = visibility_.grid.tile_size_px;
    const int tile = place.second / size * visibility_.grid.tiles_x + place.first / size;
    const int at = place.second % size * size + place.first % size;
    visibility_.primitive_of(tile)[static_cast<std::size_t>(at)] = primitive;
    if (primitive == raster::kNoPrimitive)
      visibility_.depth_of(tile)[static_cast<std::size_t>(at)] = 0.0f;
  }

  std::set<Place> marked() const {
    std::set<Place> places;
    const std::vector<std::uint8_t> like_land = {0, 1};
    RenderView window;
    window.camera.width_px = window.camera.height_px = kSide;
    window.primitives = PrimitiveRanges({0, 10, 0, 2, 0});  // land and trees
    window.draws[SurfaceKind::kTrees].like_land = like_land;
    DiscontinuityScratch scratch;
    for (int tile = 0; tile < visibility_.grid.count(); ++tile) {
      raster::PixelMask mask;
      mark_discontinuities(visibility_, window, tile, scratch, mask);
      const raster::PixelBox box = raster::tile_box(kViewport, visibility_.grid, tile);
      for (int y = 0; y < box.height_px; ++y)
        for (int x = 0; x < box.width_px; ++x)
          if (mask.has(x, y)) places.insert({box.x0_px + x, box.y0_px + y});
    }
    return places;
  }

 private:
  static constexpr raster::Viewport kViewport{kSide, kSide};
  VisibilityBuffer visibility_;
};

// A pixel and its four neighbours.
std::set<Place> cross_at(Place p) {
  return {p,
          {p.first - 1, p.second},
          {p.first + 1, p.second},
          {p.first, p.second - 1},
          {p.first, p.second + 1}};
}

class MarksOfTrees : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(TileSizes, MarksOfTrees, testing::Values(16, 32));

// In a tile's middle and on both sides of the border between tiles of 16 pixels.
TEST_P(MarksOfTrees, ALoneTreeAndTheLandAroundItAreMarked) {
  for (const Place& place : {Place{5, 7}, Place{15, 16}, Place{16, 15}}) {
    MarkedPicture picture(GetParam());
    picture.show(place, kLoneTree);
    EXPECT_EQ(picture.marked(), cross_at(place)) << place.first << ", " << place.second;
  }
}

TEST_P(MarksOfTrees, ASmallTreeOfAWoodIsLikeTheLand) {
  for (const Place& place : {Place{5, 7}, Place{15, 16}, Place{16, 15}}) {
    MarkedPicture picture(GetParam());
    picture.show(place, kWoodTree);
    EXPECT_EQ(picture.marked(), std::set<Place>()) << place.first << ", " << place.second;
  }
}

TEST_P(MarksOfTrees, ASmallTreeOfAWoodIsMarkedAgainstTheSkyButNoTree) {
  for (const std::uint32_t other : {raster::kNoPrimitive, kLoneTree}) {
    MarkedPicture picture(GetParam());
    for (int y = 14; y < 19; ++y)
      for (int x = 10; x < 22; ++x) picture.show({x, y}, kWoodTree);
    picture.show({16, 16}, other);
    EXPECT_EQ(picture.marked(), other == kLoneTree ? std::set<Place>() : cross_at({16, 16}));
  }
}

// An island of trees of 12 m, seen so that they are 20 pixels high.
World island_of_trees(double density_per_m2) {
  return world_of(scene::parse_scene(R"(
    [camera]
    eye_m = [0.0, -330.0, 120.0]
    [terrain]
    island_radius_m = 130.0
    island_height_m = 30.0
    [[trees]]
    clumping = 0.0
    height_m = [11.9, 12.0]
    density_per_m2 = )" + std::to_string(density_per_m2),
                                     "island_of_trees.toml"));
}

// Returns which part of pixel pairs where trees meet land is smooth: either pixel has fragments.
double smooth_part(const World& world) {
  constexpr int kWide = 200, kHigh = 120;
  EdgeRenderer renderer(world);
  renderer.draw(make_view(world.scene().camera.eye_m, 0.0, -0.33, 0.22, 0.25f, kWide, kHigh), 4);
  const auto of_pixel = renderer.fragments();
  const auto kind_at = [&](int x, int y) { return renderer.kind_of(renderer.primitive(x, y)); };
  const int land = 1 + static_cast<int>(SurfaceKind::kTerrain);
  const int trees = 1 + static_cast<int>(SurfaceKind::kTrees);
  int meet = 0, smooth = 0;
  for (int y = 0; y < kHigh; ++y)
    for (int x = 0; x + 1 < kWide; ++x) {
      const std::set<int> kinds = {kind_at(x, y), kind_at(x + 1, y)};
      if (kinds != std::set<int>{land, trees}) continue;
      const std::size_t at = renderer.at(x, y);
      ++meet;
      smooth += !of_pixel[at].empty() || !of_pixel[at + 1].empty();
    }
  EXPECT_GT(meet, 300);
  return static_cast<double>(smooth) / meet;
}

TEST(EdgesOfTrees, AreSmoothWhereTheyStandAloneAndCostNothingInAWood) {
  EXPECT_GT(smooth_part(island_of_trees(0.002)), 0.7);
  EXPECT_LT(smooth_part(island_of_trees(0.05)), 0.15);
}

}  // namespace
}  // namespace swell::render
