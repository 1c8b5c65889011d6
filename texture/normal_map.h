// Bump maps from heights: slopes, normals, and a tileable map of small ripples.
// Source: Ma, Zhu, Gong, 2006 (tangents by differences, normals in 8 bits).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "texture/image/image.h"

namespace swell::texture {

// What lies beside the first and last row and column: the other end, or the same texel again.
enum class Edges : std::uint8_t { kPeriodic, kClamped };

// Slopes of a one-channel height image: strength (h[x + 1, y] - h[x - 1, y]) and the same along y,
// the third components of the tangents (1, 0, .) and (0, 1, .). With heights in texels a strength
// of 1/2 gives dh/dx and dh/dy. slope_x, slope_y: width * height floats, row-major.
void compute_slopes(const ImageF& heights, Edges edges, float strength, std::span<float> slope_x,
                    std::span<float> slope_y);

// Unit normals (-slope_x, -slope_y, 1) / length of slopes, width * height of them each, as RGB
// bytes: byte = round(255 (n + 1) / 2), so n = 2 byte / 255 - 1.
Image8 encode_normals(int width, int height, std::span<const float> slope_x,
                      std::span<const float> slope_y);
// The same of the slopes of heights.
Image8 make_normal_map(const ImageF& heights, Edges edges, float strength);

struct SlopeMap {
  int size = 0;
  std::vector<float> x, y;  // size * size, row-major, as pack_map2 wants them
};

// Ripples of about size/4 down to size/30 texels (shorter than 6 texels: left out), of the same
// steepness at every length and in every direction, periodic at `size` (a power of two in
// [32, 4096]); another `seed`, another map. The root mean square of (x, y)'s length is 1 and the
// means are 0. About 4 ms for 256 x 256.
SlopeMap make_bump_slopes(int size, std::uint64_t seed);

}  // namespace swell::texture
