// Lidars: clouds of points.
#pragma once

#include "apps/sim/simulation.h"

namespace swell::scene {
struct Sensor;
}

namespace swell::apps {

class SimWorld;

// Of a lidar of the rig, which has to outlive it, as the world has. Its topic NAME/points has a
// cloud for each scan, in the sensor's frame, of a row for each beam of the model from the lowest
// up (of a grid: each row from the top) and a column for each direction in turn. Fields are those
// of drivers of Ouster's and Velodyne's: x, y, z (NaN: nothing came back), intensity in [0, 1], t
// in ns after the stamp, when the beam left, ring, the number of its row; and class and id, if the
// rig wants them, 0 where nothing came back.
Publish lidar(const scene::Sensor& sensor, SimWorld& world, Simulation& simulation);

}  // namespace swell::apps
