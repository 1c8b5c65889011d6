// Shading: every visible pixel once, in full SIMD packets, material by material. Everything a
// pixel needs follows from its position in the window, its depth and its material, so that no
// per-triangle data is fetched (but for objects); slopes come from maps at the pixel's own place in
// the world.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "render/labels/shaded_labels.h"
#include "render/tile/edges.h"
#include "render/tile/shading.h"

namespace swell::render {

inline constexpr int kMaxTilePixels = 64 * 64;
static_assert(ShadedLabels::kMostPixels == kMaxTilePixels);

// What water in a tile can see in the planar maps.
struct TilePlanarMaps {
  bool reflection = false, refraction = false;
};

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

// Working memory of one thread.
struct ShadeScratch {
  alignas(64) std::array<float, kMaxTilePixels> red, green, blue;
  SkyNodes sky;
  ShaftNodes shafts;
  // By material, and the sky last: its pixels, padded to whole packets.
  alignas(64) std::array<std::array<std::uint16_t, kMaxTilePixels + kListPadding>,
                         kMaterialCount + 1> lists;
  // The tile's fragments: their primitives, their colours, and again lists.
  std::array<std::uint32_t, kMaxTileFragments> fragment_primitive;
  alignas(64) std::array<float, kMaxTileFragments + kListPadding> fragment_red, fragment_green,
      fragment_blue;
  std::array<std::uint16_t, kMaxTileFragments + kListPadding> fragment_list;
};

// A tile as the window sees it.
struct TileInput {
  int tile = 0;
  std::span<const float> depth;  // its visibility buffer
  std::span<const std::uint32_t> primitive;
  std::span<const EdgeFragment> fragments = {};
  TilePlanarMaps planar_maps = {};
};

// Shades all pixels of a tile that lie in the window and writes their 8-bit sRGB values to `rgba`
// (the whole picture) and, unless empty, linear light to `linear` (RGB). Fragments that their
// pixels' centres do not show are shaded too and mixed by their samples: as light of the display,
// after the tone curve, so that a glint counts for no more than white; linear light as it is.
// `labels`, if any, gets what shading knows of the surface pixels' centres. Returns the number of
// surface (not sky) pixels shaded, fragments left out.
int shade_tile(const Shading& shading, const TileInput& input, ShadeScratch& scratch,
               std::span<std::uint32_t> rgba, std::span<float> linear,
               ShadedLabels* labels = nullptr);

// Shades a tile of open sky as shade_tile() does, without a visibility buffer.
void shade_sky_tile(const Shading& shading, int tile, ShadeScratch& scratch,
                    std::span<std::uint32_t> rgba, std::span<float> linear);

// Shades a tile of a reflection or refraction image: land and objects get their encoded radiance
// and alpha 255, the others 0.
void shade_planar_tile(const Shading& shading, int tile, std::span<const float> depth,
                       std::span<const std::uint32_t> primitive, ShadeScratch& scratch,
                       texture::RgbaImage& image);

}  // namespace swell::render
