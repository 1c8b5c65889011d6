// What a simulation's sources cost, and whether real time was held.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/sim/simulation.h"

namespace swell::apps {

struct Cost {
  int count = 0;
  double sum_ms = 0.0, most_ms = 0.0;

  void add(double ms);
};

// When the messages of a source were given, in real time.
struct GivenStamps {
  std::int64_t count = 0;  // of stamps
  std::int64_t first_ns = 0, last_ns = 0;
  double first_s = 0.0, last_s = 0.0;  // since the run's begin

  void add(std::int64_t stamp_ns, double given_s);
  // Stamps between the first and the last of which nothing was given.
  std::int64_t skipped(double rate_hz) const;
  // By what share of it the mean period was longer; 0 where there is none.
  double slow(double rate_hz) const;
};

struct GivenMessages {
  Cost cost;                         // of giving a message to the outputs
  std::int64_t last_stamp_ns = 0;    // of the last one
  std::vector<float> late_ms;        // in real time: of each message, once it was given
  std::vector<GivenStamps> sources;  // likewise, in the simulation's order
};

struct Costs {
  std::vector<Cost> sources;  // of making the messages of one stamp, in the simulation's order
  GivenMessages given;
  double duration_s = 0.0, wall_s = 0.0;
};

// A row for each source, one for the output and how fast all of it was. In real time how late the
// messages were, too, and whether it was held: no stamp skipped, mean periods within 0.1 % of those
// asked for, 99 % of messages given at most 50 ms after their stamps.
std::string cost_table(const Simulation& simulation, const Costs& costs);

}  // namespace swell::apps
