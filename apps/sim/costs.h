// What a simulation's sources cost.
#pragma once

#include <string>
#include <vector>

#include "apps/sim/simulation.h"

namespace swell::apps {

struct Cost {
  int count = 0;
  double sum_ms = 0.0, most_ms = 0.0;

  void add(double ms);
};

struct Costs {
  std::vector<Cost> sources;    // of making the messages of one stamp, in the simulation's order
  Cost output;                  // of giving a message to the output
  std::vector<double> late_ms;  // in real time: of each message, when it was given
  double duration_s = 0.0, wall_s = 0.0;
};

// A row for each source, one for the output and how fast all of it was.
std::string cost_table(const Simulation& simulation, const Costs& costs);

}  // namespace swell::apps
