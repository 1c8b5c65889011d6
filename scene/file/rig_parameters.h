// Every key of rigs in tables that drive reading, checks, defaults and the text of the keys.
#pragma once

#include <vector>

#include "scene/file/parameters.h"
#include "scene/file/rig.h"

namespace swell::scene {

inline constexpr std::string_view kBodiesKey = "body", kBodyPathKey = "path";
inline constexpr std::size_t kMostBodies = 100, kMostSensorsOfAKind = 500;

// Keys at the top.
std::vector<Parameter<Rig>> rig_parameters();

// Keys of one table of [[body]], and of one of [[body.path]].
std::vector<Parameter<RigBody>> body_parameters();
std::vector<Parameter<Waypoint>> body_path_parameters();

// Keys of one sensor's table.
std::vector<Parameter<Sensor>> sensor_parameters(SensorKind kind);

// A waypoint of a body, and a sensor of the kind, before its table is read.
Waypoint common_waypoint();
Sensor common_sensor(SensorKind kind);

}  // namespace swell::scene
