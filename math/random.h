// Counter-based random numbers: a pure function of (seed, counter), so that any element of a
// table can be made alone, in any order, on any thread. Not std distributions, whose results
// differ between standard libraries.
#pragma once

#include <cmath>
#include <cstdint>

#include "math/elementary.h"

namespace swell {

// 64 well-mixed bits. Source: Steele, Lea, Flood, Fast Splittable Pseudorandom Number
// Generators, 2014 (the output function of SplitMix64, Stafford's variant 13), applied twice.
constexpr std::uint64_t random_bits(std::uint64_t seed, std::uint64_t counter) {
  const auto mix = [](std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  };
  return mix(mix(seed + 0x9e3779b97f4a7c15u) + counter * 0x9e3779b97f4a7c15u);
}

// Uniform in [0, 1), a multiple of 2^-53.
constexpr double random_uniform(std::uint64_t seed, std::uint64_t counter) {
  return static_cast<double>(random_bits(seed, counter) >> 11) * 0x1p-53;
}

struct GaussianPair {
  double first, second;
};

// Two independent standard normal numbers (Box-Muller) from counters 2n and 2n + 1.
inline GaussianPair random_gaussian_pair(std::uint64_t seed, std::uint64_t n) {
  const double u = random_uniform(seed, 2 * n) + 0x1p-54;  // (0, 1]
  const SinCos angle = sin_cos_turns(random_uniform(seed, 2 * n + 1));
  const double radius = std::sqrt(-2.0 * log(u));
  return {radius * angle.cos, radius * angle.sin};
}

}  // namespace swell
