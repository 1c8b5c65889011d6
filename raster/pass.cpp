#include "raster/pass.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/check.h"
#include "raster/bin.h"
#include "raster/clip.h"
#include "raster/pass_state.h"
#include "raster/setup.h"
#include "raster/vertices.h"

namespace swell::raster {
namespace {

constexpr std::size_t kVerticesPerJob = 8192;
constexpr std::size_t kMinTrianglesPerChunk = 1024;
constexpr std::size_t kMostChunks = 64;  // of a draw, about
constexpr std::size_t kTilesPerJob = 4096;

void check_draw(const Draw& draw) {
  SWELL_CHECK(draw.indices.size() % 3 == 0, "indices={}", draw.indices.size());
  for (const std::span<const float> distance : draw.clip_distance)
    SWELL_CHECK(distance.empty() || distance.size() == draw.p_clip.size(),
                "clip_distance={} p_clip={}", distance.size(), draw.p_clip.size());
  SWELL_CHECK(draw.indices.size() / 3 <= kNoPrimitive - draw.first_primitive,
              "first_primitive={} triangles={}", draw.first_primitive, draw.indices.size() / 3);
}

// Cuts the draws into chunks and finds the place of each draw's vertices. A chunk has a table of
// all tiles, and each tile looks into every chunk: with many tiles or triangles chunks get larger.
void plan_chunks(std::span<const Draw> draws, Pass::State& state) {
  std::size_t vertex_count = 0, chunk_count = 0;
  for (std::size_t d = 0; d < draws.size(); ++d) {
    const std::size_t triangle_count = draws[d].indices.size() / 3;
    const std::size_t chunk_size =
        std::max({kMinTrianglesPerChunk, static_cast<std::size_t>(state.grid.count()) / 4,
                  triangle_count / kMostChunks});
    for (std::size_t begin = 0; begin < triangle_count; begin += chunk_size) {
      if (chunk_count == state.chunks.size()) state.chunks.emplace_back();
      Chunk& chunk = state.chunks[chunk_count++];
      chunk.draw = static_cast<std::uint32_t>(d);
      chunk.begin = begin;
      chunk.end = std::min(begin + chunk_size, triangle_count);
      chunk.first_vertex = vertex_count;
      chunk.first_primitive = draws[d].first_primitive + static_cast<std::uint32_t>(begin);
    }
    vertex_count += draws[d].p_clip.size();
  }
  state.chunk_count = chunk_count;
  if (state.vertices.size() < vertex_count) state.vertices.resize(vertex_count);
}

void project_draws(std::span<const Draw> draws, Pass::State& state, Workers& workers) {
  std::size_t first = 0;
  for (const Draw& draw : draws) {
    const std::size_t count = draw.p_clip.size();
    const std::span<WindowVertex> out = std::span(state.vertices).subspan(first, count);
    workers.for_each((count + kVerticesPerJob - 1) / kVerticesPerJob, [&](std::size_t job, int) {
      const std::size_t begin = job * kVerticesPerJob;
      const std::size_t size = std::min(kVerticesPerJob, count - begin);
      ClipDistances distances;
      for (std::size_t k = 0; k < kClipDistances; ++k)
        if (!draw.clip_distance[k].empty())
          distances[k] = draw.clip_distance[k].subspan(begin, size);
      project_vertices(draw.p_clip.subspan(begin, size), distances, state.viewport,
                       out.subspan(begin, size));
    });
    first += count;
  }
}

// One source triangle: its vertices before and after projection.
struct SourceTriangle {
  std::array<std::uint32_t, 3> index;
  std::array<const WindowVertex*, 3> window;
  std::uint32_t primitive;
};

void count_result(SetupResult result, PassStatistics& statistics) {
  switch (result) {
    case SetupResult::kReady:
      break;
    case SetupResult::kDegenerate:
      ++statistics.culled_degenerate;
      break;
    case SetupResult::kFacing:
      ++statistics.culled_facing;
      break;
    case SetupResult::kOutside:
      ++statistics.culled_outside;
      break;
    case SetupResult::kBetweenPixels:
      ++statistics.culled_between_pixels;
      break;
  }
}

SetupResult append_triangle(const WindowVertex& v0, const WindowVertex& v1, const WindowVertex& v2,
                            const SetupRules& rules, std::uint32_t primitive, Chunk& chunk) {
  chunk.triangles.emplace_back();
  const SetupTriangle& t = chunk.triangles.back();
  const SetupResult result = set_up_triangle(v0, v1, v2, rules, primitive, chunk.triangles.back());
  if (result != SetupResult::kReady) {
    chunk.triangles.pop_back();
  } else if (t.min_x > t.max_x || t.min_y > t.max_y) {
    ++chunk.statistics.set_up_for_samples;
  }
  return result;
}

// The window vertex of a vertex made by a cut; it lies within the clip planes up to rounding.
WindowVertex project_cut_vertex(const glm::dvec4& p, Viewport viewport) {
  const double half_x = 0.5 * kPixelFx8 * viewport.width_px;
  const double half_y = 0.5 * kPixelFx8 * viewport.height_px;
  const auto snap = [](double v) { return static_cast<std::int32_t>(std::nearbyint(v)); };
  return {snap(p.x / p.w * half_x + half_x), snap(half_y - p.y / p.w * half_y),
          static_cast<float>(std::clamp(p.z / p.w, 0.0, 1.0)), 0};
}

// Clips and sets up the pieces as a fan. Counts as culled, by the last piece's reason, only if no
// piece is left.
void clip_and_set_up(const SourceTriangle& source, const Draw& draw, const SetupRules& rules,
                     Chunk& chunk) {
  std::array<ClipVertex, 3> triangle;
  for (int i = 0; i < 3; ++i) {
    const std::uint32_t v = source.index[i];
    triangle[i] = {glm::dvec4(draw.p_clip[v]), {}, i};
    for (std::size_t k = 0; k < kClipDistances; ++k)
      if (!draw.clip_distance[k].empty()) triangle[i].user[k] = draw.clip_distance[k][v];
  }
  const ClipPolygon polygon = clip_triangle(triangle, rules.viewport);
  ++chunk.statistics.clipped;
  std::array<WindowVertex, ClipPolygon::kMaxVertices> window;
  for (int i = 0; i < polygon.count; ++i) {
    const ClipVertex& v = polygon.vertices[i];
    window[i] =
        v.source >= 0 ? *source.window[v.source] : project_cut_vertex(v.p_clip, rules.viewport);
  }

  SetupResult last = SetupResult::kOutside;
  bool any_ready = false;
  for (int i = 2; i < polygon.count; ++i) {
    last = append_triangle(window[0], window[i - 1], window[i], rules, source.primitive, chunk);
    any_ready |= last == SetupResult::kReady;
  }
  if (!any_ready) count_result(last, chunk.statistics);
}

void set_up_source(const SourceTriangle& source, const Draw& draw, const SetupRules& rules,
                   Chunk& chunk) {
  const WindowVertex& v0 = *source.window[0];
  const WindowVertex& v1 = *source.window[1];
  const WindowVertex& v2 = *source.window[2];
  const std::uint32_t any = v0.flags | v1.flags | v2.flags;
  if ((any & (kClipFlags | kNotFinite)) == 0) [[likely]] {
    if ((v0.flags & v1.flags & v2.flags & kRejectFlags) != 0) {
      ++chunk.statistics.culled_outside;
      return;
    }
    count_result(append_triangle(v0, v1, v2, rules, source.primitive, chunk), chunk.statistics);
  } else if ((any & kNotFinite) != 0) {
    ++chunk.statistics.culled_degenerate;
  } else if ((v0.flags & v1.flags & v2.flags & kRejectFlags) != 0) {
    ++chunk.statistics.culled_outside;
  } else {
    clip_and_set_up(source, draw, rules, chunk);
  }
}

// Those that are not small, one by one.
void set_up_any_size(const Draw& draw, const Pass::State& state, std::size_t n, Chunk& chunk) {
  SourceTriangle source;
  for (int i = 0; i < 3; ++i) {
    source.index[i] = draw.indices[3 * n + i];
    source.window[i] = &state.vertices[chunk.first_vertex + source.index[i]];
  }
  source.primitive = draw.first_primitive + static_cast<std::uint32_t>(n);
  std::size_t first = chunk.triangles.size();
  set_up_source(source, draw, {draw.cull, state.viewport, state.samples}, chunk);
  for (; first < chunk.triangles.size(); ++first)
    list_tiles(state.grid, state.viewport, state.samples, static_cast<std::uint32_t>(first), chunk);
}

// Steps 3 and 4: sets up what is not small, and lists everything by tiles.
void set_up_chunk(const Draw& draw, const Pass::State& state, Chunk& chunk) {
  chunk.triangles.clear();
  chunk.entries.clear();
  chunk.statistics = {};
  const std::size_t count = chunk.end - chunk.begin, size = small_size(count);
  chunk.place.resize(size);
  chunk.corners.resize(size);
  chunk.depths.resize(size);
  find_small_triangles(std::span(state.vertices).subspan(chunk.first_vertex, draw.p_clip.size()),
                       draw.indices.subspan(3 * chunk.begin, 3 * count),
                       {draw.cull, state.viewport, state.samples}, state.grid,
                       chunk.first_primitive, {chunk.place, chunk.corners, chunk.depths},
                       chunk.statistics);
  for (std::uint32_t n = 0; n < count; ++n) {
    const std::int32_t place = chunk.place[n];
    if (place >= 0) {
      list_small(state.grid, place, n, chunk);
    } else if (place == kOfAnySize) {
      set_up_any_size(draw, state, chunk.begin + n, chunk);
    }
  }
  sort_by_tile(state.grid, chunk);
  chunk.statistics.submitted = count;
  chunk.statistics.set_up += chunk.triangles.size();
}

void mark_used_tiles(Pass::State& state, Workers& workers) {
  const auto tile_count = static_cast<std::size_t>(state.grid.count());
  state.tile_used.resize(tile_count);
  workers.for_each((tile_count + kTilesPerJob - 1) / kTilesPerJob, [&](std::size_t job, int) {
    const std::size_t begin = job * kTilesPerJob;
    const std::size_t end = std::min(begin + kTilesPerJob, tile_count);
    std::fill(state.tile_used.begin() + begin, state.tile_used.begin() + end, std::uint8_t{0});
    for (std::size_t c = 0; c < state.chunk_count; ++c) {
      const std::uint32_t* first = state.chunks[c].tile_begin.data();
      for (std::size_t t = begin; t < end; ++t) state.tile_used[t] |= first[t] != first[t + 1];
    }
  });
}

void add_statistics(const PassStatistics& from, PassStatistics& to) {
  to.submitted += from.submitted;
  to.culled_outside += from.culled_outside;
  to.culled_facing += from.culled_facing;
  to.culled_degenerate += from.culled_degenerate;
  to.culled_between_pixels += from.culled_between_pixels;
  to.clipped += from.clipped;
  to.set_up += from.set_up;
  to.set_up_for_samples += from.set_up_for_samples;
  to.binned += from.binned;
}

}  // namespace

Pass::Pass() : state_(std::make_unique<State>()) {}
Pass::~Pass() = default;
Pass::Pass(Pass&&) noexcept = default;
Pass& Pass::operator=(Pass&&) noexcept = default;

void prepare_pass(std::span<const Draw> draws, Viewport viewport, int tile_size_px, Pass& pass,
                  Workers& workers, int samples) {
  SWELL_CHECK(is_sample_count(samples), "samples={}", samples);
  Pass::State& state = pass.state();
  state.viewport = viewport;
  state.samples = samples;
  state.grid = tile_grid(viewport, tile_size_px);
  for (const Draw& draw : draws) check_draw(draw);

  plan_chunks(draws, state);
  project_draws(draws, state, workers);
  workers.for_each(state.chunk_count, [&](std::size_t c, int) {
    Chunk& chunk = state.chunks[c];
    set_up_chunk(draws[chunk.draw], state, chunk);
  });
  mark_used_tiles(state, workers);

  state.statistics = {};
  for (std::size_t c = 0; c < state.chunk_count; ++c) {
    add_statistics(state.chunks[c].statistics, state.statistics);
  }
}

const PassStatistics& pass_statistics(const Pass& pass) { return pass.state().statistics; }

TileGrid tile_grid(Viewport viewport, int tile_size_px) {
  SWELL_CHECK(viewport.width_px >= 1 && viewport.width_px <= kMaxViewport &&
                  viewport.height_px >= 1 && viewport.height_px <= kMaxViewport,
              "viewport={}x{}", viewport.width_px, viewport.height_px);
  SWELL_CHECK(tile_size_px == 16 || tile_size_px == 32 || tile_size_px == 64, "tile_size_px={}",
              tile_size_px);
  return {tile_size_px, (viewport.width_px + tile_size_px - 1) / tile_size_px,
          (viewport.height_px + tile_size_px - 1) / tile_size_px};
}

PixelBox tile_box(Viewport viewport, const TileGrid& grid, int tile) {
  const int x0 = tile % grid.tiles_x * grid.tile_size_px;
  const int y0 = tile / grid.tiles_x * grid.tile_size_px;
  return {x0, y0, std::min(grid.tile_size_px, viewport.width_px - x0),
          std::min(grid.tile_size_px, viewport.height_px - y0)};
}

bool tile_has_triangles(const Pass& pass, int tile) {
  const Pass::State& state = pass.state();
  SWELL_CHECK(tile >= 0 && tile < state.grid.count(), "tile={} tiles={}", tile, state.grid.count());
  return state.tile_used[static_cast<std::size_t>(tile)] != 0;
}

bool tile_has_triangles(const Pass& pass, int tile, std::uint32_t first_primitive,
                        std::uint32_t end_primitive) {
  const Pass::State& state = pass.state();
  SWELL_CHECK(tile >= 0 && tile < state.grid.count(), "tile={} tiles={}", tile, state.grid.count());
  const auto chunks = std::span(state.chunks).first(state.chunk_count);
  return std::ranges::any_of(chunks, [&](const Chunk& chunk) {
    return holds_any(chunk, first_primitive, end_primitive) &&
           chunk.tile_begin[tile] != chunk.tile_begin[tile + 1];
  });
}

}  // namespace swell::raster
