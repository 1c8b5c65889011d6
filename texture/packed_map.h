// Maps laid out so that one bilinear sample costs one or two loads (gathers are slow on CPUs).
// See packed_map-inl.h for the SIMD samplers and tests/texture for the scalar references.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "math/large_array.h"

namespace swell {
class Workers;
}

namespace swell::texture {

// The 2 x 2 neighbourhood of a texel, both channels, as signed bytes from the low byte up:
// a(i,j) a(i+1,j) a(i,j+1) a(i+1,j+1) b(i,j) b(i+1,j) b(i,j+1) b(i+1,j+1).
using PackedQuad = std::uint64_t;

// All that a sample between two mip levels needs: the quad of a texel (i, j), and the quad of the
// next coarser level that it lies in, (i / 2, j / 2).
struct alignas(16) PackedWord {
  PackedQuad fine, coarse;
  static constexpr bool kPlainBytes = true;
  bool operator==(const PackedWord&) const = default;
};

inline constexpr int kMostPackedSize = 4096;  // of a map, a side

// Sums over a row of a level, both channels together or each: of squares, and of squared
// differences of texels side by side and across.
struct PackedRowSums {
  double squares;
  std::array<double, 2> beside, across;
};

// A periodic two-channel map with mip levels, for slopes, normals and offsets; value = byte *
// scale. Level l is (size >> l) squared, down to 1 x 1; a level of side s begins at word s * s, so
// that a sampler finds it without a table.
struct PackedMap2 {
  int size = 0;    // power of two, [1, kMostPackedSize]
  int levels = 0;  // log2(size) + 1
  // Levels below this hold detail worth blending, at most kMostDetailLevels: all but the two
  // coarsest and those with too little variance; at least 1, or 0 if there is too little in all.
  // The words of the last of them blend to 0; without any all are 0.
  int detail_levels = 1;
  float scale = 1.0f;
  LargeArray<PackedWord> words;
  std::vector<std::uint32_t> level_offset;  // first word of each level
  // Variance of a and b together that bilinear samples of each level lack of level 0's texels, >=
  // 0: feeds the roughness of water.
  std::vector<float> lost_variance;
  // What building needs, kept so that a frame allocates nothing: coarser levels, and sums of rows.
  LargeArray<float> scratch;
  std::vector<PackedRowSums> scratch_sums;

  auto fields() {
    return std::tie(size, levels, detail_levels, scale, words, level_offset, lost_variance);
  }
};

inline constexpr int kMostDetailLevels = 7;

// Builds `map` from size x size samples of each channel (row-major, sample (i, j) at texel centre
// u = i / size: texel centres lie on the lattice, not at +0.5). Mip levels by the tent filter
// [1 2 1]/4 along each axis, centred on every second sample: it keeps the mean, and all levels
// agree on positions (a 2 x 2 box would shift each level by half a texel). scale = max |value| /
// 127 (1 if all are 0), or `fixed_scale` if positive (values are clamped). Bytes are rounded to
// nearest even. Values must be finite. A level whose mean square, of a and b together, is below
// `least_variance` has no detail, and no coarser one has. Keeps capacity; allocates nothing when
// sizes repeat. Rows are shared by the threads of `workers`, if given: for maps that are made once,
// which then keep no scratch memory. The same bits with any number of them and on every SIMD
// target.
void pack_map2(int size, std::span<const float> a, std::span<const float> b, float fixed_scale,
               PackedMap2& map, float least_variance = 0.0f, Workers* workers = nullptr);

// A periodic map of one channel in [-1, 1] with mip levels, laid out as PackedMap2's, but that a
// word holds a texel's quad and nothing else: 127 times the values from the low byte up, v(i,j)
// v(i+1,j) v(i,j+1) v(i+1,j+1). For what changes every frame and is looked up on one level: a
// quarter of the memory.
struct PackedMap1 {
  int size = 0;    // power of two, [1, kMostPackedSize]
  int levels = 0;  // log2(size) + 1
  LargeArray<std::uint32_t> words;
  LargeArray<float> scratch;  // coarser levels

  auto fields() { return std::tie(size, levels, words); }
};

// Builds `map` from size x size values, which are clamped, as pack_map2 builds its maps.
void pack_map1(int size, std::span<const float> values, PackedMap1& map,
               Workers* workers = nullptr);

// An RGBA image for lookups at continuous window positions: 8 bits a channel, one texel of
// padding right and below so that a bilinear sample is two 64-bit loads (texels x, x+1 of rows y,
// y+1). Texel (x, y)'s centre lies at (x + 0.5, y + 0.5). Lookups clamp to the image.
//
// It may have softer levels besides: each texel of level l is the mean of a block of
// 2^max(l - 1, 0) x 2^l texels, so that levels blur twice as far up and down as to the sides, or
// the other way round.
inline constexpr int kMostRgbaLevels = 5;
enum class BlurAxis : std::uint8_t { kX, kY };  // along which levels blur twice as far
struct RgbaImage {
  int width = 0, height = 0;
  int stride = 0;                     // in texels, >= width + 1; rows 0 .. height
  std::vector<std::uint32_t> texels;  // R in the low byte; level after level
  int levels = 1;
  BlurAxis blur_axis = BlurAxis::kY;
  // By level; as long as a vector.
  alignas(64) std::array<std::int32_t, 16> level_begin{}, level_stride{};
  alignas(64) std::array<float, 16> last_x{}, last_y{}, scale_x{}, scale_y{};

  auto fields() {
    return std::tie(width, height, stride, texels, levels, blur_axis, level_begin, level_stride,
                    last_x, last_y, scale_x, scale_y);
  }
};

// Sizes the image [1, 16384] squared and zeroes it. levels: [1, kMostRgbaLevels].
void resize_image(int width, int height, RgbaImage& image, int levels = 1,
                  BlurAxis blur_axis = BlurAxis::kY);

// Copies the last column and row of all levels into the padding; call after texels have been
// written.
void fill_padding(RgbaImage& image);

// Makes the softer levels of the texels in [x0, x1) x [y0, y1), which are whole blocks of the
// softest level or end with the image. Different blocks may be made by different threads.
void soften_block(int x0, int y0, int x1, int y1, RgbaImage& image);

// A square image of three channels, for lookups at continuous positions that cost one load: a word
// holds the 2 x 2 neighbourhood of a texel, as PackedQuad does, of red, green and blue, each byte
// less 128. Texel (x, y) is word y * size + x; beyond the last row and column they repeat.
struct alignas(16) RgbWord {
  std::array<std::int8_t, 16> bytes;
  static constexpr bool kPlainBytes = true;
  bool operator==(const RgbWord&) const = default;
};
struct RgbMap {
  int size = 0;  // power of two, [1, 4096]
  std::vector<RgbWord> words;

  auto fields() { return std::tie(size, words); }
};

// The red, green and blue of a square image whose size is a power of two. `map` keeps its capacity.
void pack_rgb(const RgbaImage& image, RgbMap& map);
RgbMap pack_rgb(const RgbaImage& image);

}  // namespace swell::texture
