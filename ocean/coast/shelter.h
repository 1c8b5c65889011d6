// What land leaves of the open sea's waves: islands, headlands and harbour walls stand in the way
// of some of the directions that waves come from, the waves bend into their lee, and the wind
// raises new ones behind them.
//
// A sea is taken apart into beams, waves of one direction and length with equal parts of its
// energy. Land leaves of each what diffraction brings (ocean/coast/diffraction.h), or what the wind
// has raised since the last land, if that is more; the energies add up. So in the lee of what is
// long against the waves heights are the root of the energy whose directions see the open sea, and
// close to edges those of the diffraction diagrams for waves of many directions. Sources: Goda,
// Takayama, Suzuki, Diffraction Diagrams for Directional Random Waves, ICCE 1978 (the sum over
// beams); Hasselmann et al., JONSWAP, 1973 (growth with the fetch).
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <tuple>
#include <vector>

#include "math/parallel.h"
#include "ocean/coast/diffraction.h"
#include "ocean/coast/wave_phase.h"
#include "ocean/open_sea/sea.h"
#include "terrain/shore_map.h"

namespace swell::ocean {

// A part of a sea's energy.
struct Beam {
  PlaneWave wave;
  double energy = 0.0;    // of all beams together: 1
  double wind_mps = 0.0;  // that raises waves along it; 0: of a swell
};

// The beams of a sea: of the wind's waves and of each swell kSystemBeams that are as strong, with
// their directions and lengths spread as the spectrum's; of each sine one. Waves of maps count as
// the wind's. None: there are no waves.
inline constexpr int kSystemBeams = 32;
std::vector<Beam> make_beams(const SeaDescription& sea);

// What is left of the heights of the open sea's waves, on the points of a square; beyond it, all.
// Read-only after it is made.
struct Shelter {
  terrain::Grid grid;
  std::vector<float> kept;   // in [0, 1]: 1 towards the grid's border
  float slope_per_m = 0.0f;  // the steepest of it

  auto fields() { return std::tie(grid, kept, slope_per_m); }
};

// Cells a side of its square, that of the shore map.
inline constexpr int kShelterCells = 256;

// Works it out: about 3 ms of one core a beam. The same bits with any workers.
Shelter make_shelter(const terrain::ShoreMap& shore, std::span<const Beam> beams, Workers& workers);

// Returns what land leaves of a wave train's height at the points of `at`: of waves as long in
// directions up to kTrainSpread_rad beside its own, since a train stands for many waves.
inline constexpr double kTrainSpread_rad = 0.12;
std::vector<float> shelter_train(const LandMask& mask, const WaveTrain& train,
                                 const terrain::Grid& at);

// kept[i] *= what is left at the place, bilinear. Spans of one length.
void apply_shelter(const Shelter& shelter, std::span<const glm::dvec2> p_world,
                   std::span<float> kept);

}  // namespace swell::ocean
