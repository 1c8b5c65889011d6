// Maps for shading a coast: the slopes of its waves and the foam where they break, on a square of
// points, at any time. What does not depend on time is worked out once, small enough that a frame
// streams through it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/parallel.h"
#include "ocean/coast/coast.h"

namespace swell::ocean {

// Points that lie side by side in CoastMap::wave.
inline constexpr int kMapGroup = 16;

// Read-only after it is made. 8 bytes a point and train, 3 more a point.
struct CoastMap {
  int size = 0;  // points a side; point (i, j) lies at the grid's corner plus (i, j) side / size
  std::vector<double> period_s;  // by train
  float slope_unit = 1.0f;       // of the slope factors below
  // By group of a row, then by train: kMapGroup phases in 2^-16 cycles, kMapGroup slope factors
  // (share x amplitude x dtheta/dx, signed) in x and in y, kMapGroup parts that the shore's profile
  // has, in 2^-16.
  std::vector<std::uint16_t> wave;
  std::vector<std::uint16_t> surf;    // by point: see breaking_part, in 2^-16
  std::vector<std::uint8_t> has_sea;  // by group: anything but zeros
};

// A point's cell in the trains' grid, held inside it, and its place there in cells.
struct PlaceInTrains {
  std::size_t cell;
  float x, y;
};
PlaceInTrains find_place(const TrainSea& sea, glm::dvec2 p_world);

// The still water's depth there, in metres; on land 0 or less.
float depth_at(const TrainSea& sea, const PlaceInTrains& at);

// A train there: theta of sample_trains(), not wrapped, and the amplitude.
struct TrainAtPlace {
  float cycles, amplitude_m;
};
TrainAtPlace train_at(const TrainSea& sea, std::size_t train, const PlaceInTrains& at);

// 0 where all waves pass, 1 where all crests that meet break: `sum_m`, the sum of the trains'
// amplitudes, against what water of depth_m carries. 0 on land.
double breaking_part(double sum_m, double depth_m);

// The same in the coast's band of surf, wider or narrower than where waves break: there it is by
// the highest of the coast's waves.
double breaking_part(const CoastSea& coast, double sum_m, double depth_m);

// A train's foam is 1 at its crest, grows from 0 over the twelfth of a wave before it and decays
// behind it, by the cube of what is left until the next crest. The trains' mean is stretched by
// these, so that one crest alone is little and crests that meet are white.
inline constexpr float kFoamGain = 2.2f, kFoamBias = -0.55f;

// size is a multiple of kMapGroup.
CoastMap make_coast_map(const CoastSea& coast, int size, Workers& workers);

// Fills size x size points, row by row, for time t_s (finite): the slopes of share x height, but
// for what the share's and the amplitudes' own slopes add (under 0.02 on beaches up to 1:20), and
// foam in [0, 1]: the trains' stretched mean times breaking_part. 0.4 ms for 256 x 256 points, half
// of them land, and 5 trains, one thread. The same bits on every SIMD target.
void bake_coast(const CoastMap& map, double t_s, std::span<float> slope_x, std::span<float> slope_y,
                std::span<float> foam, Workers& workers);

// The same foam anywhere, 0 beyond the grid; spans of one length. Allocates nothing. 100 ns a point
// and train.
void sample_surf_foam(const CoastSea& coast, double t_s, std::span<const glm::dvec2> p_world,
                      std::span<float> foam);

}  // namespace swell::ocean
