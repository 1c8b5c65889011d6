#include "terrain/island.h"

#include <algorithm>
#include <cmath>

#include "math/elementary.h"
#include "math/smoothstep.h"
#include "texture/perlin.h"

namespace swell::terrain {
namespace {

// The island's measures, all in metres. Widths are counted from the shore line.
struct Profile {
  double radius;
  double beach_slope = 1.0 / 24.0;
  double beach_width;  // inland, until the hills have begun
  double hill_height;
  double lagoon_depth;  // of its sandy floor
  double lagoon_width;  // to the reef
  double reef_rise;     // of the reef above the lagoon's floor
  double drop_width;    // of the slope from the reef down to the floor
  double floor_depth;
  double half_size;  // of the square; from there on, counted from its middle, only floor
};

Profile make_profile(const TerrainDescription& description) {
  const double radius = description.island_radius_m;
  Profile p;
  p.radius = radius;
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

// Strength of the coast's two layers of noise, in radii.
constexpr double kWarp = 0.16, kBays = 0.16;

// Distance from the shore in metres, inland positive: that of a circle, seen through two layers
// of noise. The first bends the plane (headlands and bays), the second frays the coast.
double shore_distance(const Profile& p, const texture::PerlinNoise& noise, glm::dvec2 q) {
  const double bend_x = noise.fractal2(1.1 * q.x + 17.3, 1.1 * q.y + 41.9, 2, 0.45);
  const double bend_y = noise.fractal2(1.1 * q.x + 71.1, 1.1 * q.y + 93.7, 2, 0.45);
  const glm::dvec2 bent = q + kWarp * glm::dvec2(bend_x, bend_y);
  const double bays = noise.fractal2(2.1 * q.x + 131.5, 2.1 * q.y + 7.7, 3, 0.35);
  return p.radius * (1.0 - glm::length(bent) + kBays * bays);
}

// Turned by 37 degrees, so that the noise's lattice does not show through the layers.
glm::dvec2 turned(glm::dvec2 q) { return {0.8 * q.x - 0.6 * q.y, 0.6 * q.x + 0.8 * q.y}; }

// Height above the beach at `inland` metres from the shore: a broken dome with ridges.
double hills(const Profile& p, const texture::PerlinNoise& noise, glm::dvec2 q, double inland) {
  const double rise = smoothstep(0.75 * p.beach_width, 0.9 * p.radius, inland);
  if (rise == 0.0) return 0.0;
  const glm::dvec2 r = turned(q);
  const double ridge = noise.fractal2(1.6 * r.x + 3.9, 1.6 * r.y + 77.7, 3, 0.4);
  const double rolling = noise.fractal2(2.9 * q.x + 51.3, 2.9 * q.y + 29.1, 5, 0.42);
  const double shape = 0.45 + 0.55 * (1.0 - 2.5 * ridge * ridge) + 0.3 * rolling;
  const double positive = 0.5 * (shape + std::sqrt(shape * shape + 0.04));
  return p.hill_height * rise * positive;
}

double land_height(const Profile& p, const texture::PerlinNoise& noise, glm::dvec2 q,
                   double inland) {
  // The beach starts at beach_slope and levels off towards a low plain.
  const double plain = p.beach_slope * p.beach_width * 1.5;
  const double beach = plain * (1.0 - exp(-inland * p.beach_slope / plain));
  return beach + hills(p, noise, q, inland);
}

double sea_floor_height(const Profile& p, const texture::PerlinNoise& noise, glm::dvec2 q,
                        double offshore) {
  // The lagoon's floor starts at the beach's slope and levels off.
  const double lagoon = -p.lagoon_depth * (1.0 - exp(-offshore * p.beach_slope / p.lagoon_depth));
  const double deep =
      std::max(smoothstep(p.lagoon_width, p.lagoon_width + p.drop_width, offshore),
               smoothstep(0.8 * p.half_size, p.half_size, p.radius * glm::length(q)));
  if (deep == 1.0) return -p.floor_depth;

  // Sand banks and the reef, which is broken by noise.
  const glm::dvec2 r = turned(q);
  const double banks = noise.fractal2(4.1 * r.x + 11.1, 4.1 * r.y + 63.3, 4, 0.45);
  const double away = smoothstep(0.0, 0.25 * p.lagoon_width, offshore);
  const double from_reef = (offshore - 0.95 * p.lagoon_width) / (0.12 * p.lagoon_width);
  const double reef = exp(-from_reef * from_reef) * (0.6 + 0.4 * banks);
  const double shelf =
      lagoon + away * (0.22 * p.lagoon_depth * banks + p.reef_rise * std::max(reef, 0.0));
  return shelf + (-p.floor_depth - shelf) * deep;
}

double island_height(const Profile& p, const texture::PerlinNoise& noise, glm::dvec2 q) {
  const double inland = shore_distance(p, noise, q);
  return inland >= 0.0 ? land_height(p, noise, q, inland) : sea_floor_height(p, noise, q, -inland);
}

}  // namespace

double island_size_m(const TerrainDescription& description) {
  return 2.0 * make_profile(description).half_size;
}

HeightGrid build_island(const TerrainDescription& description) {
  const Profile p = make_profile(description);
  const texture::PerlinNoise noise(description.seed);
  const double spacing_m = 2.0 * p.half_size / (kIslandSamples - 1);
  HeightGrid island{
      {description.centre_m - p.half_size, spacing_m, kIslandSamples, kIslandSamples}};
  island.height_m.reserve(island.grid.size());
  for (int j = 0; j < kIslandSamples; ++j) {
    for (int i = 0; i < kIslandSamples; ++i) {
      const glm::dvec2 q = (glm::dvec2(i, j) * spacing_m - p.half_size) / p.radius;
      const bool corner = p.radius * glm::length(q) >= p.half_size;
      const double height = corner ? -p.floor_depth : island_height(p, noise, q);
      island.height_m.push_back(static_cast<float>(height));
    }
  }
  return island;
}

}  // namespace swell::terrain
