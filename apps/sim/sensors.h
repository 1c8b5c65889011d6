// The sensors, bodies and the clock of a rig, as what publishes their messages.
#pragma once

#include "apps/sim/simulation.h"

namespace swell::apps {

class SimWorld;

// All that a rig publishes; the world has to outlive it. Throws scene::SceneError for a lens that
// draws no picture.
Simulation make_simulation(SimWorld& world);

}  // namespace swell::apps
