// Smooth edges: which pixels show more than one surface, and how much of each.
//
// The visibility buffer has one surface a pixel, that of its centre. Where surfaces meet, 4 or 8
// samples of the pixel say how much of it each of them covers; the pixel is then shaded once for
// each, and the colours are mixed by their numbers of samples. Nothing else is mixed: depth, labels
// and the count of visible pixels stay those of the centres.
//
// A pixel is looked at if a neighbour shows another kind of surface (tile/discontinuities.h; small
// trees of a wood and the land between them are one kind), if the depth jumps to a neighbour by
// more than the surfaces' own slope explains, or if a triangle of an object touches it that the
// centres around neither all show nor all hide, so that a mast thinner than a pixel is found.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "raster/samples.h"
#include "render/tile/discontinuities.h"

namespace swell::render {

struct RenderView;
struct VisibilityBuffer;

// A part of a pixel: what some of its samples show.
struct EdgeFragment {
  float x_px, y_px;         // middle of its samples; whole numbers are centres of pixels
  float z;                  // depth there, as in the visibility buffer; 0 in the sky
  std::uint32_t primitive;  // kNoPrimitive in the sky
  std::uint16_t pixel;      // y * tile_size + x in its tile
  std::uint8_t samples;     // of its pixel that show it, at least 1
  bool is_centre;           // the surface that the centre shows, which is shaded anyway
};

inline constexpr std::size_t kMaxFragments = 4;  // a pixel

// In tiles; inclusive.
struct TileBox {
  int x0, y0, x1, y1;
  bool holds(int x, int y) const { return x >= x0 && x <= x1 && y >= y0 && y <= y1; }
};

// Where the triangles of a DrawPart lie in the window.
struct PartExtent {
  TileBox tiles;
  float nearest_z;           // depth of its nearest vertex, as in the visibility buffer
  std::uint32_t begin, end;  // its primitives
};

// The pixels of a frame where surfaces meet.
struct EdgeBuffer {
  int samples = 0;  // a pixel: 0, 4 or 8
  // By tile; a pixel's fragments lie side by side and have all of its samples together.
  std::vector<std::vector<EdgeFragment>> of_tile;
  std::vector<PartExtent> parts;  // of all surfaces
};

// Working memory of one thread.
struct EdgeScratch {
  DiscontinuityScratch discontinuities;
  std::vector<float> depth;  // of samples
  std::vector<std::uint32_t> primitive;
};

// Stage 4, once the window's pass is there: makes room for the edges' fragments, and says where
// parts lie. The window's pass was prepared with `samples`, 4 or 8; with 0 there are none.
void prepare_edges(const RenderView& window, const VisibilityBuffer& visibility, int samples,
                   EdgeBuffer& edges);

// Stage 6, before the tile is shaded and while its visibility comes into cache anyway: finds the
// fragments of its edges. Different tiles may be searched by different threads at one time.
void find_edges(const RenderView& window, const VisibilityBuffer& visibility, int tile,
                EdgeScratch& scratch, EdgeBuffer& edges);

}  // namespace swell::render
