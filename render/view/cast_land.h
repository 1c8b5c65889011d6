// Land found by a ray a pixel: a source of visibility that is not triangles.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "raster/pass.h"
#include "raster/samples.h"
#include "render/view/render_view.h"

namespace swell::render {

// Draws the land of `view` into a tile: where it is nearer than what is there. fresh: nothing is,
// and the buffers are unset. Returns the number of pixels that show a surface.
int cast_land(const RenderView& view, const raster::TileGrid& grid, int tile, bool fresh,
              std::span<float> depth, std::span<std::uint32_t> primitive);

// Casts rays at the samples of the marked pixels, and changes what raster::draw_samples() has left
// where the land is nearer. Different tiles may be cast by different threads at one time.
void cast_land_samples(const RenderView& view, const raster::PixelBox& box, int samples,
                       const raster::PixelMask& mask, std::span<float> depth,
                       std::span<std::uint32_t> primitive);

}  // namespace swell::render
