// What shading a tile works with: a thread's memory.
#pragma once

#include <array>
#include <cstdint>

#include "render/tile/edges.h"
#include "render/tile/shafts.h"
#include "render/view/surfaces.h"

namespace swell::render {

inline constexpr int kMaxTilePixels = 64 * 64;

inline constexpr std::size_t kMaxTileFragments = kMaxFragments * kMaxTilePixels;
inline constexpr std::size_t kListPadding = 64;  // a list's end, up to whole packets

// The sky over a tile at every fourth pixel and one more, of every fourth row and one more and of
// each row, in rows that end with what fills whole vectors. `air` holds fog before the sky, and
// once that is drawn, the same of the air before surfaces.
struct SkyNodes {
  static constexpr std::size_t kStride = 32, kViewChannels = 9, kNoiseChannels = 3,
                               kAirChannels = 7;
  alignas(64) std::array<std::array<float, kStride * 17>, kViewChannels> view{};
  alignas(64) std::array<std::array<float, kStride * 64>, kNoiseChannels> noise{};
  alignas(64) std::array<std::array<float, kStride * 17>, kAirChannels> air{};
};

// A pixel's light, and how bright that is as shown, of 255.
struct alignas(16) PixelLight {
  float red = 0.0f, green = 0.0f, blue = 0.0f, brightness = 0.0f;
};

// Working memory of one thread.
struct ShadeScratch {
  alignas(64) std::array<float, kMaxTilePixels + kListPadding> red, green, blue;
  // Surfaces where shading is adaptive: pixels far apart are written and read one by one.
  alignas(64) std::array<PixelLight, kMaxTilePixels + kListPadding> pixels{};
  alignas(64) std::array<float, kMaxTilePixels + kListPadding> brightness{};  // of `pixels`
  SkyNodes sky;
  ShaftNodes shafts;
  // By material, of which each kind of surface has one at most, and the sky last: its pixels,
  // padded to whole packets.
  alignas(64)
      std::array<std::array<std::uint16_t, kMaxTilePixels + kListPadding>, kSurfaceKinds + 1> lists;
  // The tile's fragments: their primitives, their colours, and again lists.
  std::array<std::uint32_t, kMaxTileFragments> fragment_primitive;
  alignas(64) std::array<float, kMaxTileFragments + kListPadding> fragment_red, fragment_green,
      fragment_blue;
  std::array<std::uint16_t, kMaxTileFragments + kListPadding> fragment_list;
};

}  // namespace swell::render
