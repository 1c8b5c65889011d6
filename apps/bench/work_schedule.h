// swell-bench scaling: how long a recorded frame takes on more threads.
#pragma once

#include <span>
#include <vector>

#include "apps/bench/work_record.h"

namespace swell::apps {

// List scheduling: a thread that is free takes what waits, the code after a loop before bodies of
// other loops, bodies in the order of their indices. Each takes as long as it took alone; starting
// and ending loops costs nothing. threads >= 1.
// Source: Graham, "Bounds on Multiprocessing Timing Anomalies", 1969.
double schedule_us(std::span<const WorkPart> parts, int threads);

}  // namespace swell::apps
