#include "render/tile/shading.h"

#include <algorithm>

#include "render/tile/inputs.h"
#include "render/view/render_view.h"

namespace swell::render {

void fill_shading(const MaterialInputs& in, const RenderView& view, int tile_size_px,
                  Shading& shading) {
  shading.kind = view.kind;
  shading.viewport = view.viewport();
  shading.grid = raster::tile_grid(shading.viewport, tile_size_px);
  shading.rays = make_rays(view.camera);
  shading.rays.drop_per_m2 = view.drop_per_m2;
  const bool is_window = view.kind == ViewKind::kWindow;
  shading.level_rel_m = (is_window ? in.media.water_level_m : view.level_m) - shading.rays.eye_z;
  shading.light = in.light;
  shading.light.stars.pixel_angle = shading.light.calm.pixel_angle = shading.rays.pixel_angle;
  shading.media = in.media;
  fill_sun_shadow(in, view, shading.grid, shading.sun_shadow);
  shading.caustics = make_caustics(in, glm::dvec2(view.camera.eye_world));
  if (view.kind == ViewKind::kRefraction && shading.caustics.patches > 0)
    shading.caustics.blur = make_refraction_blur(in, view.camera);
  // The sea's long waves do not come into lakes.
  if (in.media.water_level_m != 0.0f)
    shading.caustics.patches = std::min<std::size_t>(shading.caustics.patches, 1);
  shading.shafts = make_shafts(in, view, shading.rays, shading.sun_shadow.entry);
  shading.exposure = in.light.exposure;
  shading.primitives = view.primitives;
}

}  // namespace swell::render
