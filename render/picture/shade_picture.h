// Stages 6 and 7: the colour of every pixel of the window.
#pragma once

#include <cstdint>
#include <vector>

#include "render/picture/planar_maps.h"
#include "render/tile/shaded_pixels.h"

namespace swell::render {

struct Crossing;
struct EdgeBuffer;
struct LabelSources;
struct StageRun;
struct Target;

// Inputs for the part of a picture that begins in water, where the rest begins in air.
struct WetSide {
  const Crossing& line;
  const Shading& shading;
  const std::vector<TilePlanarMaps>& planar_maps;
  bool meniscus;
};

// What the finished picture is made from.
struct PictureInputs {
  const RenderView& window;
  const VisibilityBuffer& visibility;
  EdgeBuffer& edges;                               // filled tile by tile
  const std::vector<TilePlanarMaps>& planar_maps;  // by tile
  const Shading& shading;
  bool wireframe;
  const LabelSources* labels = nullptr;  // none: no labels
  const WetSide* wet = nullptr;          // none: all of it is as `shading` says
};

// Finds the edges of each tile, shades its visible pixels and resolves them, and fills the labels
// that are asked for. `shaded`: the numbers of surface pixels, by tile. `target` has
// the window's size.
void shade_picture(const PictureInputs& in, ScratchList scratch, std::vector<ShadedPixels>& shaded,
                   Target& target, const StageRun& run);

// Draws triangle edges, tinted by level of detail, over a tile of the finished picture.
void draw_wireframe(const PictureInputs& in, int tile, Target& target);

}  // namespace swell::render
