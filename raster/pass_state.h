// The storage behind Pass. Triangles are worked on in chunks of fixed size; a chunk keeps what it
// set up and which tiles that touches, and tiles walk the chunks in order, which is submission
// order. No step depends on which thread did a chunk.
#pragma once

#include <cstdint>
#include <vector>

#include "raster/pass.h"
#include "raster/setup.h"
#include "raster/small_triangles.h"
#include "raster/vertices.h"

namespace swell::raster {

// A triangle of a chunk: its place among those of any size, or among the small ones, with
// kBetweenCentres and kBetweenSamples.
struct Member {
  static constexpr std::uint32_t kSmall = 1u << 31;

  std::uint32_t bits;

  bool is_small() const { return (bits & kSmall) != 0; }
  bool may_cover_centres() const { return (bits & kBetweenCentres) == 0; }
  bool may_cover_samples() const { return (bits & kBetweenSamples) == 0; }
  std::uint32_t place() const { return bits & (kBetweenCentres - 1); }
};

struct TileEntry {
  std::uint32_t tile;
  Member member;
};

struct Chunk {
  // Input: triangles [begin, end) of one draw, whose vertices start at first_vertex. The first of
  // them is primitive first_primitive.
  std::uint32_t draw = 0, first_primitive = 0;
  std::size_t begin = 0, end = 0, first_vertex = 0;
  // Output.
  std::vector<SetupTriangle> triangles;   // of any size
  std::vector<std::int32_t> place;        // of every triangle, as of find_small_triangles()
  std::vector<SmallCorners> corners;      // of every triangle; those of small ones hold values
  std::vector<SmallDepths> depths;        // the same
  std::vector<TileEntry> entries;         // in triangle order
  std::vector<std::uint32_t> tile_begin;  // tiles + 1: where each tile's part of members begins
  std::vector<Member> members;            // by tile, in triangle order
  PassStatistics statistics;

  SetupTriangle set_up(Member member, Viewport viewport) const {
    const std::uint32_t n = member.place();
    return member.is_small() ? set_up_small(corners[n], depths[n], viewport) : triangles[n];
  }
};

// Whether the chunk has primitives in [first, end).
inline bool holds_any(const Chunk& chunk, std::uint32_t first, std::uint32_t end) {
  return chunk.first_primitive < end && chunk.first_primitive + (chunk.end - chunk.begin) > first;
}

struct Pass::State {
  Viewport viewport;
  TileGrid grid;
  int samples = 0;
  std::vector<WindowVertex> vertices;  // of all draws
  std::vector<Chunk> chunks;           // keeps more than chunk_count to keep their storage
  std::size_t chunk_count = 0;
  std::vector<std::uint8_t> tile_used;
  PassStatistics statistics;
};

}  // namespace swell::raster
