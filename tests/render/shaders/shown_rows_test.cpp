// Lookups that are left out because nothing is there would have found nothing.
#include "render/picture/shown_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "render/shaders/optics_kernels.h"

namespace swell::render {
namespace {

// An image with a few things in it, drawn tile by tile.
struct Drawn {
  texture::RgbaImage image;
  std::vector<std::uint32_t> shown;
};

struct Size {
  int width_px, height_px;
};

Drawn draw(Size size, int levels, texture::BlurAxis axis, int tile_size_px, int things) {
  Drawn drawn;
  texture::resize_image(size.width_px, size.height_px, drawn.image, levels, axis);
  std::mt19937 random(static_cast<unsigned>(things));
  const auto below = [&](int end) {
    return static_cast<int>(random() % static_cast<unsigned>(end));
  };
  for (int n = 0; n < things; ++n) {
    const int x0 = below(size.width_px), y0 = below(size.height_px);
    const int x1 = std::min(x0 + 1 + below(9), size.width_px);
    const int y1 = std::min(y0 + 1 + below(9), size.height_px);
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) drawn.image.texels[y * drawn.image.stride + x] = 0xffffffffu;
  }
  const raster::TileGrid grid = raster::tile_grid({size.width_px, size.height_px}, tile_size_px);
  std::vector<RowRange> rows(static_cast<std::size_t>(grid.tiles_y * columns_of(drawn.image)));
  for (int tile = 0; tile < grid.count(); ++tile) {
    const raster::PixelBox box = raster::tile_box({size.width_px, size.height_px}, grid, tile);
    std::vector<std::uint32_t> primitive(static_cast<std::size_t>(tile_size_px) * tile_size_px,
                                         raster::kNoPrimitive);
    for (int y = 0; y < box.height_px; ++y)
      for (int x = 0; x < box.width_px; ++x)
        if (drawn.image.texels[(box.y0_px + y) * drawn.image.stride + box.x0_px + x] != 0)
          primitive[y * tile_size_px + x] = 7;
    find_tile_rows(drawn.image, grid, tile, primitive, rows);
    texture::soften_block(box.x0_px, box.y0_px, box.x0_px + box.width_px, box.y0_px + box.height_px,
                          drawn.image);
  }
  texture::fill_padding(drawn.image);
  find_shown_rows(drawn.image, rows, drawn.shown);
  return drawn;
}

TEST(ShownRows, HoldAllPlacesWhereALookupFindsAnything) {
  for (const int levels : {1, texture::kMostRgbaLevels})
    for (const auto axis : {texture::BlurAxis::kX, texture::BlurAxis::kY})
      for (const int tile_size_px : {16, 64})
        for (const Size size : {Size{203, 150}, {64, 300}}) {
          const Drawn drawn = draw(size, levels, axis, tile_size_px, 3);
          ASSERT_FALSE(drawn.shown.empty());
          const PlanarMap map{&drawn.image, 0.5f, 0.5f, drawn.shown.data()};
          std::vector<SoftLookUp> lookups;
          for (int y = -40; y < 2 * size.height_px + 40; y += 3)
            for (int x = -40; x < 2 * size.width_px + 40; x += 3)
              for (const float spread_px : {0.5f, 7.0f, 15.0f, 40.0f})
                lookups.push_back(
                    {{static_cast<float>(x) + 0.49f, static_cast<float>(y)}, spread_px});
          std::vector<FoundSoftly> found(lookups.size());
          look_up_softly(map, lookups, found);
          std::size_t finds = 0, left_out = 0;
          for (std::size_t i = 0; i < found.size(); ++i) {
            finds += found[i].alpha > 0.0f;
            left_out += !found[i].may_show;
            ASSERT_TRUE(found[i].may_show || found[i].alpha == 0.0f)
                << lookups[i].at_px.x << ' ' << lookups[i].at_px.y << ' ' << lookups[i].spread_px
                << " levels=" << levels << " axis=" << static_cast<int>(axis);
          }
          EXPECT_GT(finds, 0u);
          EXPECT_GT(2 * left_out, found.size());
        }
}

// Lookups clamp to the image: what lies at its edge is found from beyond.
TEST(ShownRows, GoOnBeyondTheImagesEdges) {
  texture::RgbaImage image;
  texture::resize_image(64, 64, image);
  std::vector<RowRange> rows(static_cast<std::size_t>(columns_of(image)));
  rows.front() = {0, 1};
  std::vector<std::uint32_t> shown;
  find_shown_rows(image, rows, shown);
  const PlanarMap map{&image, 1.0f, 1.0f, shown.data()};
  const std::vector<SoftLookUp> lookups = {
      {{-50.0f, -50.0f}, 0.0f}, {{-50.0f, 32.0f}, 0.0f}, {{50.0f, -50.0f}, 0.0f}};
  std::vector<FoundSoftly> found(lookups.size());
  look_up_softly(map, lookups, found);
  EXPECT_TRUE(found[0].may_show);
  EXPECT_FALSE(found[1].may_show);
  EXPECT_FALSE(found[2].may_show);
}

TEST(ShownRows, AreNotKeptWhereMostOfTheImageShowsSomething) {
  texture::RgbaImage image;
  texture::resize_image(64, 64, image);
  const std::vector<RowRange> rows(static_cast<std::size_t>(columns_of(image)), RowRange{0, 40});
  std::vector<std::uint32_t> shown;
  find_shown_rows(image, rows, shown);
  EXPECT_TRUE(shown.empty());
}

}  // namespace
}  // namespace swell::render
