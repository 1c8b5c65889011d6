// Points scattered evenly and without pattern over a square that repeats, in an order of which each
// beginning is scattered as well: a density that changes from place to place keeps at each place
// the first part of the points.
// Source: Cook, Stochastic Sampling in Computer Graphics, 1986 (points at random that keep a
// distance); Kopf, Cohen-Or, Deussen, Lischinski, Recursive Wang Tiles for Real-Time Blue Noise,
// 2006 (ranks).
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace swell::terrain {

// Points of a tile.
inline constexpr std::size_t kPoissonPoints = 4096;

// Times the root of their number over the area: the least distance of the first points of a tile.
inline constexpr double kPoissonSpacing = 0.7;

// Least distance [m] of points of which there are so many a square metre, > 0.
inline double poisson_distance_m(double density_per_m2) {
  return kPoissonSpacing / std::sqrt(density_per_m2);
}

// kPoissonPoints points in [0, 1)^2: no two of the first n, also across the borders of repeated
// tiles, are nearer than kPoissonSpacing / sqrt(n). A pure function of the seed; 30 ms.
std::vector<glm::dvec2> make_poisson_tile(std::uint64_t seed);

}  // namespace swell::terrain
