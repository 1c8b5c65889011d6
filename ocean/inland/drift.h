// Where what floats on a river goes with it: along a level line of the stream function, past what
// stands there and past each other, worked out once, so that a place is a function of the time
// alone.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <utility>
#include <vector>

#include "ocean/inland/obstacle.h"
#include "ocean/inland/river_flow.h"
#include "ocean/inland/river_network.h"

namespace swell::ocean {

// What drifts: where at t = 0, and its size.
struct Drifter {
  glm::dvec2 p{0.0};           // world, of its middle
  glm::dvec2 ahead{0.0, 1.0};  // unit, where it points
  double length_m = 1.0;       // along `ahead`
  double radius_m = 0.5;       // of a circle around all of it
};

struct DriftPlace {
  glm::dvec2 p{0.0};
  double turned_rad = 0.0;  // since t = 0, counterclockwise
};

// Where one is at any time. Read-only after it is made.
class DriftTrack {
 public:
  struct Point {
    double t_s = 0.0;
    DriftPlace place, per_s;
    bool is_straight = false;  // from here to the next point, as it was in the way of another
  };

  // One point or more, in the order of time.
  explicit DriftTrack(std::vector<Point> points) : points_(std::move(points)) {}

  // Before 0 where it begins, and at last where its way ends. Between points a cubic with the
  // water's velocities, less than 1e-3 of the width off the level line.
  DriftPlace at(double t_s) const;

  double end_s() const { return points_.back().t_s; }

 private:
  std::vector<Point> points_;
};

// The ways of all drifters of a network, from t = 0 on. The middle of each goes with the water,
// d p / dt = v(p), and keeps its psi; the current at bow and stern turns it.
//   - For it what stands in the water is wider by its radius: so it passes at that distance. A lane
//     that leads straight onto such an outline is moved aside by a tenth of half its size, or water
//     that stands before it would hold it.
//   - Drifters make their steps one after the other, first the one whose last step ended first. One
//     that would come nearer to another than their radii add up to goes along it instead, or stays
//     if there is no room, and then keeps the psi that it has come to.
// Who begins nearer than that to an obstacle or to another keeps the distance that it has. A way
// ends where the water is slower than kDriftEnds_mps: in a lake, in the sea; where nothing moves
// any more; or after kMostDriftSteps steps of at most a twentieth of the river's width each,
// shorter ones near others, 0.03 ms each. One that meets none goes as if it were alone, to the bit.
std::vector<DriftTrack> make_drift_tracks(const RiverNetwork& network,
                                          std::span<const Obstacle> obstacles,
                                          std::span<const Drifter> drifters);

inline constexpr double kDriftEnds_mps = 0.01;
inline constexpr int kMostDriftSteps = 40000;

// Whether a river's water flows at p, faster than kDriftEnds_mps.
bool drifts_at(const RiverNetwork& network, const RiverFlow& flow, glm::dvec2 p);

}  // namespace swell::ocean
