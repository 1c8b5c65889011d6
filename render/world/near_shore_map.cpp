// The map of what a shore does to the sea before it.
#include "render/world/near_shore_map.h"

#include <cmath>
#include <vector>

#include "math/for_each_row.h"
#include "math/large_array.h"
#include "math/lattice.h"
#include "ocean/coast/shelter.h"
#include "ocean/coast/surf_fronts.h"
#include "ocean/open_sea/sea.h"
#include "render/world/world_state.h"
#include "scene/coast.h"
#include "terrain/shore_map.h"

namespace swell::render {
namespace {

// Values of a map of kNearShoreSize points a side.
LargeArray<float> make_values() {
  return make_large<float>(static_cast<std::size_t>(kNearShoreSize) * kNearShoreSize);
}

// Calls body(k, p) for the k-th point of the map at p.
template <class Body>
void for_each_point(const NearShoreMap& near, Workers& workers, const Body& body) {
  constexpr int n = kNearShoreSize;
  for_each_row(n, workers, [&](int j) {
    for (int i = 0; i < n; ++i)
      body(static_cast<std::size_t>(j) * n + static_cast<std::size_t>(i),
           lattice_point(near.min_world, near.size_m / n, glm::dvec2(i, j)));
  });
}

// Fills in the maps of fronts that lift the water.
void map_fronts(const terrain::ShoreMap& shore, NearShoreMap& near, Workers& workers) {
  const ocean::SurfFronts& fronts = *near.fronts;
  near.lift_m = fronts.height_bound_m / (1.0f - ocean::kFrontMean);
  const float over_m = near.lift_m > 0.0f ? 1.0f / near.lift_m : 0.0f;
  const auto reach_m = static_cast<float>(near.zone.reach_m);
  LargeArray<float> root = make_values(), height = make_values(), east = make_values(),
                    north = make_values();
  for_each_point(near, workers, [&](std::size_t k, glm::dvec2 p) {
    const ocean::FrontPlace place = ocean::place_in_fronts(fronts, p);
    const float part = place.at.part / ocean::kFrontsFrom;
    root[k] = std::copysign(std::sqrt(std::abs(part)), part);
    height[k] = over_m * ocean::front_height_m(place.at, -shore.sample(p.x, p.y).height_m);
    east[k] = reach_m * place.part_slope.x;
    north[k] = reach_m * place.part_slope.y;
  });
  texture::pack_map2(kNearShoreSize, root, height, 1.0f / 127.0f, near.lift, 0.0f, &workers);
  texture::pack_map2(kNearShoreSize, east, north, 2.0f / 127.0f, near.seaward, 0.0f, &workers);
}

}  // namespace

NearShoreMap build_near_shore(const WorldState& world, Workers& workers) {
  const terrain::ShoreMap& shore = *world.shore;
  NearShoreMap near;
  near.min_world = shore.grid().min_world;
  near.size_m = shore.grid().size_m();
  near.zone =
      ocean::find_surf_zone(shore, world.terrain->grid, *world.sea, world.scene.coast.surf_width);
  LargeArray<float> taken = make_values(), part = make_values();
  for_each_point(near, workers, [&](std::size_t k, glm::dvec2 p) {
    float kept = 1.0f;
    ocean::apply_shelter(*world.shelter, {&p, 1}, {&kept, 1});
    taken[k] = 1.0f - kept;
    part[k] = ocean::part_of_reach(near.zone, shore, p, 1.0f);
  });
  texture::pack_map2(kNearShoreSize, taken, part, 1.0f / 127.0f, near.map, 0.0f, &workers);
  near.fronts = scene::build_surf_fronts(world.scene, *world.sea, world.terrain.get(), &shore,
                                         world.shelter.get(), workers);
  if (near.fronts) map_fronts(shore, near, workers);
  return near;
}

}  // namespace swell::render
