// Surf that follows the water boundary: four fronts run to every shore, each with a phase of its
// own along the shore and in time. Where they lift the water they are a wave source of their own
// (ocean/water.h); else they are foam alone, which pictures lay over the waves of the sea.
//
// A front comes every fourth wave of the sea: front n is at whole turns of
//   turns = t / (4 T) + tau(s) / (4 T) + n / 4 + lag_n(x, y),      n = 0, 1, 2, 3
// where tau = 2 sqrt(s / (g slope)) is the time that shallow water's waves need to the shore from
// the distance s over a beach of one slope. So fronts run at sqrt(g depth) there.
//
// Over one front the surface is
//   z = H (max over n of height_n f(turns_n) - kFrontMean)
// with f the front function (ocean/coast/front_function-inl.h): a long back, a steep face before
// it, the steeper the nearer the shore. H, from trough to crest, grows from nothing where waves
// begin to feel the floor to the sea's significant height where they begin to break; from there on
// it is at most 0.78 of the depth, and the crest leaves foam behind. Fronts are pure functions of
// place and time.
// Sources: Gabdrakhmanov, Modelling Interactive Water Surfaces, figures 6 and 7 (four fronts, one
// in each component of a vector); McCowan, On the Highest Wave of Permanent Type, 1894 (0.78).
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <tuple>
#include <vector>

#include "math/parallel.h"
#include "ocean/coast/front_clock.h"
#include "ocean/coast/shelter.h"
#include "ocean/open_sea/sea.h"
#include "ocean/spectrum/point_chunk.h"
#include "terrain/shore_map.h"

namespace swell::ocean {

// Where waves break before a shore.
struct SurfZone {
  double reach_m = 0.0, reach_s = 0.0;  // from the shore, and the time that waves need from there
  double depth_m = 0.0;                 // there, over the mean slope of the beach
  double period_s = 1.0;                // of waves that break
  static constexpr bool kPlainBytes = true;
};

// The zone before a shore, `land` without its apron, whose beach may be steeper. It is so many
// times as wide as the sea's height and the mean slope of the beach say, and at least
// kLeastSurfReach of the shore map's side.
inline constexpr double kLeastSurfReach = 2.5 / 512.0;
SurfZone find_surf_zone(const terrain::ShoreMap& shore, const terrain::Grid& land, const Sea& sea,
                        double surf_width);

// The distance from p to the shore over the zone's reach: negative on land. The zone is narrower
// where only a part of the surf is to run in; where none is, it is `none`.
float part_of_reach(const SurfZone& zone, const terrain::ShoreMap& shore, glm::dvec2 p, float none);

// Turns of the clock in a second: as often as 1 / (4 T), or of a sea that loops as near to it as
// may be.
double front_turns_per_s(const SurfZone& zone, const SeaDescription& sea);

// The clock at a time for places relative to `origin`.
FrontClock make_front_clock(const SurfZone& zone, const SeaDescription& sea, double t_s,
                            glm::dvec2 origin);

// A point of the fronts' square.
struct FrontPoint {
  float part = kFrontsFrom;  // distance to the shore over the reach, [-kFrontsFrom, kFrontsFrom]
  float share = 0.0f;        // the fronts' part in the surface, [0, 1]
  float height_m = 0.0f;     // H, as long as the depth allows it
  static constexpr bool kPlainBytes = true;
};

// Fronts that lift the water. Read-only after it is made; 12 bytes a point of the shore map.
struct SurfFronts {
  SurfZone zone;
  terrain::Grid grid;  // the shore map's
  std::vector<FrontPoint> points;
  // |z| and the slope in any direction are at most this, always; the share's slope [1/m].
  float height_bound_m = 0.0f, slope_bound = 0.0f, share_slope_per_m = 0.0f;

  auto fields() {
    return std::tie(zone, grid, points, height_bound_m, slope_bound, share_slope_per_m);
  }
};

// `land` as of find_surf_zone(). The same bits with any workers. 20 ms of one core.
SurfFronts make_surf_fronts(const terrain::ShoreMap& shore, const terrain::Grid& land,
                            const Sea& sea, const Shelter& shelter, double surf_width,
                            Workers& workers);

// The fronts at a place, bilinear; beyond the square there are none.
struct FrontPlace {
  FrontPoint at;
  glm::vec2 part_slope{0.0f};  // of the part [1/m]: points out to sea
};
FrontPlace place_in_fronts(const SurfFronts& fronts, glm::dvec2 p_world);

// H where the water is so deep.
inline float front_height_m(const FrontPoint& at, float depth_m) {
  const float most_m = kBreakingDepths * depth_m;
  return at.height_m < most_m ? at.height_m : most_m > 0.0f ? most_m : 0.0f;
}

// Places, and the fronts there.
struct FrontSamples {
  std::size_t count = 0;                            // of the arrays' places that are meant
  std::array<float, kPointChunk> x{}, y{}, part{};  // [m] from the clock's origin; as FrontPoint's
  // How high the fronts stand over their troughs, in parts of H, and its rate by turns.
  std::array<float, kPointChunk> lift, rate;
};

// Fills in lift and rate: the front function of the highest front. The same bits on every SIMD
// target.
void sample_front_function(const FrontClock& clock, FrontSamples& samples);

}  // namespace swell::ocean
