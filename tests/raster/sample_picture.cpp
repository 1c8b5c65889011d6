#include "raster/sample_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace swell::raster {
namespace {

// 1/16 px.
constexpr int kVulkan4[4][2] = {{6, 2}, {14, 6}, {2, 10}, {10, 14}};
constexpr int kVulkan8[8][2] = {{9, 5},  {7, 11}, {13, 9},  {5, 3},
                                {3, 13}, {1, 7},  {11, 15}, {15, 1}};

// The samples of one tile with guards at both ends; returns the number of broken promises.
int draw_whole_tile(const Pass& pass, const TileGrid& grid, int tile, SamplePicture& to) {
  const int size = grid.tile_size_px, samples = to.samples;
  const auto count = static_cast<std::size_t>(size * size * samples);
  std::vector<float> depth(count + 2 * kGuard, kGuardDepth);
  std::vector<std::uint32_t> primitive(count + 2 * kGuard, kGuardPrimitive);
  const int covered = draw_samples(pass, tile, full_mask(size), std::span(depth).subspan(16, count),
                                   std::span(primitive).subspan(16, count));
  int broken = 0;
  for (std::size_t i = 0; i < kGuard; ++i) {
    for (const std::size_t j : {i, depth.size() - 1 - i}) {
      broken += depth[j] != kGuardDepth || primitive[j] != kGuardPrimitive;
    }
  }
  const int x0 = tile % grid.tiles_x * size, y0 = tile / grid.tiles_x * size;
  int found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const int pixel = static_cast<int>(i) / samples;
    const int x = x0 + pixel % size, y = y0 + pixel / size;
    const float z = depth[kGuard + i];
    const std::uint32_t id = primitive[kGuard + i];
    found += id != kNoPrimitive;
    broken += id == kNoPrimitive ? z != 0.0f : !(z >= 0.0f && z <= 1.0f);
    if (x >= to.width_px || y >= to.height_px) {
      broken += id != kNoPrimitive;
      continue;
    }
    to.depth[to.index(x, y, static_cast<int>(i) % samples)] = z;
    to.primitive[to.index(x, y, static_cast<int>(i) % samples)] = id;
  }
  if (found > 0 && !tile_has_triangles(pass, tile)) ++broken;
  return broken + (found != covered);
}

}  // namespace

double SamplePicture::coverage(int x, int y) const {
  int covered = 0;
  for (int s = 0; s < samples; ++s) covered += primitive_at(x, y, s) != kNoPrimitive;
  return static_cast<double>(covered) / samples;
}

bool SamplePicture::same_bits(const SamplePicture& other) const {
  return depth.size() == other.depth.size() &&
         std::memcmp(depth.data(), other.depth.data(), depth.size() * sizeof(float)) == 0 &&
         primitive == other.primitive;
}

SamplePicture draw_sample_picture(std::span<const Draw> draws, Viewport viewport, int samples,
                                  int tile_size_px, Workers& workers) {
  SamplePicture picture{viewport.width_px, viewport.height_px, samples, {}, {}, {}};
  const std::size_t count = picture.index(0, viewport.height_px, 0);
  picture.depth.assign(count, -5.0f);
  picture.primitive.assign(count, 5);
  Pass pass;
  prepare_pass(draws, viewport, tile_size_px, pass, workers, samples);
  picture.statistics = pass_statistics(pass);
  const TileGrid grid = tile_grid(viewport, tile_size_px);
  std::vector<int> broken(grid.count());
  workers.for_each(grid.count(), [&](std::size_t t, int) {
    broken[t] = draw_whole_tile(pass, grid, static_cast<int>(t), picture);
  });
  EXPECT_EQ(std::count(broken.begin(), broken.end(), 0), grid.count());
  return picture;
}

SamplePicture draw_sample_picture(const Draw& draw, Viewport viewport, int samples,
                                  int tile_size_px) {
  Workers workers(1);
  return draw_sample_picture(std::span(&draw, 1), viewport, samples, tile_size_px, workers);
}

std::vector<int> mark_picture(std::span<const Draw> draws, Viewport viewport, int samples,
                              int tile_size_px, std::uint32_t first_primitive,
                              std::uint32_t end_primitive) {
  std::vector<int> marks(static_cast<std::size_t>(viewport.width_px) * viewport.height_px);
  Workers workers(1);
  Pass pass;
  prepare_pass(draws, viewport, tile_size_px, pass, workers, samples);
  const TileGrid grid = tile_grid(viewport, tile_size_px);
  int marked = 0;
  for (int tile = 0; tile < grid.count(); ++tile) {
    PixelMask mask;
    mark_touched(pass, tile, first_primitive, end_primitive, mask);
    marked += mask.count();
    const PixelBox box = tile_box(viewport, grid, tile);
    for (int y = 0; y < box.height_px; ++y) {
      for (int x = 0; x < box.width_px; ++x) {
        marks[(box.y0_px + y) * viewport.width_px + box.x0_px + x] = mask.has(x, y);
      }
    }
  }
  // No marks outside the viewport.
  EXPECT_EQ(std::count(marks.begin(), marks.end(), 1), marked);
  return marks;
}

PixelMask full_mask(int tile_size_px) {
  PixelMask mask;
  for (int y = 0; y < tile_size_px; ++y) {
    for (int x = 0; x < tile_size_px; ++x) mask.add(x, y);
  }
  return mask;
}

Point sample_point(int x, int y, int s, int samples) {
  const int* offset = samples == 4 ? kVulkan4[s] : kVulkan8[s];
  return {256 * std::int64_t{x} + 16 * offset[0], 256 * std::int64_t{y} + 16 * offset[1]};
}

void FlatSoup::add(const Triangle& t, float depth, Viewport viewport) {
  triangles.push_back(t);
  z.push_back(depth);
  for (const Point& p : t) {
    indices.push_back(static_cast<std::uint32_t>(p_clip.size()));
    p_clip.push_back(clip_from_fx8(p, double{depth}, 1.0, viewport));
  }
}

Triangle any_triangle(Random& random, Viewport viewport) {
  const std::int64_t width = 256 * viewport.width_px, height = 256 * viewport.height_px;
  const std::int64_t kind = random.integer(0, 5);
  const double size = kind == 0   ? random.between(1.0, 200.0)
                      : kind == 1 ? random.between(1e5, 5e5)
                                  : 256.0 * std::exp2(random.between(-2.0, 6.0));
  const std::int64_t cx = random.integer(0, width), cy = random.integer(0, height);
  Triangle t;
  for (Point& p : t) {
    p = {cx + std::llround(random.between(-size, size)),
         cy + std::llround(random.between(-size, size))};
  }
  if (kind == 2) t[2] = {t[1].x + random.integer(-90, 90), t[1].y + random.integer(-90, 90)};
  if (kind == 3) {
    for (Point& p : t) p = {p.x / 16 * 16, p.y / 16 * 16};
    if (random.integer(0, 1) == 0) t[1].y = t[0].y;
    if (random.integer(0, 1) == 0) t[2].x = t[0].x;
  }
  if (kind == 4 && random.integer(0, 7) == 0) {
    t[2] = {2 * t[1].x - t[0].x, 2 * t[1].y - t[0].y};
  }
  return t;
}

FlatSoup random_flat_soup(Random& random, int count, Viewport viewport) {
  FlatSoup soup;
  for (int n = 0; n < count; ++n) {
    soup.add(any_triangle(random, viewport), static_cast<float>(random.integer(0, 6)) / 8.0f,
             viewport);
  }
  return soup;
}

}  // namespace swell::raster
