// Coverage by 4 or 8 samples a pixel, as a second pass over chosen pixels of a tile that leaves the
// buffers of draw_tile alone. The caller marks pixels, by its own rule or by mark_touched, and
// draw_samples finds the nearest triangle at each of their samples.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "raster/pass.h"
#include "raster/sample_pattern.h"

namespace swell::raster {

// A set of pixels of a tile: bit x of row y. Rows and bits outside the tile are 0.
class PixelMask {
 public:
  static constexpr int kMaxRows = 64;

  std::uint64_t row(int y) const { return rows_[static_cast<std::size_t>(y)]; }
  void set_row(int y, std::uint64_t bits) { rows_[static_cast<std::size_t>(y)] = bits; }
  void add_to_row(int y, std::uint64_t bits) { rows_[static_cast<std::size_t>(y)] |= bits; }
  bool has(int x, int y) const { return (row(y) >> x & 1) != 0; }
  void add(int x, int y) { add_to_row(y, std::uint64_t{1} << x); }
  void clear() { rows_.fill(0); }
  int count() const {
    int count = 0;
    for (const std::uint64_t bits : rows_) count += std::popcount(bits);
    return count;
  }

 private:
  std::array<std::uint64_t, kMaxRows> rows_{};
};

// Adds to `mask` every pixel of the tile, within the viewport, that holds a sample covered by a
// triangle whose primitive number lies in [first_primitive, end_primitive), seen or hidden. Also
// pixels where such a triangle only passes between the samples, through the square that holds them.
// The pass must have been prepared with samples. Different tiles may be marked by different
// threads at one time. Triangles of other primitives cost next to nothing where a draw has many,
// and those cost little around which `mask` has all pixels already.
void mark_touched(const Pass& pass, int tile, std::uint32_t first_primitive,
                  std::uint32_t end_primitive, PixelMask& mask);

// Finds the nearest triangle at every sample of the marked pixels. With S samples a pixel, sample s
// (of sample_positions) of the n-th marked pixel, row by row, goes to depth[n * S + s] and
// primitive[n * S + s]; both are mask.count() * S long. Depth is the triangle's plane at the
// sample; of equal depths the first submitted triangle wins. Samples without a triangle, and all
// samples of pixels outside the viewport, get depth 0 and kNoPrimitive. The pass must have been
// prepared with samples. Different tiles may be drawn by different threads at one time. Cost: a few
// nanoseconds for each triangle of the tile, then for each marked pixel in a triangle's bounding
// box. Returns the number of covered samples.
int draw_samples(const Pass& pass, int tile, const PixelMask& mask, std::span<float> depth,
                 std::span<std::uint32_t> primitive);

}  // namespace swell::raster
