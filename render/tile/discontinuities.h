// Where a tile's pixel centres show that surfaces meet: another kind of surface next door, or a
// depth discontinuity.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "raster/pass.h"
#include "raster/samples.h"
#include "render/view/surfaces.h"

namespace swell::render {

struct RenderView;
struct VisibilityBuffer;

// A tile's depth with a rim of its neighbours'. Beyond the picture the nearest pixel goes on.
struct DiscontinuityScratch {
  static constexpr int kSide = raster::PixelMask::kMaxRows, kRim = 2;
  static constexpr int kStride = 80;  // a row, with room for a whole vector past its end
  alignas(64) std::array<float, kStride*(kSide + 2 * kRim + 1)> depth{};
};

// A surface has a discontinuity where its depth changes by more than this part; and samples of one
// surface whose depths differ by more are of two places of it: a crest and farther water.
inline constexpr float kPartOfDiscontinuity = 0.3f;

// Marks both pixels of each such pair, so far as they lie in the tile. Kinds of surfaces are those
// of SurfaceTraits::edges_as. `visibility` is that of the whole window, so that the result does not
// depend on the size of tiles.
void mark_discontinuities(const VisibilityBuffer& visibility, const RenderView& window, int tile,
                          DiscontinuityScratch& scratch, raster::PixelMask& mask);

// The tile's pixels that show, or one of whose four neighbours shows, nothing nearer than depth z
// (of the visibility buffer): where something at z may be seen. `scratch` is as
// mark_discontinuities left it.
raster::PixelMask find_behind(const DiscontinuityScratch& scratch, int side, float z);

// The tile's pixels that show, like their four neighbours, primitives in [begin, end).
raster::PixelMask find_interior(const VisibilityBuffer& visibility, raster::Viewport viewport,
                                int tile, std::uint32_t begin, std::uint32_t end);

}  // namespace swell::render
