// What land leaves of a plane wave that runs past it, over water of one depth: the wave is marched
// along its direction, row by row, and spreads sideways into the lee.
//
//   du/dx = i k (X / 2) / (1 + X / 4) u,    X = (1 / k^2) d2/dy2
//
// u the wave's complex height over e^ikx, 1 in the open sea: the parabolic approximation, in the
// form that holds up to about 45 degrees from the direction, by Crank and Nicolson's steps. Where
// there is land u is 0: land takes waves in and throws none back.
// Sources: Radder, On the Parabolic Equation Method for Water-Wave Propagation, J. Fluid Mech. 95,
// 1979; Claerbout, Fundamentals of Geophysical Data Processing, 1976 (the wider angle).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "terrain/shore_map.h"

namespace swell::ocean {

// A wave of one direction and length.
struct PlaneWave {
  glm::dvec2 travel{0.0, 1.0};  // unit vector: x east, y north
  double wavelength_m = 100.0;  // > 0
};

// Where land stands, on the points of a shore map, and on squares of kSquare of its points a side,
// so that most places are told by one look.
struct LandMask {
  static constexpr int kSquare = 16;
  enum class Around : std::uint8_t { kWater, kLand, kBoth };

  terrain::Grid grid;
  std::vector<std::uint8_t> land;  // 1: above the sea
  // `around` tells of a square and its eight neighbours, row after row, with one square beyond each
  // side.
  int squares_across = 0, squares_along = 0;
  std::vector<Around> around;
};
LandMask make_land_mask(const terrain::ShoreMap& shore);
bool is_land(const LandMask& mask, glm::dvec2 p_world);  // of the nearest point; false beyond all

// Fills, for the points of `grid`, a square, the part of the wave's energy that comes there (0 on
// land; diffraction's fringes may exceed 1 by 40 % in the open), and how far the wave has run over
// water since it last met land, infinity if it has not. Land narrower than half the grid's spacing
// may leak. 20 ns a point and, of the square's side before the first land, less.
void march_wave(const LandMask& mask, const PlaneWave& wave, const terrain::Grid& grid,
                std::span<float> energy, std::span<float> fetch_m);

}  // namespace swell::ocean
