// For makers of maps: fills in what a map's codes say of it.
#pragma once

#include "ocean/open_sea/periodic_map.h"

namespace swell::ocean {

// The variances and the peak of a map that has its codes.
void measure(PeriodicMap& map);

}  // namespace swell::ocean
