// Cameras: pictures, labels as pictures, and what the camera is.
#pragma once

#include "apps/sim/simulation.h"

namespace swell::scene {
struct Sensor;
}

namespace swell::apps {

class SimWorld;

// Of a camera of the rig, which has to outlive it, as the world has. Throws scene::SceneError for a
// lens that draws no picture.
Publish camera(const scene::Sensor& sensor, SimWorld& world, Simulation& simulation);

}  // namespace swell::apps
