// The map of what a shore does to the sea before it.
#include "render/world/near_shore_map.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "math/large_array.h"
#include "ocean/coast/shelter.h"
#include "ocean/open_sea/sea.h"
#include "render/world/for_each_row.h"
#include "render/world/world_state.h"
#include "terrain/shore_map.h"

namespace swell::render {
namespace {

// Waves begin to break where the water is so much deeper than they are high, significant heights.
constexpr double kDepthOfSurf = 1.6;
// Distances in the map, in texels at least: fewer would be stairs.
constexpr double kLeastTexels = 2.5;
constexpr double kMostSurfReach_m = 400.0;

// The floor's mean slope within `within_m` of the shore, on the map: its apron may be steep.
double beach_slope(const terrain::ShoreMap& shore, const terrain::Grid& map, double within_m) {
  double depths_m = 0.0, distances_m = 0.0;
  for (int j = 0; j < shore.grid().samples_y; ++j)
    for (int i = 0; i < shore.grid().samples_x; ++i) {
      const std::size_t k = shore.grid().index(i, j);
      const float distance_m = shore.signed_distance_m()[k];
      if (!(distance_m > 0.0f && distance_m < static_cast<float>(within_m))) continue;
      if (!map.holds(shore.grid().point(i, j))) continue;
      depths_m -= static_cast<double>(shore.height_m()[k]);
      distances_m += static_cast<double>(distance_m);
    }
  return distances_m > 0.0 ? std::clamp(depths_m / distances_m, 0.01, 0.5) : 0.1;
}

// Returns the distance from p to the shore over the surf's reach. The reach is shorter where only a
// part of the surf is to run in.
float part_of_reach(const terrain::ShoreMap& shore, glm::dvec2 p, float reach_m) {
  const float distance_m = shore.sample(p.x, p.y).signed_distance_m;
  const float surf = shore.surf_at(p.x, p.y);
  return surf > 0.0f ? distance_m / (surf * reach_m) : 1.0f;
}

}  // namespace

NearShoreMap build_near_shore(const WorldState& world, Workers& workers) {
  const terrain::ShoreMap& shore = *world.shore;
  const terrain::Grid& square = shore.grid();
  constexpr int n = kNearShoreSize;
  NearShoreMap near;
  near.min_world = square.min_world;
  near.size_m = square.size_m();
  const double texel_m = near.size_m / n, gravity = world.scene.sea.gravity_mps2;
  const double height_m = world.sea->significant_height_m();
  const double slope =
      beach_slope(shore, world.terrain->grid, std::max(30.0, 3.0 * square.spacing_m));
  near.reach_m = std::clamp(kDepthOfSurf * height_m / slope, kLeastTexels * texel_m,
                            std::max(kMostSurfReach_m, kLeastTexels * texel_m));
  near.reach_m = std::max(near.reach_m * world.scene.coast.surf_width, kLeastTexels * texel_m);
  near.reach_s = 2.0 * std::sqrt(near.reach_m / (gravity * slope));
  // The period is that of the mean wave in deep water.
  near.period_s = std::sqrt(2.0 * kPi * std::max(world.sea->mean_wavelength_m(), 1.0) / gravity);
  auto taken = make_large<float>(static_cast<std::size_t>(n) * n);
  auto part = make_large<float>(taken.size());
  for_each_row(n, workers, [&](int j) {
    for (int i = 0; i < n; ++i) {
      const glm::dvec2 p = lattice_point(square.min_world, texel_m, glm::dvec2(i, j));
      float kept = 1.0f;
      ocean::apply_shelter(*world.shelter, {&p, 1}, {&kept, 1});
      const std::size_t k = static_cast<std::size_t>(j) * n + static_cast<std::size_t>(i);
      taken[k] = 1.0f - kept;
      part[k] = part_of_reach(shore, p, static_cast<float>(near.reach_m));
    }
  });
  texture::pack_map2(n, taken, part, 1.0f / 127.0f, near.map);
  return near;
}

}  // namespace swell::render
