// What floats on a river keeps its stream line, at the water's speed.
#include "ocean/inland/drift.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ocean/example_rivers.h"

namespace swell::ocean {
namespace {

struct Waters {
  explicit Waters(const std::vector<River>& rivers) : network(rivers, {}), flow(network) {}
  DriftTrack track(const Drifter& drifter) const { return {network, flow, drifter}; }

  RiverNetwork network;
  RiverFlow flow;
};

double speed_of(const DriftTrack& track, double t_s) {
  return glm::distance(track.at(t_s + 0.005).p, track.at(t_s - 0.005).p) / 0.01;
}

// The middle of a straight channel runs 1.10 times the mean, half way to a bank 1.03 times.
TEST(Drift, GoesAsFastAsTheWaterOfAStraightChannel) {
  const Waters water({straight(20.0, 0.7)});
  for (const auto& [north_m, share] : {std::pair(0.0, 1.10), std::pair(-5.0, 1.03)}) {
    const DriftTrack track = water.track({{-500.0, north_m}, {1.0, 0.0}, 4.0});
    const DriftPlace at = track.at(300.0);
    EXPECT_NEAR(at.p.x + 500.0, 300.0 * 0.7 * share, 2.5);
    EXPECT_NEAR(at.p.y, north_m, 1e-6);
  }
}

// Slower water near the bank holds one end back.
TEST(Drift, IsTurnedByWaterThatIsFasterOnOneSide) {
  const Waters water({straight(20.0, 0.7)});
  constexpr double kLength_m = 4.0, kBegin_s = 1.0;
  const glm::dvec2 start(-300.0, 6.0);
  const DriftTrack across = water.track({start, {0.0, 1.0}, kLength_m});
  // The bow, further north, is slower: it falls back, to the left of where it points.
  const double shear = (water.flow.velocity(start + glm::dvec2(0.0, 2.0)).x -
                        water.flow.velocity(start - glm::dvec2(0.0, 2.0)).x) /
                       kLength_m;
  EXPECT_LT(shear, -0.005);
  EXPECT_NEAR(across.at(kBegin_s).turned_rad, -shear * kBegin_s, 0.02 * std::abs(shear));
  // What lies along the flow in the middle is not turned.
  EXPECT_NEAR(water.track({{-300.0, 0.0}, {1.0, 0.0}, kLength_m}).at(400.0).turned_rad, 0.0, 1e-6);
}

TEST(Drift, KeepsItsStreamLineAndGoesAsFastAsTheWaterAllTheWay) {
  const Waters water({winding(), arm()});
  const double all = water.network.discharge_m2_s(0, 1e9);
  for (const double across : {-0.9, -0.5, 0.0, 0.4, 0.85}) {
    const CourseNode node = node_at(water.network.courses()[0], 15.0);
    const Drifter drifter{node.p + across * node.half_width_m * node.left(), node.along, 3.0};
    const DriftTrack track = water.track(drifter);
    const double psi = *water.flow.psi(drifter.p);
    double worst_psi = 0.0;
    for (double t_s = 0.0; t_s < track.end_s(); t_s += 1.7) {
      const glm::dvec2 p = track.at(t_s).p;
      const auto place = water.network.water_near(p);
      ASSERT_LT(place->outside_m, 0.0) << p.x << " " << p.y;
      worst_psi = std::max(worst_psi, std::abs(*water.flow.psi(p) - psi));
      const double speed = glm::length(river_current(water.flow, *place, p));
      const bool is_on_its_way = t_s > 0.01 && t_s < track.end_s() - 60.0;
      if (is_on_its_way) {
        EXPECT_NEAR(speed_of(track, t_s), speed, 0.03 * speed + 1e-3) << t_s;
      }
    }
    EXPECT_LT(worst_psi, 1e-3 * all);
    // It comes to rest in the mouth.
    EXPECT_GT(track.at(1e9).p.x, 430.0) << across;
    EXPECT_EQ(track.at(1e9).p, track.at(track.end_s()).p);
  }
}

TEST(Drift, BeginsWhereItIsPutAndNotBefore) {
  const Waters water({straight(20.0, 0.7)});
  const DriftTrack track = water.track({{-500.0, 3.0}, {0.0, 1.0}, 2.0});
  for (const double t_s : {-1e9, -0.1, 0.0}) {
    EXPECT_EQ(track.at(t_s).p, glm::dvec2(-500.0, 3.0)) << t_s;
    EXPECT_EQ(track.at(t_s).turned_rad, 0.0) << t_s;
  }
}

TEST(Drift, NeedsFlowingWater) {
  const Waters water({straight(20.0, 0.7)});
  EXPECT_TRUE(drifts_at(water.network, water.flow, {0.0, 9.0}));
  EXPECT_FALSE(drifts_at(water.network, water.flow, {0.0, 11.0}));
  EXPECT_FALSE(drifts_at(water.network, water.flow, {0.0, 4000.0}));
}

}  // namespace
}  // namespace swell::ocean
