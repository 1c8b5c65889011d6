#include "render/materials/terrain.h"

#include <algorithm>
#include <cmath>

#include "ocean/sea_state.h"
#include "ocean/swash.h"
#include "terrain/apron.h"

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

GroundLayer make_ground_layer(const texture::PackedMap2& slopes, const texture::RgbaImage& albedo,
                              const terrain::Grid& square, glm::dvec2 eye) {
  const glm::dvec2 from_corner = eye - square.min_world;
  GroundLayer layer{make_square_layer(slopes, square.size_m(), from_corner), &albedo};
  const double texels_per_m = albedo.width / square.size_m();
  layer.albedo_texels_per_m = static_cast<float>(texels_per_m);
  // Texel centres lie at +0.5, the terrain's samples on the lattice.
  layer.albedo_x_eye = static_cast<float>(from_corner.x * texels_per_m + 0.5);
  layer.albedo_y_eye = static_cast<float>(from_corner.y * texels_per_m + 0.5);
  return layer;
}

}  // namespace

void fill(const MaterialInputs& in, const RenderView& view, Terrain& terrain) {
  if (!in.world.terrain) return;
  const terrain::HeightGrid& land = *in.world.terrain;
  const TerrainMaps& maps = *in.world.terrain_maps;
  const glm::dvec2 eye(view.camera.eye_world);
  terrain.map = make_ground_layer(maps.slopes, maps.albedo, land.grid, eye);
  terrain.around = make_ground_layer(maps.slopes_around, maps.albedo_around,
                                     terrain::square_with_apron(land), eye);
  terrain.sun.map = nullptr;
  if (const LandShadow* shadow = in.world.land_shadow.get();
      shadow && shadow->ground.size > 0 && !in.without.has(Part::kShadows))
    terrain.sun = make_square_layer(shadow->ground, land.grid.size_m(), eye - land.grid.min_world);
  const float detail_gain =
      0.11f / std::sqrt(std::max(in.world.bump->lost_variance.back(), 1e-12f));
  terrain.detail = make_layer(*in.world.bump, kDetailPeriod_m, detail_gain, eye, {});

  fill(in, eye, land.grid.size_m() / maps.ground.size, terrain.land);
  terrain.canopy = make_canopy(in, land.grid, eye);
  terrain.checker = make_checker(in.world.scene.terrain->checker_m, eye);
  terrain.swash = {};
  if (in.without.has(Part::kWater)) return;
  if (!in.world.coast && in.without.has(Part::kSurfFronts)) return;
  const ocean::Swash sheets =
      ocean::make_swash(*in.world.sea, in.world.coast.get(), in.world.shelter.get());
  terrain.swash = make_swash(sheets, ocean::wave_time_s(in.world.scene.sea, in.t_s), eye);
  terrain.foam = make_foam(in, eye);
}

}  // namespace swell::render
