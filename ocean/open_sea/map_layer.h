// Waves from maps of heights that are periodic in space and in time, laid over the sea in layers of
// different periods (ocean/open_sea/periodic_map.h):
//   H(x, y, t) = sum_i h_i(a_i x + b_i, c_i y + d_i, e_i t + f_i).
// Source: Gabdrakhmanov, Modelling Interactive Water Surfaces.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>

namespace swell::ocean {

struct MapLayer {
  std::string file;            // of a map, read when the sea is made
  glm::dvec2 length_m{100.0};  // after which it repeats itself along x and along y, [0.5, 50000]
  double period_s = 0.0;       // and in time, [0.1, 100000]; 0: its mean wave is as fast as in deep
                               // water
  double hs_m = 1.0;           // significant height, [0, 30]
  glm::dvec2 offset_m{0.0};    // the world's origin shows this place of the map, to whole samples
  double offset_s = 0.0;       // and t = 0 this time

  bool operator==(const MapLayer&) const = default;
};

// Seven layers, made for the wind's direction, that look like a kind of water.
enum class MapSet : std::uint8_t { kNone, kRiver, kLake, kCoast, kOcean };

// How heights of layers are looked up: the samples as they are, four for a bilinear one; or codes
// of 16 bits, the four of one side by side, in less time.
enum class MapHeights : std::uint8_t { kExact, kPacked };

}  // namespace swell::ocean
