#include "texture/cover_map.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "math/check.h"
#include "math/for_each_row.h"
#include "math/large_array.h"

namespace swell::texture {
namespace {

std::size_t texel(int size, int i, int j) {
  return static_cast<std::size_t>(j & (size - 1)) * size + static_cast<std::size_t>(i & (size - 1));
}

// Half as many texels a side.
LargeArray<glm::vec4> filter_down(int size, std::span<const glm::vec4> fine, Workers& workers) {
  const int half = size / 2;
  auto coarse = make_large<glm::vec4>(fine.size() / 4);
  for_each_piece(half, workers, [&](int first, int end) {
    std::vector<glm::vec4> row(static_cast<std::size_t>(size));
    for (int j = first; j < end; ++j) {
      check_stop();
      for (int i = 0; i < size; ++i)
        row[static_cast<std::size_t>(i)] =
            0.25f * (fine[texel(size, i, 2 * j - 1)] + fine[texel(size, i, 2 * j + 1)]) +
            0.5f * fine[texel(size, i, 2 * j)];
      for (int i = 0; i < half; ++i)
        coarse[texel(half, i, j)] =
            0.25f * (row[texel(size, 2 * i - 1, 0)] + row[texel(size, 2 * i + 1, 0)]) +
            0.5f * row[texel(size, 2 * i, 0)];
    }
  });
  return coarse;
}

using Code = std::array<std::int8_t, 4>;

Code code_of(const glm::vec4& value) {
  Code code;
  for (int channel = 0; channel < 4; ++channel)
    code[static_cast<std::size_t>(channel)] =
        static_cast<std::int8_t>(std::lrint(254.0f * std::clamp(value[channel], 0.0f, 1.0f)) - 127);
  return code;
}

void pack_level(int size, std::span<const glm::vec4> values, CoverWord* words, Workers& workers) {
  for_each_piece(size, workers, [&](int first, int end) {
    const auto code_row = [&](int j) {
      const auto row = values.subspan(texel(size, 0, j), static_cast<std::size_t>(size));
      std::vector<Code> codes(row.size());
      std::ranges::transform(row, codes.begin(), code_of);
      return codes;
    };
    std::vector<Code> upper, lower = code_row(first);
    for (int j = first; j < end; ++j) {
      check_stop();
      upper = std::move(lower);
      lower = code_row(j + 1);
      for (int i = 0; i < size; ++i) {
        const std::size_t here = texel(size, i, 0), beside = texel(size, i + 1, 0);
        const std::array<Code, 4> taps = {upper[here], upper[beside], lower[here], lower[beside]};
        CoverWord& word = words[texel(size, i, j)];
        for (std::size_t n = 0; n < 16; ++n) word.bytes[n] = taps[n % 4][n / 4];
      }
    }
  });
}

}  // namespace

CoverMap pack_cover(int size, std::span<const glm::vec4> values, Workers& workers) {
  SWELL_CHECK(size >= 1 && size <= 4096 && std::has_single_bit(static_cast<unsigned>(size)) &&
                  values.size() == static_cast<std::size_t>(size) * size,
              "size={} values={}", size, values.size());
  CoverMap map;
  map.size = size;
  map.levels = std::bit_width(static_cast<unsigned>(size));
  resize_large(map.words, 2 * static_cast<std::size_t>(size) * size);
  LargeArray<glm::vec4> level;
  for (int side = size;; side /= 2) {
    pack_level(side, values, map.words.data() + static_cast<std::size_t>(side) * side, workers);
    if (side == 1) return map;
    level = filter_down(side, values, workers);
    values = level;
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
