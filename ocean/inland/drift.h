// Where what floats on a river goes with it: along a level line of the stream function, worked out
// once, so that a place is a function of the time alone.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "ocean/inland/river_flow.h"
#include "ocean/inland/river_network.h"

namespace swell::ocean {

// What drifts: where at t = 0, and its length.
struct Drifter {
  glm::dvec2 p{0.0};           // world, of its middle
  glm::dvec2 ahead{0.0, 1.0};  // unit, where it points
  double length_m = 1.0;       // along `ahead`
};

struct DriftPlace {
  glm::dvec2 p{0.0};
  double turned_rad = 0.0;  // since t = 0, counterclockwise
};

// Read-only after it is made.
class DriftTrack {
 public:
  // The middle goes with the water, d p / dt = v(p), and keeps its psi; the current at bow and
  // stern turns it. The way ends where the water is slower than kDriftEnds_mps: in a lake, in the
  // sea; or after kMostDriftSteps steps of at most a twentieth of the river's width each, 0.03 ms
  // each.
  DriftTrack(const RiverNetwork& network, const RiverFlow& flow, const Drifter& drifter);

  // At any time: before 0 where it begins, and at last where its way ends. Between steps a cubic
  // with the water's velocities, less than 1e-3 of the width off the level line.
  DriftPlace at(double t_s) const;

  double end_s() const { return points_.back().t_s; }

 private:
  struct Point {
    double t_s = 0.0;
    DriftPlace place, per_s;
  };

  std::vector<Point> points_;
};

inline constexpr double kDriftEnds_mps = 0.01;
inline constexpr int kMostDriftSteps = 40000;

// Whether a river's water flows at p, faster than kDriftEnds_mps.
bool drifts_at(const RiverNetwork& network, const RiverFlow& flow, glm::dvec2 p);

}  // namespace swell::ocean
