#include "render/materials/river.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "ocean/inland/inland_water.h"
#include "render/frame/parts.h"
#include "render/sky/light.h"
#include "render/tile/ripples.h"
#include "render/view/meshes.h"
#include "render/view/render_view.h"
#include "render/world/world_state.h"

namespace swell::render {
namespace {

constexpr double kLongRipples_m = 5.3, kShortRipples_m = 1.9, kStones_m = 2.3;
constexpr double kRiverFoam_m = 4.0;
constexpr float kWindShare = 0.6f;                      // banks shelter
constexpr glm::vec3 kBedAlbedo{0.155f, 0.14f, 0.105f};  // wet gravel

// Makes a layer of ripples whose slope variance is 1/2.
SlopeLayer make_ripple_layer(const texture::PackedMap2& map, double period_m, glm::dvec2 eye) {
  const float variance = 2.0f * std::max(map.lost_variance.back(), 1e-12f);
  return make_layer(map, period_m, 1.0f / std::sqrt(variance), eye, {});
}

}  // namespace

void fill(const MaterialInputs& in, const RenderView& view, River& river) {
  const ocean::InlandWater* const inland = in.world.inland.get();
  if (!inland || in.without.has(Part::kRivers)) return;
  const glm::dvec2 eye(view.camera.eye_world);
  river.samples = inland->samples().data();
  river.block_index = inland->block_index().data();
  river.blocks_x = inland->blocks_x();
  river.blocks_y = inland->blocks_y();
  river.corner_rel = glm::vec2(inland->corner() - eye);
  river.cells_per_m = static_cast<float>(1.0 / inland->spacing_m());

  river.long_ripples = make_ripple_layer(*in.world.textures.bump, kLongRipples_m, eye);
  river.short_ripples = make_ripple_layer(*in.world.textures.bump, kShortRipples_m, eye);
  river.stones = make_ripple_layer(*in.world.textures.bump, kStones_m, eye);
  river.foam_lace = make_foam_lace(in, eye, kRiverFoam_m);
  const double cycles = in.t_s / kCarried_s;
  river.cycles = fraction(cycles);
  river.cycle_number =
      static_cast<float>(std::floor(cycles) - 4096.0 * std::floor(std::floor(cycles) / 4096.0));
  river.images = in.river_images;
  river.submerged = in.media.submerged;
  river.base_variance = base_variance(in.world.scene);
  river.wind_share = in.without.has(Part::kRipples) ? 0.0f : kWindShare;
  const float sun = std::max(in.light.sun_direction.z, 0.0f) / static_cast<float>(kPi);
  river.ground = make_ground_albedo(in.world, eye);
  river.gravel = kBedAlbedo;
  river.sky_light = in.light.ambient;
  river.sun_light = sun * in.light.sun_irradiance;
}

}  // namespace swell::render
