// Shading: every visible pixel once, in full SIMD packets, material by material. Everything a
// pixel needs follows from its position in the window, its depth and its material, so that no
// per-triangle data is fetched (but for objects); slopes come from maps at the pixel's own place in
// the world.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "render/labels/shaded_labels.h"
#include "render/tile/shading.h"

namespace swell::render {

inline constexpr int kMaxTilePixels = 64 * 64;
static_assert(ShadedLabels::kMostPixels == kMaxTilePixels);

// What water in a tile can see in the lookup images.
struct TileLookups {
  bool reflection = false, refraction = false;
};

// Working memory of one thread.
struct ShadeScratch {
  alignas(64) std::array<float, kMaxTilePixels> red, green, blue;
  // By material, and the sky last: its pixels, padded to whole packets.
  alignas(64) std::array<std::array<std::uint16_t, kMaxTilePixels + 64>, kMaterialCount + 1> lists;
};

// Shades all pixels of a tile that lie in the window and writes their 8-bit sRGB values to `rgba`
// (the whole picture) and, unless empty, linear light to `linear` (RGB). `depth` and `primitive`
// are the tile's visibility buffer. `labels`, if any, gets what shading knows of the surface
// pixels. Returns the number of surface (not sky) pixels shaded.
int shade_tile(const Shading& shading, int tile, std::span<const float> depth,
               std::span<const std::uint32_t> primitive, TileLookups lookups, ShadeScratch& scratch,
               std::span<std::uint32_t> rgba, std::span<float> linear,
               ShadedLabels* labels = nullptr);

// The same for a tile of open sky, without a visibility buffer.
void shade_sky_tile(const Shading& shading, int tile, ShadeScratch& scratch,
                    std::span<std::uint32_t> rgba, std::span<float> linear);

// Shades a tile of a reflection or refraction image: land and objects get their encoded radiance
// and alpha 255, the others 0.
void shade_lookup_tile(const Shading& shading, int tile, std::span<const float> depth,
                       std::span<const std::uint32_t> primitive, ShadeScratch& scratch,
                       texture::RgbaImage& image);

}  // namespace swell::render
