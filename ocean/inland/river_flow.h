// How rivers flow: a stream function psi from the distances to their banks, whose level lines the
// water follows, so that none is lost and none flows through a bank.
//
//   psi(p) = sum w(d_i) psi_i / sum w(d_i)      over banks i at distances d_i
//   w(d)   = f(1 - d / s) / d for 0 < d < s, else 0;  f(t) = 6 t^5 - 15 t^4 + 10 t^3
//   v      = (dpsi/dy, -dpsi/dx)
//
// psi on a river's left bank is what it is on the right one plus the water that flows between them.
// Where a river joins another, each of its banks goes on as one of the other's; so does the bank of
// an island. What stands in the water is a bank, too, with the psi that there would be at its
// middle without it; q sizes from there, 1 on its outline, it weighs
//
//   w(q) = W f(1 - (q - 1) / 5) / (q^2 - 1)     W: the sum of w over the banks at its middle
//
// which rises as 1 / d towards the outline, so that the water goes along it, and falls as 1 / d^2
// further off: around a circle in a wide channel the flow is that of an ideal fluid,
// psi = U y (1 - 1 / q^2). With 1 / d throughout a post would hold back half a river. Source: Yu,
// Neyret, Bruneton, Holzschuch, Scalable real-time animation of rivers, 2009; s is three times the
// width there, with which water is as fast at the bank as in the middle within a third.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "ocean/inland/obstacle.h"
#include "ocean/inland/river_network.h"
#include "ocean/inland/segment_index.h"

namespace swell::ocean {

// A piece of a bank, in the direction of the flow.
struct BankPiece {
  Segment segment;  // its reach is s
  double psi = 0.0;
  std::uint32_t bank = 0;  // pieces of one number are one bank, with one psi
  bool on_left = false;    // of the water
};

inline constexpr double kFlowDifference_m = 0.01;
inline constexpr double kObstacleReach = 6.0;  // sizes from the middle, where w(q) is 0

// Read-only after it is made.
class RiverFlow {
 public:
  // Around `obstacles`, each widened by widened_m. Those nearer to each other, or to a bank, than
  // half of half their lesser size are one, with one psi; what is one with two banks would dam the
  // river, and counts for nothing. Throws RiverError where joints do not fit together: a river that
  // joins on one side and whose water cannot come from there, an end that does not leave the river
  // that it joins.
  explicit RiverFlow(const RiverNetwork& network, std::span<const Obstacle> obstacles = {},
                     double widened_m = 0.0);

  // [m^2/s]; nothing where no bank is near.
  std::optional<double> psi(glm::dvec2 p) const;
  // [m/s], by central differences of psi between places half_m away, which is the mean over twice
  // that length; 0 where there is none. For places in the water: beyond a bank it flows on as if
  // mirrored. Inside an obstacle it is 0.
  glm::dvec2 velocity(glm::dvec2 p, double half_m = kFlowDifference_m) const;

  const std::vector<BankPiece>& banks() const { return banks_; }

  // What the water flows around.
  struct Standing {
    Obstacle outline;  // widened
    double psi = 0.0;
    double weight = 0.0;      // W; 0: it would dam the river
    double half_speed = 0.0;  // half its lesser size times the speed at its middle without it
  };
  const std::vector<Standing>& standing() const { return standing_; }
  // The numbers of all that change psi at p, and of some that do not.
  std::span<const std::uint32_t> standing_near(glm::dvec2 p) const { return around_.near(p); }
  // Whether any of them changes psi at p, and whether p lies inside one, be it a dam.
  bool is_parted(glm::dvec2 p) const;
  bool is_blocked(glm::dvec2 p) const;

 private:
  // What banks say of psi, their weights as if none were nearer than least_m.
  struct Banks {
    double sum = 0.0, weights = 0.0;
    bool on_bank = false;  // then sum is its psi
  };
  Banks banks_at(glm::dvec2 p, double least_m) const;
  std::vector<std::uint32_t> banks_beside(const RiverNetwork& network, const Obstacle& outline,
                                          double narrow_m) const;
  void add_obstacles(const RiverNetwork& network, std::span<const Obstacle> obstacles,
                     double widened_m);

  std::vector<BankPiece> banks_;
  SegmentIndex index_;
  std::vector<Standing> standing_;
  SegmentIndex around_;  // of standing_
};

// [m/s] at a place of the network's water: `flow`, slowed where lakes and the sea slow it; 0 beside
// the water and in lakes. place: network.water_near(p). half_m: as for velocity().
glm::dvec2 river_current(const RiverFlow& flow, const WaterPlace& place, glm::dvec2 p,
                         double half_m = kFlowDifference_m);

}  // namespace swell::ocean
