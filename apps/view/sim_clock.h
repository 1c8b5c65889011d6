// The time that the viewer shows: it runs with the wall clock, or by exact steps of 1/60 s, and
// can stand still.
#pragma once

#include <cstdint>

namespace swell::view {

inline constexpr double kStepsPerSecond = 60.0;

struct SimClock {
  bool by_steps = false;  // step k is at k/60 s exactly, whatever the wall clock says
  bool paused = false;
  bool step_once = false;  // while paused: one step of 1/60 s at the next tick
  std::int64_t steps = 0;
  double t_s = 0.0;
};

// Moves the clock on after a frame that took dt_s >= 0 of wall time.
void tick(SimClock& clock, double dt_s);

}  // namespace swell::view
