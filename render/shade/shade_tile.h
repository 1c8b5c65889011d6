// Shading: every visible pixel once, in full SIMD packets, material by material. Everything a
// pixel needs follows from its position in the window, its depth and its material, so that no
// per-triangle data is fetched (but for objects); slopes come from maps at the pixel's own place in
// the world.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "render/labels/shaded_labels.h"
#include "render/tile/scratch.h"
#include "render/tile/shaded_pixels.h"
#include "render/tile/shading.h"

namespace swell::render {

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
// `labels`, if any, gets what shading knows of the surface pixels' centres. Returns the numbers of
// surface (not sky) pixels, fragments left out.
ShadedPixels shade_tile(const Shading& shading, const TileInput& input, ShadeScratch& scratch,
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
