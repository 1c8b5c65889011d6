// The materials: two lines each, which the build reads, too. Each is a translation unit that shades
// whole lists of pixels, so that a pixel costs no call. A surface whose material is not in the list
// is not drawn.
//
// A material M is a plain struct with
//   static constexpr SurfaceKind kSurface;                    // whose triangles it shades
//   void fill(const MaterialInputs&, const RenderView&, M&);  // its constants, once a view
// and, in its m-inl.h, the per-pixel code that tile/shading_result-inl.h describes. One whose kind
// of surface is its own also places its triangles, once a frame:
//   static void place(const PlaceInputs&, PlacedSurface&);
#pragma once

#include <span>
#include <tuple>

#include "render/materials/object.h"
#include "render/materials/river.h"
#include "render/materials/terrain.h"
#include "render/materials/tree.h"
#include "render/tile/shading.h"
#include "render/water/water.h"

namespace swell::render {

struct Meshes;
struct RenderView;

// The first one's pixels are found fastest.
using Materials = std::tuple<  //
    Water,                     //
    Terrain,                   //
    Object,                    //
    Tree,                      //
    River                      //
    >;

inline constexpr std::size_t kMaterialCount = std::tuple_size_v<Materials>;

// The shading of a view.
struct ViewShading : Shading {
  Materials materials;
};

template <class M>
const M& Shading::material() const {
  return std::get<M>(static_cast<const ViewShading&>(*this).materials);
}

// in.light and in.media are copied.
void fill_shading(const MaterialInputs& in, const RenderView& view, int tile_size_px,
                  ViewShading& shading);

// Stage 3: which kinds of surface have a material, the triangles that materials place themselves,
// and their vertices in the views.
void place_surfaces(const PlaceInputs& in, Meshes& meshes, std::span<RenderView* const> views);

}  // namespace swell::render
