// |grad theta| = s on a grid with obstacles: the first arrival of a wave from given places.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "terrain/height_grid.h"

namespace swell::ocean {

// Arrays of grid.size() elements, sample (i, j) at grid.index(i, j).
struct EikonalProblem {
  terrain::Grid grid;
  std::vector<double> slowness;       // |grad theta| per metre, > 0; 0: an obstacle
  std::vector<double> source;         // theta where it is given; infinity elsewhere
  std::vector<double> source_energy;  // for spread_energy: >= 0 at sources
};

// Fills `theta`, resized to the grid: the source value at sources, infinity in obstacles and where
// no wave gets. Second order in the spacing where the solution is smooth (about 0.07 microseconds a
// sample).
//
// Source: Zhao, A Fast Sweeping Method for Eikonal Equations, 2005 (Godunov's upwind differences,
// four sweep orders until nothing changes, leaving out what cannot change); then one pass down the
// wave with Sethian's one-sided differences of second order (Level Set Methods and Fast Marching
// Methods, 1999).
void solve_eikonal(const EikonalProblem& problem, std::vector<double>& theta);

// Fills `energy`, resized to the grid, with the energy flux density of the wave along its rays:
// div(energy grad theta / |grad theta|) = 0, source_energy at the sources, 0 in obstacles and where
// no wave gets. Finite volumes: what enters a cell leaves it down the wave, exactly, but on the
// lines where two arrivals meet, which pass on the mean of both. At most kMaxFocus, since rays that
// cross (caustics) would give infinity.
inline constexpr double kMaxFocus = 4.0;
void spread_energy(const EikonalProblem& problem, std::span<const double> theta,
                   std::vector<double>& energy);

}  // namespace swell::ocean
