// What disturbs the water in one call, as the caller gives it.
#pragma once

#include <vector>

#include "ocean/wakes/disturbance.h"
#include "swell.h"

namespace swell::capi {

// Throws ArgumentError.
std::vector<ocean::Disturbance> given_disturbances(const swell_disturbance* disturbances,
                                                   std::size_t count);

}  // namespace swell::capi
