// How rivers flow: a stream function psi from the distances to their banks, whose level lines the
// water follows, so that none is lost and none flows through a bank.
//
//   psi(p) = sum w(d_i) psi_i / sum w(d_i)      over banks i at distances d_i
//   w(d)   = f(1 - d / s) / d for 0 < d < s, else 0;  f(t) = 6 t^5 - 15 t^4 + 10 t^3
//   v      = (dpsi/dy, -dpsi/dx)
//
// psi on a river's left bank is what it is on the right one plus the water that flows between them.
// Where a river joins another, each of its banks goes on as one of the other's; so does the bank of
// an island. Source: Yu, Neyret, Bruneton, Holzschuch, Scalable real-time animation of rivers,
// 2009; s is three times the width there, with which water is as fast at the bank as in the middle
// within a third.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

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

// Read-only after it is made.
class RiverFlow {
 public:
  // Throws RiverError where joints do not fit together: a river that joins on one side and whose
  // water cannot come from there, an end that does not leave the river that it joins.
  explicit RiverFlow(const RiverNetwork& network);

  // [m^2/s]; nothing where no bank is near.
  std::optional<double> psi(glm::dvec2 p) const;
  // [m/s], by central differences of psi over 2 cm; 0 where there is none. For places in the water:
  // beyond a bank it flows on as if mirrored.
  glm::dvec2 velocity(glm::dvec2 p) const;

  const std::vector<BankPiece>& banks() const { return banks_; }

 private:
  std::vector<BankPiece> banks_;
  SegmentIndex index_;
};

// [m/s] at a place of the network's water: `flow`, slowed where lakes and the sea slow it; 0 beside
// the water and in lakes. place: network.water_near(p).
glm::dvec2 river_current(const RiverFlow& flow, const WaterPlace& place, glm::dvec2 p);

}  // namespace swell::ocean
