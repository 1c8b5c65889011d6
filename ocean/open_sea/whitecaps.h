// Foam of the open sea: where its waves break, and what is left of that a little later.
//
// Water breaks where it falls too fast: where its acceleration dz/dt^2 = -g sum |k| h, the sum over
// all waves h, passes a threshold. B is this sum, of each patch apart, over the waves that are seen
// to break, its phase moved ahead to the fronts of crests. Foam has a code, which B over its
// threshold raises, and which otherwise falls by the same amount each step of time:
//   code_m(x) = max(code_(m-1)(x) - decay, born(B(x, t_m))), in [0, 255].
// After 255 / decay steps it has forgotten all that was before. So foam is a function of time alone
// although it has a past, and what is kept from frame to frame is a cache and nothing else.
// Thresholds are set so that the mean of foam over place and time is what is seen of the wind.
//
// Where a coast's wave trains are the long waves, short ones ride on them, and break on their
// crests. There the longest patch's B makes room for one of the trains as well,
//   B' = (B + m C) / sqrt(1 + m^2),     C = sum of w_i sqrt(2) cos(2 pi u_i - ahead)
// with the trains' phases u_i and weights by their steepness, sum w_i^2 = 1: births run with the
// crests, and B breaks their lines up. The rest is as above, with a threshold of its own for the
// same mean.
//
// Source: Longuet-Higgins, On Wave Breaking and the Equilibrium Spectrum of Wind-Generated Waves,
// 1969 (crests break where they fall by g / 2); Monahan, O'Muircheartaigh, Optimal Power-Law
// Description of Oceanic Whitecap Coverage Dependence on Wind Speed, 1980; Monahan, Oceanic
// Whitecaps, 1971 (from 3.7 m/s; foam decays by 1 / e in 3.85 s).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "math/parallel.h"
#include "ocean/open_sea/foam_on_crest.h"
#include "ocean/open_sea/sea.h"
#include "ocean/spectrum/fft.h"
#include "ocean/spectrum/patch_waves.h"

namespace swell::ocean {

// Points a side of the maps of foam, which lie over patches and repeat with them.
inline constexpr int kFoamMapSize = 256;

// The part of the sea that whitecaps cover in a wind of U10 [m/s] >= 0: 3.84e-6 U10^3.41 up to
// 20 m/s, beyond that rising ever more slowly to 0.3; 0 up to 3.7 m/s, and less than the law up to
// 5 m/s, where they begin.
double whitecap_cover(double wind_speed_mps);

// The foam of one patch, as it is made from the patch's waves.
struct FoamPatch {
  double length_m = 0.0;
  PatchWaves breaking;     // whose heights are B, in standard deviations
  double cover = 0.0;      // mean of the foam over place and time
  float threshold = 0.0f;  // of B
  int decay = 1;           // codes a step, [1, 255]
};

// A coast's wave trains as whitecaps know them (ocean/coast/train_square.h makes one), on a square
// of kFoamMapSize points a side: point [j * kFoamMapSize + i] lies at min_world + (i, j) size_m /
// kFoamMapSize. Never changed once it is made.
struct TrainSquare {
  glm::dvec2 min_world{0.0};
  double size_m = 0.0;
  // By train.
  std::vector<double> period_s;
  std::vector<float> weight;  // the sum of their squares is 1
  // By train, then by point: theta of sample_trains() in 2^-16 cycles.
  std::vector<std::uint16_t> phase;
  // By point: what there is of the trains' whitecaps, over 1 in the surf of a gale, and of those of
  // shorter waves, in [0, 1]: in shallow water surf takes their place.
  std::vector<float> part, short_part;
};

// How whitecaps of trains are made.
struct TrainFoam {
  float gain = 0.0f, scale = 1.0f;  // B' = scale (B + gain C)
  float threshold = 0.0f;           // of B'
  // Where the square's columns and rows lie in the longest patch: texels of kFoamMapSize a side,
  // and how far past them, [0, 1].
  std::vector<std::uint8_t> column, row;
  std::vector<float> past_column, past_row;
};

// What does not change with time.
struct Whitecaps {
  SeaDescription sea;  // whose they are
  FftPlan plan;
  std::vector<FoamPatch> patches;  // at most kMostFoamPatches, longest first; none without foam
  double step_s = 0.0;             // between two times of the foam
  int steps_in_loop = 0;           // 0: the sea does not repeat
  float crest_per_m = 0.0f;        // for foam_on_crest()
  std::shared_ptr<const TrainSquare> trains;  // none: the open sea alone
  TrainFoam on_trains;                        // with the first patch's cover and decay
};

// Finds the thresholds by trying them on a minute of the sea: 25 ms, with trains 40. No patches up
// to 3.7 m/s, for seas without a spectrum, and with sea.whitecaps = 0. The same bits with any
// workers.
Whitecaps make_whitecaps(const Sea& sea, Workers& workers,
                         std::shared_ptr<const TrainSquare> trains = nullptr);

// Foam at one time.
struct WhitecapFrame {
  // Codes at the steps before and after that time, kFoamMapSize points a side: sample
  // [j * kFoamMapSize + i] is at world x = i L / n, y = j L / n.
  struct Patch {
    double length_m = 0.0;
    PatchTiling tiling;      // the waves'
    int wave_samples = 128;  // points a side of the waves' patch, which tiles are moved by
    std::vector<std::uint8_t> before, after;
  };
  std::vector<Patch> patches;
  // The trains' whitecaps, likewise, over the square, in foam_of_trains()'s unit; none: no trains,
  // or no foam.
  std::shared_ptr<const TrainSquare> trains;
  std::vector<std::uint16_t> trains_before, trains_after;
  float past = 0.0f;         // part of the step that has passed, [0, 1]: foam goes from before to
                             // after along a straight line
  float crest_per_m = 0.0f;  // as Whitecaps has it
  // Whose foam it is, if any's, and the number of the step before.
  bool is_filled = false;
  SeaDescription sea;
  double step = 0.0;
  // Storage; codes of the trains at the step after.
  std::vector<std::uint8_t> trains_codes;
  std::vector<float> breaking_a, breaking_b, fft_planes;
};

// The part of the surface that is white where foam has this code: it goes fast at first, and then
// ever more slowly.
constexpr float foam_of_code(std::uint8_t code) {
  const float life = static_cast<float>(code) / 255.0f;
  return life * life;
}
constexpr float foam_of_trains(std::uint16_t value) {
  return static_cast<float>(value) / (255.0f * 255.0f);
}

// Fills `frame` with the foam at t_s, any finite time: the same bits whatever it held before. In
// the same step as the last call, or the next, this takes no field or one (0.3 ms on one thread,
// with trains 0.7), else 255 / decay of them (10 ms, with trains 25). Allocates nothing once filled
// from a sea of as many patches.
void advance_whitecaps(const Whitecaps& whitecaps, double t_s, WhitecapFrame& frame,
                       Workers& workers);

// The part of the surface that is white at world points where it is height_m high, in [0, 1]: the
// mean over the lace that pictures draw, which is finer than a map's texel. Bilinear. Where trains
// are, `ceded` of the longest patch's foam makes room for theirs; empty: nothing. Spans of one
// length, points below 1e9 m.
void sample_whitecaps(const WhitecapFrame& frame, std::span<const glm::dvec2> p_world,
                      std::span<const float> height_m, std::span<float> foam,
                      std::span<const float> ceded = {});

}  // namespace swell::ocean
