// Land found by a ray a pixel: a source of visibility that is not triangles.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "raster/pass.h"
#include "raster/samples.h"
#include "render/view/render_view.h"

namespace swell::render {

// The height over the mean level of the point that a view shows at t on a ray: z + z_t t + z_tt
// t^2, for t in [begin, end). Every view shows a point at its true place in the plane.
struct LandPath {
  float z = 0.0f, z_t = 0.0f, z_tt = 0.0f;
  float begin = 1.0f, end = 0.0f;  // as it stands: none
};

// Of the ray with this direction, relative to the eye, whose depth grows by 1 per t. A mirrored ray
// goes up from where it meets the level, a refracted one on from there by Snell's law, as straight
// as the other.
LandPath land_path(const RenderView& view, glm::vec3 direction);

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
