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
  DriftTrack track(const Drifter& drifter) const {
    return make_drift_tracks(network, {}, {&drifter, 1}).front();
  }

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

// From a drifter's middle to the outline of what stands there.
double metres_from(const Obstacle& o, glm::dvec2 p) {
  double least_m = HUGE_VAL;
  for (const glm::dvec2& edge : outline_of(o)) least_m = std::min(least_m, glm::distance(p, edge));
  return sizes_from(o, p) < 1.0 ? -least_m : least_m;
}

std::vector<DriftTrack> tracks_of(const RiverNetwork& network,
                                  const std::vector<Obstacle>& obstacles,
                                  const std::vector<Drifter>& drifters) {
  return make_drift_tracks(network, obstacles, drifters);
}

double last_end_s(const std::vector<DriftTrack>& tracks) {
  double end_s = 0.0;
  for (const DriftTrack& track : tracks) end_s = std::max(end_s, track.end_s());
  return end_s;
}

// Across the river at s_m of its course.
Drifter drifter_at(const RiverNetwork& network, double s_m, double across, double radius_m) {
  const CourseNode node = node_at(network.courses()[0], s_m);
  return {node.p + across * node.half_width_m * node.left(), node.along, 1.9 * radius_m, radius_m};
}

TEST(Drift, PassesWhatStandsInTheRiverNoNearerThanItsOwnSize) {
  const RiverNetwork network(std::vector<River>{winding(), arm()}, {});
  std::vector<Obstacle> rocks;
  for (const auto& [s_m, across] : {std::pair(120.0, 0.0),
                                    {200.0, 0.8},
                                    {350.0, -0.4},
                                    {430.0, 0.3},
                                    {433.0, 0.0},
                                    {600.0, -0.9},
                                    {760.0, 0.5}}) {
    const Drifter at = drifter_at(network, s_m, across, 1.0);
    rocks.push_back({at.p, at.ahead, {1.4, 2.0}, s_m != 350.0});
  }
  for (const double across : {-0.85, -0.4, -0.05, 0.0, 0.2, 0.5, 0.85}) {
    const DriftTrack track = tracks_of(network, rocks, {drifter_at(network, 15.0, across, 1.7)})[0];
    double least_m = HUGE_VAL;
    for (double t_s = 0.0; t_s < track.end_s(); t_s += 0.2)
      for (const Obstacle& rock : rocks)
        least_m = std::min(least_m, metres_from(rock, track.at(t_s).p));
    EXPECT_GT(least_m, 1.69) << across;
    EXPECT_GT(track.at(1e9).p.x, 430.0) << across;
  }
}

// The water before its bow would hold it for ever.
TEST(Drift, IsNotHeldByARockStraightAhead) {
  const RiverNetwork network(std::vector<River>{straight(40.0, 0.7)}, {});
  const std::vector<Obstacle> rock = {{{0.0, 0.0}, {0.0, 1.0}, glm::dvec2(2.0)}};
  const DriftTrack track = tracks_of(network, rock, {{{-60.0, 0.0}, {1.0, 0.0}, 3.0, 1.6}})[0];
  double passes_s = 0.0;
  while (passes_s < 1000.0 && track.at(passes_s).p.x < 30.0) passes_s += 1.0;
  EXPECT_LT(passes_s, 90.0 / 0.77 + 30.0);
  double least_m = HUGE_VAL;
  for (double t_s = 0.0; t_s < passes_s; t_s += 0.1)
    least_m = std::min(least_m, metres_from(rock[0], track.at(t_s).p));
  EXPECT_GT(least_m, 1.59);
  EXPECT_LT(least_m, 2.2);
}

