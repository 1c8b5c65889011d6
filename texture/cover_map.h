// A periodic map of four channels in [0, 1] with mip levels, laid out so that a bilinear sample of
// all four is one load of 128 bits: which materials cover a place.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <tuple>

#include "math/large_array.h"

namespace swell {
class Workers;
}

namespace swell::texture {

// The 2 x 2 neighbourhood of a texel, channel after channel: (i,j) (i+1,j) (i,j+1) (i+1,j+1), each
// 254 times the value less 127.
struct alignas(16) CoverWord {
  std::array<std::int8_t, 16> bytes;
  static constexpr bool kPlainBytes = true;
  bool operator==(const CoverWord&) const = default;
};

// Level l is (size >> l) squared, down to 1 x 1; a level of side s begins at word s * s.
struct CoverMap {
  int size = 0;    // power of two, [1, 4096]
  int levels = 0;  // log2(size) + 1
  LargeArray<CoverWord> words;

  auto fields() { return std::tie(size, levels, words); }
};

// From size x size values, row-major; sample (i, j) lies on the lattice at u = i / size. Values are
// clamped. Mip levels by the tent filter [1 2 1]/4 along each axis, as pack_map2's: they keep the
// mean.
CoverMap pack_cover(int size, std::span<const glm::vec4> values, Workers& workers);

// The four channels at a place in texels of the finest level, bilinearly; finite, within 1e9. The
// map repeats.
glm::vec4 cover_at(const CoverMap& map, glm::dvec2 place);

}  // namespace swell::texture
