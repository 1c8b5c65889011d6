// Where many rays out of the air meet the water, side by side: a batch of heights costs a fifth of
// as many single ones (ocean/water_surface.h has the single ray).
#pragma once

#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "ocean/water_surface.h"

namespace swell::ocean {

// What a frame's surface stays within, without its wakes, and these by squares: less than all waves
// at any time may add anywhere.
struct FrameBounds {
  struct Square {
    double height_m = 0.0, slope = 0.0;
  };
  struct Wake {
    static constexpr int kSquares = 8;  // a side
    glm::dvec2 corner_m{0.0};
    double square_m = 1.0;
    double height_m = 0.0;                                           // anywhere
    std::array<Square, std::size_t{kSquares} * kSquares> squares{};  // by rows
  };
  // The surface lies within rest_m of one that is no steeper: short waves are steep but low.
  struct Detail {
    double rest_m = 0.0, steepest = 0.0;
  };
  static constexpr std::size_t kMostDetails = 3;

  double lowest_m = 0.0, highest_m = 0.0;
  std::vector<Detail> details;  // the first one: of the surface itself
  std::vector<Wake> wakes;
  // Of rivers and lakes, whose levels end at their banks: rays walk over the higher of water and
  // ground, which has no steps. Else null.
  const terrain::HeightGrid* banks = nullptr;
};

// Slopes of the ground where rays come: of what is less than shallow_depth_m() under water
// (ocean/water.h), and of all.
struct GroundSlopes {
  double shallow = 1.0, all = 1.0;
};

// 0.1 ms a wake and 20 us a patch of 128 x 128 samples. The parts outlive the bounds.
FrameBounds frame_bounds(const WaterParts& water, const SeaFrame& frame,
                         const GroundSlopes& ground);

// Ray i: origin + s along, 0 <= s <= farthest_m; `along` of length 1. All spans have one length.
struct AirRays {
  std::span<const glm::dvec3> origin_world, along;
  std::span<const double> farthest_m;
};

// The distance at which each ray first meets the surface; infinity: it does not, 0: it begins under
// it. To 10 um, and of waves within the bounds every crest: steps are as long as
// the steepest waves allow, but no shorter than 2 cm + s / 5000, which may pass a tip of so little.
// The same bits for a ray with any others beside it. Allocates nothing; 1 us a ray.
void meet_water(const WaterSurface& water, const FrameBounds& bounds, const AirRays& rays,
                std::span<double> met_m);

}  // namespace swell::ocean