TEST(Drift, WaitsBeforeWhatDamsTheRiver) {
  const RiverNetwork network(std::vector<River>{straight(20.0, 0.7)}, {});
  const std::vector<Obstacle> dam = {{{0.0, 0.0}, {0.0, 1.0}, {1.0, 12.0}, false}};
  const DriftTrack track = tracks_of(network, dam, {{{-60.0, 3.0}, {1.0, 0.0}, 3.0, 1.6}})[0];
  EXPECT_LT(track.at(1e9).p.x, -2.5);
  EXPECT_GT(track.at(1e9).p.x, -4.5);
}

// Nine of several sizes, which narrows press together, and rocks.
TEST(Drift, DriftersAreNeverNearerToEachOtherThanTheirSizes) {
  River narrows = straight(24.0, 0.8);
  narrows.path_m = {{-130.0, 0.0}, {-20.0, 12.0}, {60.0, -10.0}, {180.0, 0.0}};
  narrows.width_m = {24.0, 11.0, 22.0, 26.0};
  narrows.surface_m = {1.0, 0.6, 0.3, 0.0};
  const RiverNetwork network(std::vector<River>{narrows}, {});
  std::vector<Obstacle> rocks;
  for (const auto& [s_m, across] : {std::pair(70.0, 0.3), {165.0, -0.1}, {200.0, 0.5}}) {
    const Drifter at = drifter_at(network, s_m, across, 1.0);
    rocks.push_back({at.p, at.ahead, {1.0, 1.5}});
  }
  std::vector<Drifter> drifters;
  for (const double s_m : {10.0, 20.0, 45.0})
    for (const double across : {-0.6, 0.05, 0.65})
      drifters.push_back(
          drifter_at(network, s_m, across, 1.0 + 0.1 * static_cast<double>(drifters.size() % 7)));
  const std::vector<DriftTrack> tracks = tracks_of(network, rocks, drifters);
  std::vector<glm::dvec2> p(tracks.size());
  double least = HUGE_VAL, least_alone = HUGE_VAL, to_rock_m = HUGE_VAL;
  std::vector<DriftTrack> alone;
  for (const Drifter& d : drifters) alone.push_back(tracks_of(network, rocks, {d})[0]);
  const auto nearest_pair = [&](const std::vector<DriftTrack>& of, double t_s) {
    double least_ratio = HUGE_VAL;
    for (std::size_t i = 0; i < of.size(); ++i) p[i] = of[i].at(t_s).p;
    for (std::size_t i = 0; i < of.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        least_ratio = std::min(
            least_ratio, glm::distance(p[i], p[j]) / (drifters[i].radius_m + drifters[j].radius_m));
    return least_ratio;
  };
  for (double t_s = 0.0; t_s < last_end_s(tracks); t_s += 0.23) {
    least_alone = std::min(least_alone, nearest_pair(alone, t_s));
    least = std::min(least, nearest_pair(tracks, t_s));
    for (std::size_t i = 0; i < p.size(); ++i)
      for (const Obstacle& rock : rocks)
        to_rock_m = std::min(to_rock_m, metres_from(rock, p[i]) - drifters[i].radius_m);
  }
  EXPECT_GE(least, 1.0);
  EXPECT_GT(to_rock_m, -0.01);
  // Without the rule some would pass through each other.
  EXPECT_LT(least_alone, 0.8);
  for (std::size_t i = 0; i < tracks.size(); ++i) EXPECT_GT(tracks[i].at(1e9).p.x, 120.0) << i;
}

TEST(Drift, IsAsIfAloneWhereItMeetsNone) {
  const RiverNetwork network(std::vector<River>{winding()}, {});
  const std::vector<Drifter> drifters = {drifter_at(network, 15.0, 0.3, 1.0),
                                         drifter_at(network, 300.0, -0.2, 2.0)};
  const std::vector<DriftTrack> both = tracks_of(network, {}, drifters);
  for (std::size_t i = 0; i < 2; ++i) {
    const DriftTrack alone = tracks_of(network, {}, {drifters[i]})[0];
    for (double t_s = 0.0; t_s < 300.0; t_s += 7.0)
      EXPECT_EQ(both[i].at(t_s).p, alone.at(t_s).p) << t_s;
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
