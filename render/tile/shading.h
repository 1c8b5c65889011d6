// Everything that the shading of a view reads, besides the tile's own pixels: rays, light, media
// and the materials' constants.
#pragma once

#include <glm/glm.hpp>

#include "raster/pass.h"
#include "render/materials/caustics.h"
#include "render/materials/light.h"
#include "render/materials/list.h"
#include "render/tile/cloud_picture.h"
#include "render/tile/shafts.h"
#include "render/tile/sun_shadow.h"
#include "render/view/render_view.h"

namespace swell::render {

// Where pixels lie in the world, relative to the eye:
// p_rel = depth (ray + x_px ray_dx + y_px ray_dy), depth = near_m / z.
struct ViewRays {
  glm::vec3 ray{0.0f}, ray_dx{0.0f}, ray_dy{0.0f};
  float near_m = 0.25f;
  float eye_z = 0.0f;
  float pixel_angle = 0.001f;  // size of a pixel at depth 1
  float drop_per_m2 = 0.0f;    // how far a round earth sinks (math/earth.h)
};

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
  const CloudPicture* clouds = nullptr;  // volumetric ones, before all pixels; none: no such
  float exposure = 1.0f;
  PrimitiveRanges primitives;
  Materials materials;

  template <class M>
  const M& material() const {
    return std::get<M>(materials);
  }
};

ViewRays make_rays(const View& camera);

// in.light and in.media are copied.
void fill_shading(const MaterialInputs& in, const RenderView& view, int tile_size_px,
                  Shading& shading);

}  // namespace swell::render
