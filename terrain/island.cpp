#include "terrain/island.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "math/elementary.h"
#include "math/random.h"
#include "math/smoothstep.h"

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

// Distances from the shore in metres, inland positive: those of a circle, seen through two layers
// of noise_. The first bends the plane (headlands and bays), the second frays the coast.
std::vector<double> Island::shore_distances(std::span<const double> x, double y) const {
  std::vector<double> at(x.size()), bend_x(x.size()), bend_y(x.size()), bays(x.size());
  const auto find = [&](double scale, double shift_x, double shift_y, int octaves,
                        double persistence, std::span<double> sums) {
    for (std::size_t n = 0; n < x.size(); ++n) at[n] = scale * x[n] + shift_x;
    noise_.fractal2_row(at, scale * y + shift_y, octaves, persistence, sums);
  };
  find(1.1, 17.3, 41.9, 2, 0.45, bend_x);
  find(1.1, 71.1, 93.7, 2, 0.45, bend_y);
  find(2.1, 131.5, 7.7, 3, 0.35, bays);
  for (std::size_t n = 0; n < x.size(); ++n) {
    const glm::dvec2 bent = glm::dvec2(x[n], y) + kWarp * glm::dvec2(bend_x[n], bend_y[n]);
    at[n] = profile_.radius * (1.0 - glm::length(bent) + kBays * bays[n]);
  }
  return at;
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

std::vector<float> Island::row_m(std::span<const double> x_m, double y_m) const {
  std::vector<float> heights(x_m.size(), static_cast<float>(-profile_.floor_depth));
  std::vector<std::size_t> places;
  std::vector<double> x;
  for (std::size_t n = 0; n < x_m.size(); ++n) {
    if (glm::length(glm::dvec2(x_m[n], y_m)) >= profile_.half_size) continue;
    places.push_back(n);
    x.push_back(x_m[n] / profile_.radius);
  }
  const double y = y_m / profile_.radius;
  const std::vector<double> inland = shore_distances(x, y);
  for (std::size_t n = 0; n < x.size(); ++n) {
    const glm::dvec2 q(x[n], y);
    heights[places[n]] = static_cast<float>(inland[n] >= 0.0 ? land_height(q, inland[n])
                                                             : sea_floor_height(q, -inland[n]));
  }
  return heights;
}

double island_size_m(const TerrainDescription& description) {
  return 2.0 * Island(description, description.seed).half_size_m();
}

HeightGrid build_island(const TerrainDescription& description, Workers& workers) {
  const Island shape(description, description.seed);
  const double half_m = shape.half_size_m(), spacing_m = 2.0 * half_m / (kIslandSamples - 1);
  HeightGrid island{{description.centre_m - half_m, spacing_m, kIslandSamples, kIslandSamples}};
  island.height_m.resize(island.grid.size());
  std::vector<double> from_middle_m;
  for (int i = 0; i < kIslandSamples; ++i) from_middle_m.push_back(i * spacing_m - half_m);
  workers.for_each(kIslandSamples, [&](std::size_t j, int) {
    std::ranges::copy(shape.row_m(from_middle_m, from_middle_m[j]),
                      &island.height_m[j * kIslandSamples]);
  });
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

HeightGrid build_archipelago(const TerrainDescription& description, Workers& workers) {
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
    const auto from_middle_m = [&](int i, int j) {
      return all.grid.point(i, j) - island.middle_world;
    };
    std::vector<double> x_m;
    for (int i = first.x; i <= last.x; ++i) x_m.push_back(from_middle_m(i, 0).x);
    workers.for_each(static_cast<std::size_t>(last.y - first.y + 1), [&](std::size_t n, int) {
      const int j = first.y + static_cast<int>(n);
      float* height_m = &all.height_m[all.grid.index(first.x, j)];
      for (const float one_m : island.shape.row_m(x_m, from_middle_m(0, j).y)) {
        *height_m = std::max(*height_m, one_m);
        ++height_m;
      }
    });
  }
  return all;
}

}  // namespace swell::terrain
