// Stage 4: what is visible in the window.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raster/pass.h"

namespace swell::render {

struct Meshes;
struct RenderView;
struct StageRun;

// Per-tile results, in tile order.
struct VisibilityBuffer {
  raster::TileGrid grid;
  std::vector<float> depth;
  std::vector<std::uint32_t> primitive;
  std::vector<int> covered;  // pixels with a surface; -1: no triangle, buffers unset
  std::vector<int> water_pixels;
  std::vector<std::uint8_t> looks_into;  // LooksInto, of water in pixels' centres or parts of them

  std::size_t tile_pixels() const {
    return static_cast<std::size_t>(grid.tile_size_px) * grid.tile_size_px;
  }
  std::span<float> depth_of(int tile) {
    return {depth.data() + tile * tile_pixels(), tile_pixels()};
  }
  std::span<std::uint32_t> primitive_of(int tile) {
    return {primitive.data() + tile * tile_pixels(), tile_pixels()};
  }
  std::span<const float> depth_of(int tile) const {
    return {depth.data() + tile * tile_pixels(), tile_pixels()};
  }
  std::span<const std::uint32_t> primitive_of(int tile) const {
    return {primitive.data() + tile * tile_pixels(), tile_pixels()};
  }
};

// Prepares the window's pass, with edge_samples (0, 4 or 8) also for samples, and draws its
// triangles into its visibility buffer.
void find_visible(const Meshes& meshes, int tile_size_px, int edge_samples, RenderView& window,
                  VisibilityBuffer& visibility, const StageRun& run);

// Whether the window shows anything by rays: land that is drawn so, or implicit surfaces.
bool has_rays(const RenderView& window);

// Adds what rays of the window meet before its triangles. Only if has_rays(window).
void find_by_rays(const Meshes& meshes, int edge_samples, const RenderView& window,
                  VisibilityBuffer& visibility, const StageRun& run);

}  // namespace swell::render
