// Rivers part before what stands in them: it is a bank of its own of the stream function.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "ocean/example_rivers.h"
#include "ocean/inland/inland_water.h"
#include "ocean/inland/obstacle.h"
#include "ocean/inland/river_bed.h"
#include "ocean/inland/river_flow.h"
#include "ocean/inland/river_network.h"

namespace swell::ocean {
namespace {

glm::dvec2 at_angle(double turn_rad) { return {std::cos(turn_rad), std::sin(turn_rad)}; }

// Things of several shapes in the main river, away from its joints and from its banks.
std::vector<Obstacle> scattered(const RiverNetwork& network) {
  std::vector<Obstacle> all;
  int n = 0;
  for (const double s_m : {60.0, 160.0, 300.0, 420.0, 560.0, 800.0, 950.0}) {
    const CourseNode node = node_at(network.courses()[0], s_m);
    const double across = 0.35 * (n % 3 - 1);
    Obstacle o{node.p + across * node.half_width_m * node.left(), at_angle(0.7 * n)};
    o.half_m = n % 2 == 0 ? glm::dvec2(1.8, 1.8) : glm::dvec2(0.9, 2.4);
    o.is_round = n % 3 != 2;
    all.push_back(o);
    ++n;
  }
  return all;
}

std::vector<std::vector<River>> rivers_to_part() {
  return {{straight(20.0, 0.7)}, {winding()}, {winding(), tributary(true), arm()}};
}

double mean_speed(const RiverNetwork& network, glm::dvec2 p) {
  const CoursePlace place = place_on(network.courses()[0], p);
  return network.discharge_m2_s(0, place.node.s_m) / (2.0 * place.node.half_width_m);
}

// From the outline into the water.
glm::dvec2 outward(const Obstacle& o, glm::dvec2 p) {
  constexpr double h = 1e-6;
  return glm::normalize(
      glm::dvec2(sizes_from(o, p + glm::dvec2(h, 0)) - sizes_from(o, p - glm::dvec2(h, 0)),
                 sizes_from(o, p + glm::dvec2(0, h)) - sizes_from(o, p - glm::dvec2(0, h))));
}

// The water through a line, to its right, by the midpoint rule.
double flux_across(const RiverFlow& flow, glm::dvec2 from, glm::dvec2 to) {
  constexpr int kSteps = 400;
  const glm::dvec2 way = (to - from) / static_cast<double>(kSteps);
  double sum = 0.0;
  for (int k = 0; k < kSteps; ++k)
    sum += glm::dot(flow.velocity(from + (k + 0.5) * way), glm::dvec2(way.y, -way.x));
  return sum;
}

// An ideal fluid's flow around a cylinder: psi = U y (1 - a^2 / r^2), which stands at the bow, runs
// twice as fast at the flanks, and hardly knows of the cylinder ten radii away.
TEST(Obstacles, PartAWideChannelAsACylinderPartsAnIdealFluid) {
  const RiverNetwork network(std::vector<River>{straight(400.0, 0.7)}, {});
  constexpr double kRadius_m = 2.0;
  const std::vector<Obstacle> post = {{{0.0, 0.0}, {0.0, 1.0}, glm::dvec2(kRadius_m)}};
  const RiverFlow flow(network, post), open(network);
  const double u = open.velocity({0.0, 0.0}).x;
  EXPECT_NEAR(u, 0.7 * 1.10, 0.01);
  for (const double turn : {0.3, 1.0, 1.57, 2.2, 4.0})
    for (const double q : {1.1, 1.3, 1.6, 2.0}) {
      const glm::dvec2 p = q * kRadius_m * at_angle(turn);
      EXPECT_NEAR(*flow.psi(p) - *flow.psi({0.0, 0.0}), u * p.y * (1.0 - 1.0 / (q * q)),
                  0.02 * u * kRadius_m * q)
          << turn << " " << q;
    }
  EXPECT_NEAR(flow.velocity({0.0, kRadius_m + 0.011}).x, 2.0 * u, 0.03 * u);
  EXPECT_NEAR(flow.velocity({0.0, -kRadius_m - 0.011}).x, 2.0 * u, 0.03 * u);
  EXPECT_LT(glm::length(flow.velocity({-kRadius_m - 0.011, 0.0})), 0.03 * u);
  EXPECT_LT(glm::length(flow.velocity({kRadius_m + 0.011, 0.0})), 0.03 * u);
  EXPECT_NEAR(flow.velocity({0.0, 10.0 * kRadius_m}).x, open.velocity({0.0, 10.0 * kRadius_m}).x,
              1e-12);
}

TEST(Obstacles, NoWaterFlowsThroughTheirOutlines) {
  for (const std::vector<River>& rivers : rivers_to_part()) {
    const RiverNetwork network(rivers, {});
    const std::vector<Obstacle> all = scattered(network);
    const RiverFlow flow(network, all);
    const double discharge = network.discharge_m2_s(0, 0.0);
    for (const Obstacle& o : all) {
      const double speed = mean_speed(network, o.middle);
      double along = 0.0;
      for (const glm::dvec2& p : outline_of(o)) {
        EXPECT_NEAR(*flow.psi(p), *flow.psi(o.middle), 1e-9 * discharge);
        // By differences over 2 cm that do not reach into it.
        const glm::dvec2 out = outward(o, p), v = flow.velocity(p + 0.0145 * out);
        EXPECT_LT(std::abs(glm::dot(v, out)), 0.1 * speed) << p.x << " " << p.y;
        EXPECT_LT(std::abs(glm::dot(flow.velocity(p + 0.1 * out), out)), 0.5 * speed);
        along = std::max(along, glm::length(v));
        EXPECT_EQ(flow.velocity(o.middle + 0.9 * (p - o.middle)), glm::dvec2(0.0));
      }
      EXPECT_GT(along, 1.2 * speed);
    }
  }
}

TEST(Obstacles, LeaveTheFlowWithoutDivergence) {
  for (const std::vector<River>& rivers : rivers_to_part()) {
    const RiverNetwork network(rivers, {});
    const std::vector<Obstacle> all = scattered(network);
    const RiverFlow flow(network, all);
    for (const Obstacle& o : all)
      for (const glm::dvec2& edge : outline_of(o))
        for (const double q : {1.1, 1.6, 3.0}) {
          constexpr double h = 0.01;
          const glm::dvec2 p = o.middle + q * (edge - o.middle);
          const double divergence =
              (flow.velocity(p + glm::dvec2(h, 0)).x - flow.velocity(p - glm::dvec2(h, 0)).x +
               flow.velocity(p + glm::dvec2(0, h)).y - flow.velocity(p - glm::dvec2(0, h)).y) /
              (2.0 * h);
          EXPECT_LT(std::abs(divergence), 1e-4 * mean_speed(network, p) / 20.0);
        }
  }
}

TEST(Obstacles, WhatFlowsPastBothFlanksIsTheRiversWater) {
  for (const std::vector<River>& rivers : rivers_to_part()) {
    const RiverNetwork network(rivers, {});
    const std::vector<Obstacle> all = scattered(network);
    const RiverFlow flow(network, all), open(network);
    for (const Obstacle& o : all) {
      const CourseNode node = place_on(network.courses()[0], o.middle).node;
      const double discharge = network.discharge_m2_s(0, node.s_m);
      const glm::dvec2 right = node.bank(false), left = node.bank(true);
      const double past_right = flux_across(flow, right, o.middle);
      const double past_left = flux_across(flow, o.middle, left);
      EXPECT_NEAR(past_right + past_left, discharge, 0.01 * discharge);
      // Each side has what it had without it.
      EXPECT_NEAR(past_right, flux_across(open, right, o.middle), 0.01 * discharge);
    }
    for (const CourseNode& node : network.courses()[0].nodes)
      EXPECT_NEAR(*flow.psi(node.bank(true)) - *flow.psi(node.bank(false)),
                  *open.psi(node.bank(true)) - *open.psi(node.bank(false)), 1e-12);
  }
}

TEST(Obstacles, ThatTouchABankAreOfIt) {
  const RiverNetwork network(std::vector<River>{straight(20.0, 0.7)}, {});
  // On the left bank, and one that is a narrow gap from the right one.
  const std::vector<Obstacle> all = {{{0.0, 9.0}, {0.0, 1.0}, glm::dvec2(2.0)},
                                     {{100.0, -7.2}, {0.0, 1.0}, glm::dvec2(2.0)}};
  const RiverFlow flow(network, all);
  EXPECT_NEAR(*flow.psi(all[0].middle), *flow.psi({0.0, 10.0}), 1e-9);
  EXPECT_NEAR(*flow.psi(all[1].middle), *flow.psi({100.0, -10.0}), 1e-9);
  // All water goes past the other side.
  EXPECT_NEAR(flux_across(flow, {0.0, -10.0}, {0.0, 7.0}), 14.0, 0.1);
  EXPECT_NEAR(flux_across(flow, {100.0, -5.2}, {100.0, 10.0}), 14.0, 0.1);
}

TEST(Obstacles, ThatNearlyTouchAreOneAndWhatDamsTheRiverIsNone) {
  const RiverNetwork network(std::vector<River>{straight(20.0, 0.7)}, {});
  const std::vector<Obstacle> pair = {{{0.0, -1.2}, {0.0, 1.0}, glm::dvec2(1.0)},
                                      {{0.0, 1.2}, {0.0, 1.0}, glm::dvec2(1.0)},
                                      {{0.0, 5.0}, {0.0, 1.0}, glm::dvec2(1.0)}};
  const RiverFlow flow(network, pair), open(network);
  EXPECT_EQ(*flow.psi(pair[0].middle), *flow.psi(pair[1].middle));
  EXPECT_NEAR(*flow.psi({0.0, -0.2}), *flow.psi({0.0, 0.2}), 1e-9);
  EXPECT_GT(*flow.psi(pair[2].middle) - *flow.psi(pair[1].middle), 1.0);
  const std::vector<Obstacle> dam = {{{0.0, 0.0}, {0.0, 1.0}, {1.0, 12.0}}};
  const RiverFlow dammed(network, dam);
  for (const glm::dvec2& p : {glm::dvec2(0.0, 0.0), {-3.0, 4.0}, {2.0, -9.0}}) {
    EXPECT_EQ(dammed.psi(p), open.psi(p));
    EXPECT_FALSE(dammed.is_parted(p));
  }
  EXPECT_TRUE(dammed.is_blocked({0.0, 5.0}));
}

TEST(Obstacles, WidenedHoldAllThatIsNear) {
  for (const bool is_round : {true, false})
    for (const glm::dvec2& half : {glm::dvec2(2.0), {0.9, 4.0}, {5.0, 0.5}})
      for (const double by_m : {0.3, 2.5}) {
        const Obstacle o{{3.0, -2.0}, at_angle(0.6), half, is_round};
        const Obstacle wide = widened(o, by_m);
        for (const glm::dvec2& p : outline_of(wide)) {
          double least_m = HUGE_VAL;
          for (const glm::dvec2& edge : outline_of(o))
            least_m = std::min(least_m, glm::distance(p, edge));
          EXPECT_GT(least_m, 0.99 * by_m) << half.x << " " << half.y << " " << is_round;
          EXPECT_LT(least_m, 1.5 * by_m + 0.5 * std::max(half.x, half.y));
        }
        EXPECT_LE(metres_outside(o, o.middle), 0.0);
      }
}

// A plain that a straight river crosses.
struct Plain {
  Plain() {
    land.height_m.assign(static_cast<std::size_t>(land.grid.samples_x) * land.grid.samples_y, 3.0f);
    dig_beds(network, land);
  }
  InlandWater water(const std::vector<Obstacle>& obstacles) {
    return {network, fill_lakes({}, land), land, obstacles, workers};
  }

