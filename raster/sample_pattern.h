// Where the samples of a pixel lie: the standard positions of the Vulkan specification, multiples
// of 1/16 px, so exact in snapped window coordinates. Without samples a pixel's centre stands
// alone.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace swell::raster {

inline constexpr int kMaxSamples = 8;

struct SamplePosition {
  std::int32_t x_fx8, y_fx8;  // from the pixel's upper left corner, in (0, 256)
};

inline constexpr std::array<SamplePosition, 1> kCentrePosition = {{{128, 128}}};
inline constexpr std::array<SamplePosition, 4> kPositionsOf4 = {
    {{6 * 16, 2 * 16}, {14 * 16, 6 * 16}, {2 * 16, 10 * 16}, {10 * 16, 14 * 16}}};
inline constexpr std::array<SamplePosition, 8> kPositionsOf8 = {{{9 * 16, 5 * 16},
                                                                 {7 * 16, 11 * 16},
                                                                 {13 * 16, 9 * 16},
                                                                 {5 * 16, 3 * 16},
                                                                 {3 * 16, 13 * 16},
                                                                 {1 * 16, 7 * 16},
                                                                 {11 * 16, 15 * 16},
                                                                 {15 * 16, 1 * 16}}};

// True for the numbers of samples a pass can have: 0 (the centre only), 4 and 8.
constexpr bool is_sample_count(int samples) { return samples == 0 || samples == 4 || samples == 8; }

// The positions of a pass with `samples` of them; for 0 the centre.
constexpr std::span<const SamplePosition> sample_positions(int samples) {
  if (samples == 4) return kPositionsOf4;
  if (samples == 8) return kPositionsOf8;
  return kCentrePosition;
}

// Positions lie on lines of their own in x and in y, this far apart; the first at half of it.
constexpr std::int32_t sample_spacing_fx8(int samples) {
  return samples == 0 ? 256 : 256 / samples;
}

// The square that holds all of a pixel's positions, the same in x and in y: [low, high].
struct SampleExtent {
  std::int32_t low_fx8, high_fx8;
};

constexpr SampleExtent extent_of(std::span<const SamplePosition> positions) {
  SampleExtent extent{256, 0};
  for (const SamplePosition& p : positions) {
    extent.low_fx8 = std::min({extent.low_fx8, p.x_fx8, p.y_fx8});
    extent.high_fx8 = std::max({extent.high_fx8, p.x_fx8, p.y_fx8});
  }
  return extent;
}

// Returns the extent of the positions of a pass with `samples` of them.
constexpr SampleExtent sample_extent(int samples) {
  constexpr SampleExtent kCentre = extent_of(kCentrePosition);
  constexpr SampleExtent kOf4 = extent_of(kPositionsOf4), kOf8 = extent_of(kPositionsOf8);
  return samples == 4 ? kOf4 : samples == 8 ? kOf8 : kCentre;
}

}  // namespace swell::raster
