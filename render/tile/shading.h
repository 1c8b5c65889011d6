// Everything that the shading of a view reads, besides the tile's own pixels and the materials'
// constants: rays, light, media.
#pragma once

#include <glm/glm.hpp>

#include "raster/pass.h"
#include "render/packets/view_rays.h"
#include "render/sky/light.h"
#include "render/tile/caustics.h"
#include "render/tile/shafts.h"
#include "render/tile/sun_shadow.h"
#include "render/view/surfaces.h"

namespace swell::render {

struct CloudPicture;
struct MaterialInputs;
struct RenderView;
struct StoredFog;

struct Shading {
  ViewKind kind = ViewKind::kWindow;
  raster::Viewport viewport;
  raster::TileGrid grid;
  ViewRays rays;
  float level_rel_m = 0.0f;  // of the water that mirrors or refracts, over the eye
  Light light;
  Media media;
  SunShadow sun_shadow;
  Caustics caustics;
  Shafts shafts;
  const CloudPicture* clouds = nullptr;   // volumetric ones, before all pixels; none: no such
  const StoredFog* stored_fog = nullptr;  // that pixels take theirs from; none: each finds its own
  float exposure = 1.0f;
  bool is_adaptive = false;  // shades pixels where the picture needs them (shade/adaptive-inl.h)
  PrimitiveRanges primitives;

  // The constants of a material: each Shading is part of a ViewShading. Defined in
  // materials/list.h, which includes all of them.
  template <class M>
  const M& material() const;
};

// All but the materials. in.light and in.media are copied.
void fill_shading(const MaterialInputs& in, const RenderView& view, int tile_size_px,
                  Shading& shading);

// What water in a tile can see in the planar maps.
struct TilePlanarMaps {
  bool reflection = false, refraction = false;
};

}  // namespace swell::render