  static River river() {
    River river = straight(20.0, 0.7);
    river.into = "lake";
    river.path_m = {{-150.0, 0.0}, {150.0, 0.0}};
    river.surface_m = {1.0, 0.5};
    return river;
  }
  static Lake lake() {
    Lake lake;
    lake.name = "lake";
    lake.level_m = 0.5;
    lake.outline_m = {{140.0, -30.0}, {190.0, -30.0}, {190.0, 30.0}, {140.0, 30.0}};
    lake.depth_m = 2.0;
    return lake;
  }

  Workers workers{1};
  std::vector<Lake> lakes{lake()};
  std::vector<River> rivers{river()};
  RiverNetwork network{rivers, lakes};
  terrain::HeightGrid land{{{-200.0, -200.0}, 4.0, 101, 101}};
};

glm::dvec2 current(const InlandWater& water, glm::dvec2 p) {
  const auto sample = water.at(p);
  return {sample->east_mps, sample->north_mps};
}

TEST(Obstacles, ShowInTheLatticeThatPicturesAndQueriesRead) {
  Plain plain;
  const std::vector<Obstacle> rock = {{{0.0, 0.0}, {0.0, 1.0}, glm::dvec2(3.0)}};
  const InlandWater open = plain.water({}), parted = plain.water(rock);
  EXPECT_EQ(open.spacing_m(), 4.0);
  EXPECT_EQ(parted.spacing_m(), 2.0);
  EXPECT_LT(glm::length(current(parted, {0.0, 0.0})), 0.1);
  EXPECT_GT(current(parted, {0.0, 4.5}).x, 1.2 * current(open, {0.0, 4.5}).x);
  EXPECT_GT(current(parted, {-4.5, 2.5}).y, 0.1);
  EXPECT_LT(current(parted, {4.5, 2.5}).y, -0.1);
  EXPECT_NEAR(parted.undisturbed_current({0.0, 0.0}).x, 0.77, 0.01);
  EXPECT_NEAR(open.undisturbed_current({0.0, 0.0}).x, 0.77, 0.01);
  EXPECT_NEAR(current(parted, {-80.0, 3.0}).x, current(open, {-80.0, 3.0}).x, 0.01);
}

// A sample on a post is not still: it has the mean of its cell, out of which the post takes little.
TEST(Obstacles, BetweenTheLatticesPointsTakeTheirPartOfTheWater) {
  Plain plain;
  const InlandWater open = plain.water({});
  const glm::dvec2 at = open.point({40, 4});
  const InlandWater posted = plain.water({{at, {0.0, 1.0}, glm::dvec2(0.16)}});
  EXPECT_EQ(posted.spacing_m(), open.spacing_m());
  EXPECT_NEAR(current(posted, at).x, current(open, at).x, 0.03);
}

}  // namespace
}  // namespace swell::ocean
