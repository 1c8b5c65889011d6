// The thin sheets of water that waves send up the beach and back: where their edge is, as a height
// on the beach. Pictures draw them over the sand, beyond where the sea's surface ends.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "ocean/coast/coast.h"
#include "ocean/coast/shelter.h"
#include "ocean/open_sea/sea.h"

namespace swell::ocean {

// Over x and y metres the sheets' coming and going shifts by a cycle: two slow lags, and the lobes
// of the edge.
inline constexpr std::array<glm::dvec2, 3> kSwashLags_m = {
    {{310.0, 230.0}, {-97.0, 71.0}, {17.0, 23.0}}};

struct Swash {
  double reach_m = 0.0;              // height on the beach that sheets reach in the open; 0: none
  double period_s = 1.0;             // of the slowest waves
  const Shelter* shelter = nullptr;  // lessens the reach; null: nowhere
};

// Makes a swash whose reach is a tenth of the coast's TrainSea::height_bound_m, or without trains
// of the sea's significant height. There is none where neither a coast nor a shelter says that
// there is a shore; both may be null. The shelter has to outlive the swash.
Swash make_swash(const Sea& sea, const CoastSea* coast, const Shelter* shelter);

// Height of the edge over the sea's level at p_world and wave_time_s(t): sand below it is covered.
// As the picture's, but for rounding and, in a lee, 0.4 % of the reach.
double swash_edge_m(const Swash& swash, double wave_time_s, glm::dvec2 p_world);

}  // namespace swell::ocean
