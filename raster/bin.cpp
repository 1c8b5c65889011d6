#include "raster/bin.h"

#include <algorithm>
#include <array>

namespace swell::raster {
namespace {

struct TileRange {
  std::int32_t x0, y0, x1, y1;  // inclusive
};

// Lists the tiles of a block of at least 2 x 2 that no edge excludes. An edge excludes a tile if
// it is negative at the point that lies farthest on its inner side in the square around the
// samples, or centres, of the tile's pixels.
void bin_by_edges(const TileGrid& grid, const TileRange& range, SampleExtent extent, Chunk& chunk,
                  std::uint32_t index) {
  const SetupTriangle& triangle = chunk.triangles[index];
  const std::int32_t tile_fx8 = grid.tile_size_px * kPixelFx8;
  std::array<std::int64_t, 3> row, step_x, step_y;
  for (int i = 0; i < 3; ++i) {
    const Edge edge = edge_of(triangle, i);
    const std::int32_t far_fx8 = tile_fx8 - kPixelFx8 + extent.high_fx8;
    const std::int32_t corner_x = edge.a > 0 ? far_fx8 : extent.low_fx8;
    const std::int32_t corner_y = edge.b > 0 ? far_fx8 : extent.low_fx8;
    row[i] = edge.at(range.x0 * tile_fx8 + corner_x, range.y0 * tile_fx8 + corner_y);
    step_x[i] = std::int64_t{edge.a} * tile_fx8;
    step_y[i] = std::int64_t{edge.b} * tile_fx8;
  }
  for (std::int32_t y = range.y0; y <= range.y1; ++y) {
    std::array<std::int64_t, 3> e = row;
    for (std::int32_t x = range.x0; x <= range.x1; ++x) {
      if ((e[0] | e[1] | e[2]) >= 0) {
        chunk.entries.push_back({static_cast<std::uint32_t>(y * grid.tiles_x + x), {index}});
      }
      for (int i = 0; i < 3; ++i) e[i] += step_x[i];
    }
    for (int i = 0; i < 3; ++i) row[i] += step_y[i];
  }
}

// The tiles in whose pixels the triangle may cover a sample, or a centre; not empty.
TileRange tiles_to_list(const SetupTriangle& t, Viewport viewport, int samples, int shift) {
  const auto tiles_of = [&](const PixelRect& rect) {
    return TileRange{rect.x0 >> shift, rect.y0 >> shift, rect.x1 >> shift, rect.y1 >> shift};
  };
  if (samples == 0) return tiles_of({t.min_x, t.min_y, t.max_x, t.max_y});
  // Samples lie at most one pixel farther than centres, so mostly in the same tile.
  const TileRange wider = tiles_of({t.min_x - 1, t.min_y - 1, t.max_x + 1, t.max_y + 1});
  if (wider.x0 == wider.x1 && wider.y0 == wider.y1) return wider;
  return tiles_of(limit_to(viewport, pixels_between(bounds_of(t), sample_extent(samples))));
}

}  // namespace

void list_tiles(const TileGrid& grid, Viewport viewport, int samples, std::uint32_t index,
                Chunk& chunk) {
  const TileRange range =
      tiles_to_list(chunk.triangles[index], viewport, samples, grid.tile_log2());
  if (range.x0 != range.x1 && range.y0 != range.y1)
    return bin_by_edges(grid, range, sample_extent(samples), chunk, index);
  // In one row or column of tiles the triangle passes through every tile of its box.
  for (std::int32_t y = range.y0; y <= range.y1; ++y)
    for (std::int32_t x = range.x0; x <= range.x1; ++x)
      chunk.entries.push_back({static_cast<std::uint32_t>(y * grid.tiles_x + x), {index}});
}

// A counting sort, which keeps the order within each tile.
void sort_by_tile(const TileGrid& grid, Chunk& chunk) {
  std::vector<std::uint32_t>& begin = chunk.tile_begin;
  begin.assign(static_cast<std::size_t>(grid.count()) + 1, 0);
  for (const TileEntry& entry : chunk.entries) ++begin[entry.tile];
  std::uint32_t sum = 0;
  for (std::uint32_t& b : begin) sum = b += sum;
  chunk.members.resize(chunk.entries.size());
  // Backwards, so that begin[tile] ends as the tile's first place.
  for (auto entry = chunk.entries.rbegin(); entry != chunk.entries.rend(); ++entry) {
    chunk.members[--begin[entry->tile]] = entry->member;
  }
  chunk.statistics.binned += chunk.entries.size();
}

}  // namespace swell::raster
