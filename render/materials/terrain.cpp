#include "render/materials/terrain.h"

#include <algorithm>
#include <cmath>

#include "ocean/coast/swash.h"
#include "ocean/open_sea/sea.h"
#include "ocean/open_sea/sea_state.h"
#include "render/frame/parts.h"
#include "render/view/render_view.h"
#include "render/world/land_shadow.h"
#include "render/world/terrain_maps.h"
#include "render/world/world_state.h"
#include "terrain/apron.h"
#include "terrain/height_grid.h"

namespace swell::render {
namespace {

constexpr double kDetailPeriod_m = 7.0;

Swash make_swash(const ocean::Swash& sheets, double t_s, glm::dvec2 eye) {
  Swash swash;
  swash.reach_m = static_cast<float>(sheets.reach_m);
  swash.cycles = fraction(t_s / sheets.period_s);
  const auto along = [&](glm::dvec2 lag_m) {
    return glm::vec3(1.0 / lag_m.x, 1.0 / lag_m.y, fraction(eye.x / lag_m.x + eye.y / lag_m.y));
  };
  swash.lag_a = along(ocean::kSwashLags_m[0]);
  swash.lag_b = along(ocean::kSwashLags_m[1]);
  swash.lag_c = along(ocean::kSwashLags_m[2]);
  return swash;
}

SlopeLayer make_slopes(const texture::PackedMap2& slopes, const terrain::Grid& square,
                       glm::dvec2 eye) {
  return make_square_layer(slopes, square.size_m(), eye - square.min_world);
}

}  // namespace

void fill(const MaterialInputs& in, const RenderView& view, Terrain& terrain) {
  if (!in.world.terrain) return;
  const terrain::HeightGrid& land = *in.world.terrain;
  const TerrainMaps& maps = *in.world.terrain_maps;
  const glm::dvec2 eye(view.camera.eye_world);
  terrain.slopes = make_slopes(maps.slopes, land.grid, eye);
  terrain.slopes_around = make_slopes(maps.slopes_around, terrain::square_with_apron(land), eye);
  terrain.albedo = make_ground_albedo(in.world, eye);
  terrain.sun.map = nullptr;
  if (const LandShadow* shadow = in.world.land_shadow.get();
      shadow && shadow->ground.size > 0 && !in.without.has(Part::kShadows))
    terrain.sun = make_square_layer(shadow->ground, land.grid.size_m(), eye - land.grid.min_world);
  const float detail_gain =
      0.11f / std::sqrt(std::max(in.world.textures.bump->lost_variance.back(), 1e-12f));
  terrain.detail = make_layer(*in.world.textures.bump, kDetailPeriod_m, detail_gain, eye, {});

  fill(in, eye, land.grid.size_m() / maps.ground[0].size, terrain.land);
  terrain.canopy = make_canopy(in, land.grid, eye);
  terrain.checker = make_checker(in.world.scene.terrain->checker_m, eye);
  terrain.swash = {};
  if (in.without.has(Part::kWater)) return;
  if (!in.world.coast && in.without.has(Part::kSurfFronts)) return;
  const ocean::Swash sheets =
      ocean::make_swash(*in.world.sea, in.world.coast.get(), in.world.shelter.get());
  terrain.swash = make_swash(sheets, ocean::wave_time_s(in.world.scene.sea, in.t_s), eye);
}

}  // namespace swell::render
