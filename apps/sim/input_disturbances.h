// What disturbs the water from outside: drops, footsteps, rotors, kept by their stamps.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/sim/simulation.h"
#include "ocean/wakes/disturbance.h"

namespace swell::apps {

struct StampedDisturbance {
  std::int64_t stamp_ns = 0;         // when it is there, or a rotor begins
  ocean::Disturbance disturbance{};  // t_s is not looked at
};

// Answers depend on what was added, in which order, and on the horizon alone. Used by one thread at
// a time.
class InputDisturbances {
 public:
  // At most 256 are kept: the last ones that were added.
  void add(const StampedDisturbance& disturbance);

  void forget_all() { kept_.clear(); }

  // Those after this moment are not looked at, those that ended 10 minutes before it no longer
  // kept: their waves have left.
  void set_horizon(const Moment& moment);

  // Those that are there at a moment or were before.
  std::vector<ocean::Disturbance> at(const Moment& moment) const;

 private:
  std::vector<StampedDisturbance> kept_;
  std::int64_t horizon_ns_ = 0;
};

}  // namespace swell::apps
