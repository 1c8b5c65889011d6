// Runs a simulation: what is due is made and given to the outputs, by a clock of its own or by one
// from outside.
#pragma once

#include <span>

#include "apps/messages/message_output.h"
#include "apps/sim/costs.h"
#include "apps/sim/inputs.h"
#include "apps/sim/simulation.h"
#include "math/parallel.h"

namespace swell::apps {

struct RunSettings {
  double duration_s = 10.0;   // from first_ns or the outside clock's first time on; may be infinite
  bool realtime = false;      // by its own clock: wait for each stamp
  std::int64_t first_ns = 0;  // the first stamp of its own clock
  // In real time, whose first stamp's moment comes so much after the begin: messages are made so
  // much earlier than they are given, so that what one sensor takes makes no other late. 0 where
  // something comes from outside, which is taken until the stamp.
  std::int64_t ahead_ns = 0;
  // Lock-step with the inputs' clock: all that is due up to a time that it shows is published, then
  // the next one is waited for.
  bool is_clock_input = false;
  bool measure = false;  // in real time: keep how late each message is
};

// Publishes all messages in the order of their stamps until the duration is over, the outside clock
// has ended or is_stopped() holds, then finishes the outputs; without one the messages are only
// made. In lock-step a moment that has begun is published whole. Outputs are written to by a thread
// of their own. `poses` is what the simulation's bodies from outside look at.
Costs run_simulation(const Simulation& simulation, const RunSettings& settings,
                     std::span<MessageOutput* const> outputs, Inputs& inputs, InputPoses& poses,
                     FunctionRef<bool()> is_stopped);

}  // namespace swell::apps
