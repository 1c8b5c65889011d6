// Triangles of a few pixels: most of a surface that is finer than the picture. They are kept as
// corners, many are looked at side by side, and each is set up in its tile, where it is drawn.
#pragma once

#include <cstdint>
#include <span>

#include "raster/setup.h"

namespace swell::raster {

// A small triangle's sides are at most so long, and its bounding box holds so few pixel centres.
inline constexpr std::int32_t kSmallSide_fx8 = 8 * kPixelFx8;
inline constexpr int kMostSmallPixels = 8;

// Three vertices in the order of SetupTriangle, the second and third relative to the first.
struct SmallCorners {
  std::int32_t x_fx8, y_fx8;
  std::int16_t dx1_fx8, dy1_fx8, dx2_fx8, dy2_fx8;
};
struct SmallDepths {
  float depth[3];
  std::uint32_t primitive;
};
static_assert(sizeof(SmallCorners) == 16 && sizeof(SmallDepths) == 16);

// Where a triangle goes, if it is not left out: as a small one into a tile, the next one in its row
// too with kTwoColumns, and those below with kTwoRows; or by the way of those of any size.
inline constexpr std::int32_t kLeftOut = -1, kOfAnySize = -2;
inline constexpr std::int32_t kTwoColumns = 1 << 27, kTwoRows = 1 << 28;
// Its bounding box holds no centre of a pixel, or no sample: only the other may see it.
inline constexpr std::int32_t kBetweenCentres = 1 << 29, kBetweenSamples = 1 << 30;

// Of each triangle, as long as small_size() says.
struct SmallOutputs {
  std::span<std::int32_t> place;
  std::span<SmallCorners> corners;
  std::span<SmallDepths> depths;
};

// Looks for small ones among triangles that share `vertices` by `indices`, 3 a triangle, each less
// than vertices.size(). Writes where each goes and, of small ones, what they are; triangle n is
// primitive first_primitive + n. Counts those left out.
void find_small_triangles(std::span<const WindowVertex> vertices,
                          std::span<const std::uint32_t> indices, const SetupRules& rules,
                          const TileGrid& grid, std::uint32_t first_primitive,
                          const SmallOutputs& out, PassStatistics& statistics);

// Room for the outputs of so many triangles: whole packets.
constexpr std::size_t small_size(std::size_t triangles) { return (triangles + 15) / 16 * 16; }

// The same triangle as those of any size are set up.
SetupTriangle set_up_small(const SmallCorners& corners, const SmallDepths& depths,
                           Viewport viewport);

}  // namespace swell::raster
