#include "lod/height_pyramid.h"

#include <bit>

#include "math/check.h"

namespace swell::lod {
namespace {

constexpr int kMaxBits = 12;

std::size_t level_begin(int level) { return ((std::size_t{1} << 2 * level) - 1) / 3; }

std::size_t square(int level, int x, int y) {
  return level_begin(level) + (static_cast<std::size_t>(y) << level) + static_cast<std::size_t>(x);
}

// All levels but the finest, from below.
void fill_coarser(HeightPyramid& pyramid) {
  for (int level = pyramid.bits - 1; level >= 0; --level) {
    const int side = 1 << level;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const HeightRange* south = &pyramid.range[square(level + 1, 2 * x, 2 * y)];
        const HeightRange* north = &pyramid.range[square(level + 1, 2 * x, 2 * y + 1)];
        pyramid.range[square(level, x, y)] =
            join(join(south[0], south[1]), join(north[0], north[1]));
      }
    }
  }
}

}  // namespace

HeightPyramid make_height_pyramid(int bits, std::span<const HeightRange> finest) {
  SWELL_CHECK(bits >= 0 && bits <= kMaxBits, "bits={}", bits);
  SWELL_CHECK(finest.size() == std::size_t{1} << 2 * bits, "bits={}, {} squares", bits,
              finest.size());
  HeightPyramid pyramid;
  pyramid.bits = bits;
  pyramid.range.resize(level_begin(bits + 1));
  std::copy(finest.begin(), finest.end(),
            pyramid.range.begin() + static_cast<std::ptrdiff_t>(level_begin(bits)));
  fill_coarser(pyramid);
  return pyramid;
}

HeightPyramid make_height_pyramid(int bits, std::span<const float> height_m, int samples) {
  SWELL_CHECK(bits >= 0 && bits <= kMaxBits, "bits={}", bits);
  const auto n = static_cast<std::size_t>(samples);
  SWELL_CHECK(samples >= 2 && height_m.size() == n * n, "samples={}, {} heights", samples,
              height_m.size());
  // A square takes all samples in it and the next one outside each side.
  const std::int64_t side = std::int64_t{1} << bits, cells = samples - 1;
  const auto first = [&](std::int64_t k) { return static_cast<std::size_t>(k * cells / side); };
  const auto last = [&](std::int64_t k) {
    return static_cast<std::size_t>(((k + 1) * cells + side - 1) / side);
  };
  std::vector<HeightRange> finest;
  finest.reserve(std::size_t{1} << 2 * bits);
  for (std::int64_t y = 0; y < side; ++y) {
    for (std::int64_t x = 0; x < side; ++x) {
      const float start = height_m[first(y) * n + first(x)];
      HeightRange range{start, start};
      for (std::size_t j = first(y); j <= last(y); ++j)
        for (std::size_t i = first(x); i <= last(x); ++i)
          range = join(range, {height_m[j * n + i], height_m[j * n + i]});
      finest.push_back(range);
    }
  }
  return make_height_pyramid(bits, finest);
}

HeightRange height_range(const HeightPyramid& pyramid, int lattice_bits, glm::ivec2 low,
                         glm::ivec2 high) {
  SWELL_DCHECK(low.x < high.x && low.y < high.y, "low=({}, {}) high=({}, {})", low.x, low.y, high.x,
               high.y);
  // The finest level whose squares are as wide as the box: it touches two of them on each axis.
  const auto width = static_cast<unsigned>(std::max(high.x - low.x, high.y - low.y));
  const int width_bits = static_cast<int>(std::bit_width(width - 1));
  const int level = std::clamp(lattice_bits - width_bits, 0, pyramid.bits);
  const int shift = lattice_bits - level;
  const glm::ivec2 first(low.x >> shift, low.y >> shift);
  const glm::ivec2 last((high.x - 1) >> shift, (high.y - 1) >> shift);
  return join(join(pyramid.range[square(level, first.x, first.y)],
                   pyramid.range[square(level, last.x, first.y)]),
              join(pyramid.range[square(level, first.x, last.y)],
                   pyramid.range[square(level, last.x, last.y)]));
}

}  // namespace swell::lod
