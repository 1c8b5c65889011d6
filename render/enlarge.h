// Enlarging a picture that was drawn small to save time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/parallel.h"

namespace swell::render {

struct PictureExtent {
  int width_px = 0, height_px = 0;  // at least 1
  bool operator==(const PictureExtent&) const = default;
};

// Where the columns of the large picture lie between those of the small one, and a row for each
// thread; storage that enlarge() reuses.
struct EnlargeTables {
  PictureExtent from, to;
  struct Tap {
    std::uint16_t first, second;  // columns
    std::uint16_t weight_fx8;     // of the second, [0, 256]
  };
  std::vector<Tap> taps;
  std::vector<std::vector<std::uint64_t>> rows;
};

// Fills `large` from `small`, both row by row, R in the low byte of a pixel: bilinear between
// pixel centres in 8-bit sRGB, edges repeated, weights of 8 bits. A constant picture stays
// constant. `large` has at least as many pixels each way.
void enlarge(std::span<const std::uint32_t> small, PictureExtent from,
             std::span<std::uint32_t> large, PictureExtent to, EnlargeTables& tables,
             Workers& workers);

}  // namespace swell::render
