// A coast's wave trains as whitecaps know them (ocean/open_sea/whitecaps.h).
#pragma once

#include <memory>

#include "math/parallel.h"
#include "ocean/coast/coast.h"
#include "ocean/open_sea/whitecaps.h"

namespace swell::ocean {

// The square over the trains' grid, for waves of that significant height out at sea: their
// whitecaps fade where the water is less than an eighth of it deep, where surf is what is white. In
// a gale, from 11 to 20 m/s on, waves that break all the time in less than 0.4 of it leave four
// times as many, almost up to the shore: surf does not drain from one crest to the next.
// Weights are by the trains' steepness, their mean over the square. None (null) for trains without
// height. The same bits with any workers. 8 ms for 5 trains.
std::shared_ptr<const TrainSquare> make_train_square(const CoastSea& coast, double wave_height_m,
                                                     double wind_mps, Workers& workers);

// The whitecaps of a sea and of the trains of its coast; coast: null without one.
Whitecaps make_whitecaps(const Sea& sea, const CoastSea* coast, Workers& workers);

}  // namespace swell::ocean
