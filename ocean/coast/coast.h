// The waves of a coast: wave trains that know the sea floor where it is shallow, nothing where it
// is deep, so that they can be blended into a spectrum sea that knows no coast.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "math/parallel.h"
#include "ocean/coast/peachey.h"

namespace swell::ocean {

// Trains and the part they have in the surface: share 1 at the shore, 0 in deep water and beyond
// the grid. Read-only after it is made. The surface is share x trains + spectrum_weight(share) x
// spectrum.
struct CoastSea {
  TrainSea trains;
  std::vector<float> share;  // for the samples of trains.grid, in [0, 1]
  float peak_wavelength_m = 1.0f;
  // Surf begins in water so many times as deep as waves break in: on a plane beach its band is so
  // many times as wide.
  double surf_width = 1.0;
  // The steepest slopes [1/m] of the share and of spectrum_weight(share), between samples.
  float share_slope_per_m = 0.0f;

  // A bound on the slope of share x trains, everywhere and always.
  float slope_bound() const {
    return trains.slope_bound + share_slope_per_m * trains.height_bound_m;
  }
};

// Where the spectrum ends and the trains begin, as depth over the peak's deep-water wavelength: all
// trains below kShallow, all spectrum above kDeep. Waves feel the floor from a half down.
inline constexpr double kShallow = 0.10, kDeep = 0.40;

// What is left of the spectrum's waves beside trains of this share: sqrt(1 - share^2), so that the
// two variances, of waves that know nothing of each other, add up to that of one.
inline float spectrum_weight(float share) {
  return std::sqrt(std::max(0.0f, 1.0f - share * share));
}

// Makes `train_count` trains of the wind's sea and their phases over the floor. If not `blend`,
// there are trains in deep water, too. The share falls to 0 over the grid's rim, a tenth to three
// tenths of its side wide. Errors as make_train_sea.
CoastSea make_coast_sea(const terrain::HeightGrid& floor, const WaveSystem& wind, int train_count,
                        std::uint64_t seed, PhaseMethod method, bool blend, Workers& workers);

// Makes such a sea of the caller's own trains. `wind` says where the spectrum ends; kept: as of
// make_train_sea().
CoastSea make_coast_sea(const terrain::HeightGrid& floor, const WaveSystem& wind,
                        std::span<const WaveTrain> trains, PhaseMethod method, bool blend,
                        Workers& workers, std::span<const std::vector<float>> kept = {});

// The trains' share at world points, bilinear.
void sample_coast_share(const CoastSea& coast, std::span<const glm::dvec2> p_world,
                        std::span<float> share);

// Heights of the trains at time t_s, times their share, and that share. Spans of one length. Points
// without a share cost nothing more.
void sample_coast(const CoastSea& coast, double t_s, std::span<const glm::dvec2> p_world,
                  std::span<float> height_m, std::span<float> share);

}  // namespace swell::ocean
