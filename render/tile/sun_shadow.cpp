#include "render/tile/sun_shadow.h"

#include "render/view/object_shadows.h"

namespace swell::render {

void fill_sun_shadow(const MaterialInputs& in, const RenderView& view, const raster::TileGrid& grid,
                     SunShadow& shadow) {
  shadow.land = nullptr;
  shadow.objects = &in.objects.shadows;
  shadow.entry = underwater_slant(in.light.sun_direction, in.media.refraction_index);
  list_casters(in.objects.shadows, view, grid, shadow.casters);
  if (in.without.has(Part::kShadows) || !in.world.land_shadow || in.world.land_shadow->is_empty())
    return;
  const LandShadow& land = *in.world.land_shadow;
  shadow.land = &land;
  const double per_m = 1.0 / land.texel_m;
  const glm::dvec2 along = per_m * land.away, across = per_m * land.left();
  const glm::dvec2 from_corner = glm::dvec2(view.camera.eye_world) - land.corner_world;
  shadow.along = glm::vec3(along, glm::dot(from_corner, along));
  shadow.across = glm::vec3(across, glm::dot(from_corner, across));
}

}  // namespace swell::render
