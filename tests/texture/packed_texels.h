// Random packed maps, and what their texels hold.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "texture/on_every_target.h"
#include "texture/packed_map.h"

namespace swell::texture {

inline PackedMap2 random_map(int size, std::uint64_t seed) {
  const std::size_t texels = static_cast<std::size_t>(size) * size;
  PackedMap2 map;
  pack_map2(size, random_floats(texels, -3.0, 3.0, seed),
            random_floats(texels, -1.0, 2.0, seed + 1), 0.0f, map);
  return map;
}

inline int wrap(int i, int size) { return ((i % size) + size) % size; }

inline const PackedWord& word_at(const PackedMap2& map, int level, int i, int j) {
  const int size = map.size >> level;
  return map.words[map.level_offset[level] + static_cast<std::size_t>(wrap(j, size)) * size +
                   wrap(i, size)];
}

// Texel (i, j) of a level, from the low bytes of its own quad.
inline std::array<int, 2> texel(const PackedMap2& map, int level, int i, int j) {
  const PackedQuad quad = word_at(map, level, i, j).fine;
  return {static_cast<std::int8_t>(quad & 0xff), static_cast<std::int8_t>(quad >> 32 & 0xff)};
}

}  // namespace swell::texture
