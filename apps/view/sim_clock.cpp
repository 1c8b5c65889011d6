#include "apps/view/sim_clock.h"

namespace swell::view {

void tick(SimClock& clock, double dt_s) {
  const bool single = clock.paused && clock.step_once;
  clock.step_once = false;
  if (clock.paused && !single) return;
  if (clock.by_steps) {
    ++clock.steps;
    clock.t_s = static_cast<double>(clock.steps) / kStepsPerSecond;
  } else {
    clock.t_s += single ? 1.0 / kStepsPerSecond : dt_s;
  }
}

}  // namespace swell::view
