// A cellular automaton that propagates waves: the wave equation in steps of time on a square grid
// whose opposite sides meet. A cell's next height follows from its own, the one before and its
// eight neighbours:
//   u+ = 2 u - u- + C^2 Lap u,   Lap = [1 4 1; 4 -20 4; 1 4 1] / 6,   C = c dt / dx.
// All waves have one speed c, but for the grid: sin^2(omega dt / 2) = -C^2 Lap(k) / 4, which the
// nine points make the same in all directions up to the fourth order.
// Sources: Gabdrakhmanov, Modelling Interactive Water Surfaces (maps from a cellular automaton);
// Patra, Karttunen, Stencils with Isotropic Discretization Error for Differential Operators, 2006.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace swell::ocean {

inline constexpr int kMinAutomatonSize = 8, kMaxAutomatonSize = 1024;
inline constexpr double kMostCourant = 0.8660254;  // sqrt(3) / 2, less is stable

struct WaveAutomaton {
  int size = 0;                     // cells a side
  double courant = 0.0;             // C: cells that waves run in a step
  std::vector<double> now, before;  // heights, row by row, at two times a step apart
};

// A flat surface at rest. Throws std::invalid_argument with the allowed range: size in
// [kMinAutomatonSize, kMaxAutomatonSize], courant in (0, kMostCourant], beyond which waves would
// grow without end.
WaveAutomaton make_automaton(int size, double courant);

// One step of time; 16,384 cells take about 30 us. Deterministic: one thread, sums in one order.
void step(WaveAutomaton& automaton);

// |now - before|^2 - C^2 <now, Lap before>: what steps keep.
double energy(const WaveAutomaton& automaton);

// Turns a step of a plane wave with so many waves along each side, in [0, 1/2].
double turns_per_step(const WaveAutomaton& automaton, double waves_x, double waves_y);

// Takes the mean away: the automaton would keep it for ever.
void remove_mean(std::span<double> heights);

// First disturbances; each adds to what is there.

// `count` round drops at random places, ups and downs in turn, at rest; radius in cells, [1, 64].
void add_drops(WaveAutomaton& automaton, int count, double radius_cells, std::uint64_t seed);

// What a wind has raised: waves of random phases that run along `to_rad`, clockwise from north
// (rows go north), with the spread |cos(theta / 2)|^(2 spreading), the most of them `peak_waves` a
// side, none over `most_waves`. Their variance is 1 in the mean over seeds.
struct Gusts {
  double to_rad = 0.0;
  double spreading = 4.0;   // [0, 50]
  double peak_waves = 4.0;  // [1, size / 8]
  int most_waves = 20;      // [1, size / 4]
  std::uint64_t seed = 1;
};
void add_gusts(WaveAutomaton& automaton, const Gusts& gusts);

// Heights of a picture, size x size, at rest, softened until no wave is left that cells cannot
// carry.
void add_heights(WaveAutomaton& automaton, std::span<const float> heights);

}  // namespace swell::ocean
