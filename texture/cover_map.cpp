#include "texture/cover_map.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "math/check.h"
#include "math/for_each_row.h"
#include "math/large_array.h"

namespace swell::texture {
namespace {

std::size_t texel(int size, int i, int j) {
  return static_cast<std::size_t>(j & (size - 1)) * size + static_cast<std::size_t>(i & (size - 1));
}

// Half as many texels a side.
std::vector<glm::vec4> filter_down(int size, const std::vector<glm::vec4>& fine, Workers& workers) {
  const int half = size / 2;
  auto rows = make_large<glm::vec4>(fine.size() / 2),
       coarse = make_large<glm::vec4>(fine.size() / 4);
  for_each_row(half, workers, [&](int j) {
    for (int i = 0; i < size; ++i)
      rows[texel(size, i, 0) + static_cast<std::size_t>(j) * size] =
          0.25f * (fine[texel(size, i, 2 * j - 1)] + fine[texel(size, i, 2 * j + 1)]) +
          0.5f * fine[texel(size, i, 2 * j)];
  });
  for_each_row(half, workers, [&](int j) {
    const glm::vec4* const row = rows.data() + static_cast<std::size_t>(j) * size;
    for (int i = 0; i < half; ++i)
      coarse[texel(half, i, j)] =
          0.25f * (row[texel(size, 2 * i - 1, 0)] + row[2 * i + 1]) + 0.5f * row[2 * i];
  });
  return coarse;
}

void pack_level(int size, const std::vector<glm::vec4>& values, CoverWord* words,
                Workers& workers) {
  auto code = make_large<std::array<std::int8_t, 4>>(values.size());
  for_each_row(size, workers, [&](int j) {
    for (std::size_t k = texel(size, 0, j); k < texel(size, 0, j) + static_cast<std::size_t>(size);
         ++k)
      for (int channel = 0; channel < 4; ++channel)
        code[k][static_cast<std::size_t>(channel)] = static_cast<std::int8_t>(
            std::lrint(254.0f * std::clamp(values[k][channel], 0.0f, 1.0f)) - 127);
  });
  for_each_row(size, workers, [&](int j) {
    for (int i = 0; i < size; ++i) {
      const std::array<std::size_t, 4> taps = {texel(size, i, j), texel(size, i + 1, j),
                                               texel(size, i, j + 1), texel(size, i + 1, j + 1)};
      CoverWord& word = words[texel(size, i, j)];
      for (std::size_t n = 0; n < 16; ++n) word.bytes[n] = code[taps[n % 4]][n / 4];
    }
  });
}

}  // namespace

CoverMap pack_cover(int size, std::vector<glm::vec4> values, Workers& workers) {
  SWELL_CHECK(size >= 1 && size <= 4096 && std::has_single_bit(static_cast<unsigned>(size)) &&
                  values.size() == static_cast<std::size_t>(size) * size,
              "size={} values={}", size, values.size());
  CoverMap map;
  map.size = size;
  map.levels = std::bit_width(static_cast<unsigned>(size));
  resize_large(map.words, 2 * static_cast<std::size_t>(size) * size);
  for (int side = size;; side /= 2) {
    pack_level(side, values, map.words.data() + static_cast<std::size_t>(side) * side, workers);
    if (side == 1) return map;
    values = filter_down(side, values, workers);
  }
}

glm::vec4 cover_at(const CoverMap& map, glm::dvec2 place) {
  const glm::dvec2 corner = glm::floor(place);
  const glm::vec2 part(place - corner);
  const auto bytes =
      map.words[static_cast<std::size_t>(map.size) * map.size +
                texel(map.size, static_cast<int>(corner.x), static_cast<int>(corner.y))]
          .bytes;
  glm::vec4 channels;
  for (int n = 0; n < 4; ++n) {
    const std::int8_t* const taps = &bytes[4 * static_cast<std::size_t>(n)];
    const auto tap = [&](int k) { return static_cast<float>(taps[k]); };
    const float code =
        glm::mix(glm::mix(tap(0), tap(1), part.x), glm::mix(tap(2), tap(3), part.x), part.y);
    channels[n] = (code + 127.0f) * (1.0f / 254.0f);
  }
  return channels;
}

}  // namespace swell::texture
