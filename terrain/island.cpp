#include "terrain/island.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/elementary.h"
#include "math/random.h"
#include "math/smoothstep.h"
#include "math/stop.h"

namespace swell::terrain {
namespace {

// Strength of the coast's two layers of noise, in radii.
constexpr double kWarp = 0.16, kBays = 0.16;

// Turned by 37 degrees, so that the noise's lattice does not show through the layers.
glm::dvec2 turned(glm::dvec2 q) { return {0.8 * q.x - 0.6 * q.y, 0.6 * q.x + 0.8 * q.y}; }

}  // namespace

Island::Profile Island::make_profile(const TerrainDescription& description) {
  const double radius = description.island_radius_m;
  Profile p{};
  p.radius = radius;
  p.beach_slope = 1.0 / 24.0;
  p.beach_width = std::min(40.0, 0.22 * radius);
  p.hill_height = description.island_height_m;
  p.floor_depth = description.floor_depth_m;
  p.lagoon_depth = std::min(2.8, 0.6 * p.floor_depth);
  p.lagoon_width = 0.6 * radius;
  p.reef_rise = 0.5 * p.lagoon_depth;
  p.drop_width = std::clamp(2.5 * (p.floor_depth - p.lagoon_depth), 0.1 * radius, 0.6 * radius);
  p.half_size = 1.35 * radius + p.lagoon_width + p.drop_width;
  return p;
}

// Distance from the shore in metres, inland positive: that of a circle, seen through two layers
// of noise_. The first bends the plane (headlands and bays), the second frays the coast.
double Island::shore_distance(glm::dvec2 q) const {
  const double bend_x = noise_.fractal2(1.1 * q.x + 17.3, 1.1 * q.y + 41.9, 2, 0.45);
  const double bend_y = noise_.fractal2(1.1 * q.x + 71.1, 1.1 * q.y + 93.7, 2, 0.45);
  const glm::dvec2 bent = q + kWarp * glm::dvec2(bend_x, bend_y);
  const double bays = noise_.fractal2(2.1 * q.x + 131.5, 2.1 * q.y + 7.7, 3, 0.35);
  return profile_.radius * (1.0 - glm::length(bent) + kBays * bays);
}

// Height above the beach at `inland` metres from the shore: a broken dome with ridges.
double Island::hills(glm::dvec2 q, double inland) const {
  const double rise = smoothstep(0.75 * profile_.beach_width, 0.9 * profile_.radius, inland);
  if (rise == 0.0) return 0.0;
  const glm::dvec2 r = turned(q);
  const double ridge = noise_.fractal2(1.6 * r.x + 3.9, 1.6 * r.y + 77.7, 3, 0.4);
  const double rolling = noise_.fractal2(2.9 * q.x + 51.3, 2.9 * q.y + 29.1, 5, 0.42);
  const double shape = 0.45 + 0.55 * (1.0 - 2.5 * ridge * ridge) + 0.3 * rolling;
  const double positive = 0.5 * (shape + std::sqrt(shape * shape + 0.04));
  return profile_.hill_height * rise * positive;
}

double Island::land_height(glm::dvec2 q, double inland) const {
  // The beach starts at beach_slope and levels off towards a low plain.
  const double plain = profile_.beach_slope * profile_.beach_width * 1.5;
  const double beach = plain * (1.0 - exp(-inland * profile_.beach_slope / plain));
  return beach + hills(q, inland);
}

double Island::sea_floor_height(glm::dvec2 q, double offshore) const {
  // The lagoon's floor starts at the beach's slope and levels off.
  const double lagoon = -profile_.lagoon_depth *
                        (1.0 - exp(-offshore * profile_.beach_slope / profile_.lagoon_depth));
  const double deep = std::max(
      smoothstep(profile_.lagoon_width, profile_.lagoon_width + profile_.drop_width, offshore),
      smoothstep(0.8 * profile_.half_size, profile_.half_size, profile_.radius * glm::length(q)));
  if (deep == 1.0) return -profile_.floor_depth;

  // Sand banks and the reef, which is broken by noise_.
  const glm::dvec2 r = turned(q);
  const double banks = noise_.fractal2(4.1 * r.x + 11.1, 4.1 * r.y + 63.3, 4, 0.45);
  const double away = smoothstep(0.0, 0.25 * profile_.lagoon_width, offshore);
  const double from_reef =
      (offshore - 0.95 * profile_.lagoon_width) / (0.12 * profile_.lagoon_width);
  const double reef = exp(-from_reef * from_reef) * (0.6 + 0.4 * banks);
  const double shelf = lagoon + away * (0.22 * profile_.lagoon_depth * banks +
                                        profile_.reef_rise * std::max(reef, 0.0));
  return shelf + (-profile_.floor_depth - shelf) * deep;
}

Island::Island(const TerrainDescription& description, std::uint64_t seed)
    : profile_(make_profile(description)), noise_(seed) {}

double Island::height_m(glm::dvec2 from_middle_m) const {
  if (glm::length(from_middle_m) >= profile_.half_size) return -profile_.floor_depth;
  const glm::dvec2 q = from_middle_m / profile_.radius;
  const double inland = shore_distance(q);
  return inland >= 0.0 ? land_height(q, inland) : sea_floor_height(q, -inland);
}

double island_size_m(const TerrainDescription& description) {
  return 2.0 * Island(description, description.seed).half_size_m();
}

HeightGrid build_island(const TerrainDescription& description) {
  const Island shape(description, description.seed);
  const double half_m = shape.half_size_m(), spacing_m = 2.0 * half_m / (kIslandSamples - 1);
  HeightGrid island{{description.centre_m - half_m, spacing_m, kIslandSamples, kIslandSamples}};
  island.height_m.reserve(island.grid.size());
  for (int j = 0; j < kIslandSamples; ++j) {
    check_stop();
    for (int i = 0; i < kIslandSamples; ++i)
      island.height_m.push_back(
          static_cast<float>(shape.height_m(glm::dvec2(i, j) * spacing_m - half_m)));
  }
  return island;
}

namespace {

struct PlacedIsland {
  Island shape;
  glm::dvec2 middle_world;
  double room_m;  // to what belongs to another
};

// At most `islands`, each at the first of some places at random where there is room.
std::vector<PlacedIsland> place_islands(const TerrainDescription& description) {
  constexpr int kTries = 64;
  std::vector<PlacedIsland> placed;
  std::uint64_t drawn = 0;
  const auto random = [&] { return random_uniform(description.seed, drawn++); };
  for (int k = 0; k < description.islands; ++k) {
    const double part = random(), size = k == 0 ? 1.0 : 0.2 + 0.6 * part * part;
    TerrainDescription one = description;
    one.island_radius_m *= size;
    one.island_height_m *= size;
    const Island shape(one, description.seed + static_cast<std::uint64_t>(k));
    const double reach_m = 0.5 * description.archipelago_size_m - shape.half_size_m();
    const double room_m = 1.6 * one.island_radius_m;
    for (int i = 0; i < kTries && reach_m > 0.0; ++i) {
      const double east = random(), north = random();
      const glm::dvec2 place =
          description.centre_m + reach_m * (2.0 * glm::dvec2(east, north) - 1.0);
      if (std::ranges::any_of(placed, [&](const PlacedIsland& other) {
            return glm::distance(place, other.middle_world) < room_m + other.room_m;
          }))
        continue;
      placed.push_back({shape, place, room_m});
      break;
    }
  }
  return placed;
}

}  // namespace

HeightGrid build_archipelago(const TerrainDescription& description) {
  constexpr int kLast = kArchipelagoSamples - 1;
  HeightGrid all{{description.centre_m - 0.5 * description.archipelago_size_m,
                  description.archipelago_size_m / kLast, kArchipelagoSamples,
                  kArchipelagoSamples}};
  all.height_m.assign(all.grid.size(), static_cast<float>(-description.floor_depth_m));
  for (const PlacedIsland& island : place_islands(description)) {
    const glm::dvec2 middle = (island.middle_world - all.grid.min_world) / all.grid.spacing_m;
    const double reach = island.shape.half_size_m() / all.grid.spacing_m;
    const glm::ivec2 first(glm::max(glm::ceil(middle - reach), 0.0));
    const glm::ivec2 last(glm::min(glm::floor(middle + reach), static_cast<double>(kLast)));
    for (int j = first.y; j <= last.y; ++j) {
      check_stop();
      for (int i = first.x; i <= last.x; ++i) {
        float& height = all.height_m[static_cast<std::size_t>(j) * kArchipelagoSamples +
                                     static_cast<std::size_t>(i)];
        const double one = island.shape.height_m(all.grid.point(i, j) - island.middle_world);
        height = std::max(height, static_cast<float>(one));
      }
    }
  }
  return all;
}

}  // namespace swell::terrain
