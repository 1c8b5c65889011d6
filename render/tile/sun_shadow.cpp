#include "render/tile/sun_shadow.h"

#include <algorithm>

#include "render/frame/parts.h"
#include "render/shadows/object_shadows.h"
#include "render/sky/light.h"
#include "render/tile/inputs.h"
#include "render/view/objects_drawn.h"
#include "render/view/render_view.h"
#include "render/world/forest.h"
#include "render/world/land_shadow.h"
#include "render/world/world_state.h"
#include "terrain/height_grid.h"

namespace swell::render {
namespace {

void fill_tree_shadow(const MaterialInputs& in, glm::dvec2 eye, SunShadow& shadow) {
  shadow.under_trees = {};
  const bool has_trees = in.world.forest && !in.without.has(Part::kTrees);
  if (!has_trees || in.without.has(Part::kShadows)) return;
  const terrain::Grid& square = in.world.terrain->grid;
  shadow.under_trees =
      make_square_map(in.world.forest->sun_left, square.size_m(), eye - square.min_world);
  const glm::vec2 corner_rel(square.min_world - eye);
  shadow.sea_shade_low = corner_rel + in.world.forest->sea_shade_low;
  shadow.sea_shade_high = corner_rel + in.world.forest->sea_shade_high;
  const glm::vec3 to_light = in.light.sun_direction;
  shadow.tree_slide = glm::vec2(to_light) / std::max(to_light.z, 0.2f);
}

}  // namespace

void fill_sun_shadow(const MaterialInputs& in, const RenderView& view, const raster::TileGrid& grid,
                     SunShadow& shadow) {
  shadow.land = nullptr;
  shadow.clouds = in.light.cloud_shadow;
  shadow.objects = &in.objects.shadows;
  fill_tree_shadow(in, glm::dvec2(view.camera.eye_world), shadow);
  shadow.entry = underwater_slant(in.light.sun_direction, in.media.refraction_index);
  list_casters(in.objects.shadows, {shadow.entry, in.media.submerged}, view, grid, shadow.casters);
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
