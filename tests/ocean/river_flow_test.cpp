#include "ocean/inland/river_flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "ocean/example_rivers.h"
#include "ocean/inland/river_network.h"

namespace swell::ocean {
namespace {

std::vector<std::vector<River>> networks() {
  return {{straight(20.0, 0.7)},         {winding()},        {winding(), tributary(true)},
          {winding(), tributary(false)}, {winding(), arm()}, {winding(), tributary(true), arm()}};
}

// Places across a river where it is alone: none of its joints is near.
std::vector<CourseNode> lonely_nodes(const RiverNetwork& network, std::size_t river, int count) {
  const Course& course = network.courses()[river];
  std::vector<CourseNode> nodes;
  for (int k = 0; k < count; ++k) {
    const double s_m = course.length_m() * (k + 0.5) / count;
    const CourseNode node = node_at(course, s_m);
    const bool near_joint = std::ranges::any_of(network.joints(), [&](const Joint& j) {
      const CourseNode on = node_at(network.courses()[j.on], j.s_m);
      const double reach_m =
          2.0 * on.half_width_m + 2.0 * network.courses()[j.river].nodes.front().half_width_m;
      return (j.on == river || j.river == river) && glm::distance(on.p, node.p) < reach_m;
    });
    if (!near_joint) nodes.push_back(node);
  }
  return nodes;
}

// The water through a cross-section, by Simpson's rule.
double flux_through(const RiverFlow& flow, const CourseNode& node) {
  constexpr int kSteps = 60;
  const glm::dvec2 right = node.bank(false), left = node.bank(true);
  const double step_m = glm::distance(right, left) / kSteps;
  double sum = 0.0;
  for (int k = 0; k <= kSteps; ++k) {
    // Just inside the banks, where the velocity is one-sided.
    const double t = std::clamp(static_cast<double>(k) / kSteps, 1e-3, 1.0 - 1e-3);
    const double weight = k == 0 || k == kSteps ? 1.0 : k % 2 == 1 ? 4.0 : 2.0;
    sum += weight * glm::dot(flow.velocity(glm::mix(right, left, t)), node.along);
  }
  return sum * step_m / 3.0;
}

// By the midpoint rule.
double flux_out_of_square(const RiverFlow& flow, glm::dvec2 middle, double side_m) {
  constexpr int kSteps = 40;
  double sum = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    const double along = ((k + 0.5) / kSteps - 0.5) * side_m, out = 0.5 * side_m;
    sum += flow.velocity(middle + glm::dvec2(out, along)).x -
           flow.velocity(middle + glm::dvec2(-out, along)).x +
           flow.velocity(middle + glm::dvec2(along, out)).y -
           flow.velocity(middle + glm::dvec2(along, -out)).y;
  }
  return sum * side_m / kSteps;
}

TEST(RiverFlow, StraightChannelHasTheKnownProfile) {
  // s = 3 W, p = 1: speeds over the mean 0.79 at the bank, 1.03 half way, 1.10 in the middle.
  const std::vector<River> rivers = {straight(20.0, 0.7)};
  const RiverNetwork network(rivers, {});
  const RiverFlow flow(network);
  EXPECT_NEAR(flow.velocity({0.0, 0.0}).x / 0.7, 1.10, 0.01);
  EXPECT_NEAR(flow.velocity({0.0, 5.0}).x / 0.7, 1.03, 0.01);
  EXPECT_NEAR(flow.velocity({0.0, -9.95}).x / 0.7, 0.79, 0.01);
  EXPECT_NEAR(flow.velocity({0.0, 5.0}).y, 0.0, 1e-6);
}

TEST(RiverFlow, HasNoDivergence) {
  for (const std::vector<River>& rivers : networks()) {
    const RiverNetwork network(rivers, {});
    const RiverFlow flow(network);
    for (std::size_t r = 0; r < rivers.size(); ++r) {
      for (const CourseNode& node : lonely_nodes(network, r, 15)) {
        for (const double across : {-0.7, -0.2, 0.3, 0.8}) {
          const glm::dvec2 p = node.p + across * node.half_width_m * node.left();
          // Differences over the same step as the velocity's own, so that bends of the banks'
          // pieces count as they are.
          constexpr double h = 0.01;
          const double divergence =
              (flow.velocity(p + glm::dvec2(h, 0)).x - flow.velocity(p - glm::dvec2(h, 0)).x +
               flow.velocity(p + glm::dvec2(0, h)).y - flow.velocity(p - glm::dvec2(0, h)).y) /
              (2.0 * h);
          const double speed = glm::length(flow.velocity(p));
          EXPECT_LT(std::abs(divergence), 1e-4 * speed / (2.0 * node.half_width_m));
          EXPECT_LT(std::abs(flux_out_of_square(flow, p, 2.0)), 0.02 * speed * 2.0);
        }
      }
    }
  }
}

TEST(RiverFlow, FollowsTheBanks) {
  for (const std::vector<River>& rivers : networks()) {
    const RiverNetwork network(rivers, {});
    const RiverFlow flow(network);
    double worst = 0.0;
    for (std::size_t r = 0; r < rivers.size(); ++r)
      for (const CourseNode& node : lonely_nodes(network, r, 60))
        for (const bool left : {false, true}) {
          // The nearest piece of the bank, and a place a centimetre and a half from it.
          const BankPiece* nearest = nullptr;
          double least_m = HUGE_VAL;
          for (const BankPiece& piece : flow.banks())
            if (const double d = nearest_on(piece.segment, node.bank(left)).distance_m; d < least_m)
              least_m = d, nearest = &piece;
          const glm::dvec2 along = glm::normalize(nearest->segment.b - nearest->segment.a);
          const glm::dvec2 inward = glm::dvec2(along.y, -along.x) * (left ? 1.0 : -1.0);
          const glm::dvec2 middle = 0.5 * (nearest->segment.a + nearest->segment.b);
          const glm::dvec2 v = flow.velocity(middle + 0.015 * inward);
          worst = std::max(worst, std::abs(glm::dot(glm::normalize(v), inward)));
          EXPECT_GT(glm::dot(v, along), 0.0);
        }
    EXPECT_LT(worst, std::sin(1.0 * 3.14159265 / 180.0));
  }
}

TEST(RiverFlow, AllWaterGoesThroughEachCrossSection) {
  for (const std::vector<River>& rivers : networks()) {
    const RiverNetwork network(rivers, {});
    const RiverFlow flow(network);
    for (std::size_t r = 0; r < rivers.size(); ++r)
      for (const CourseNode& node : lonely_nodes(network, r, 100)) {
        const double discharge = network.discharge_m2_s(r, node.s_m);
        EXPECT_NEAR(flux_through(flow, node), discharge, 0.01 * discharge)
            << rivers[r].name << " at " << node.s_m;
        // RIV-03, RIV-04: the banks keep their psi all along, but for what their pieces cut off.
        EXPECT_NEAR(*flow.psi(node.bank(true)) - *flow.psi(node.bank(false)), discharge,
                    1e-3 * discharge);
      }
  }
}

TEST(RiverFlow, JointsConserveWater) {
  for (const bool left : {false, true}) {
    const std::vector<River> rivers = {winding(), tributary(left)};
    const RiverNetwork network(rivers, {});
    const double end_m = network.courses()[0].length_m();
    EXPECT_NEAR(network.discharge_m2_s(0, end_m),
                network.discharge_m2_s(0, 0.0) + network.discharge_m2_s(1, 1e9), 1e-12);
    EXPECT_NEAR(network.discharge_m2_s(0, 0.0), 1.2 * 24.0, 1e-12);
    EXPECT_EQ(network.joints()[0].on_left, left);
    // psi of the banks says the same.
    const RiverFlow flow(network);
    const CourseNode& mouth = network.courses()[0].nodes[network.courses()[0].nodes.size() - 2];
    EXPECT_NEAR(*flow.psi(mouth.bank(true)) - *flow.psi(mouth.bank(false)),
                network.discharge_m2_s(0, end_m), 1e-3);
  }
}

// Or water would flow through the bank, fast, between the two.
TEST(RiverFlow, BanksThatTouchHaveOnePsi) {
  for (const std::vector<River>& rivers : networks()) {
    const RiverFlow flow(RiverNetwork(rivers, {}));
    int touching = 0;
    for (const BankPiece& a : flow.banks())
      for (const BankPiece& b : flow.banks())
        for (const glm::dvec2& end : {b.segment.a, b.segment.b}) {
          if (&a == &b || glm::distance(a.segment.b, end) > 1e-6) continue;
          EXPECT_NEAR(a.psi, b.psi, 1e-9) << end.x << " " << end.y;
          ++touching;
        }
    EXPECT_GT(touching, 100);
  }
}

TEST(RiverFlow, ArmsAroundAnIslandShareTheWaterByTheirWidths) {
  const std::vector<River> rivers = {winding(), arm()};
  const RiverNetwork network(rivers, {});
  const double all = network.discharge_m2_s(0, 0.0);
  const Joint& leaves = *std::ranges::find(network.joints(), false, &Joint::joins);
  const double width_m = 2.0 * node_at(network.courses()[0], leaves.s_m).half_width_m;
  EXPECT_NEAR(network.discharge_m2_s(1, 0.0), all * 14.0 / (14.0 + width_m), 1e-9);
  const double beside_m = leaves.s_m + 60.0;
  EXPECT_NEAR(network.discharge_m2_s(0, beside_m) + network.discharge_m2_s(1, 0.0), all, 1e-9);
  EXPECT_NEAR(network.discharge_m2_s(0, 1e9), all, 1e-9);
  // The island's shore has one psi: it is one bank.
  const RiverFlow flow(network);
  const CourseNode beside = node_at(network.courses()[0], beside_m);
  const CourseNode in_arm = node_at(network.courses()[1], 0.5 * network.courses()[1].length_m());
  EXPECT_NEAR(*flow.psi(beside.bank(true)), *flow.psi(in_arm.bank(false)), 1e-3);
}

// RIV-01. The velocity summed over a line is the difference of psi at its ends, so that nothing
// comes out of any loop.
TEST(RiverFlow, FluxThroughAnyLineIsTheDifferenceOfPsi) {
  const std::vector<River> rivers = {winding(), tributary(true), arm()};
  const RiverNetwork network(rivers, {});
  const RiverFlow flow(network);
  const double all = network.discharge_m2_s(0, 1e9);
  for (std::size_t r = 0; r < rivers.size(); ++r)
    for (const CourseNode& node : lonely_nodes(network, r, 50))
      for (const double turn : {0.1, 1.3, 2.9}) {
        const glm::dvec2 way = 0.5 * node.half_width_m * glm::dvec2(std::cos(turn), std::sin(turn));
        const glm::dvec2 right_of_way(way.y, -way.x);
        constexpr int kSteps = 40;
        double flux = 0.0;
        for (int k = 0; k < kSteps; ++k)
          flux += glm::dot(flow.velocity(node.p + (k + 0.5) / kSteps * way), right_of_way) / kSteps;
        EXPECT_NEAR(*flow.psi(node.p + way) - *flow.psi(node.p), flux, 1e-4 * all);
      }
}

TEST(RiverFlow, DriftersKeepTheirStreamLineAndNeverCrossABank) {
  const std::vector<River> rivers = {winding(), tributary(true), arm()};
  const RiverNetwork network(rivers, {});
  const RiverFlow flow(network);
  const double all = network.discharge_m2_s(0, 1e9);
  for (const double across : {-0.9, -0.5, 0.0, 0.4, 0.85}) {
    const CourseNode start = node_at(network.courses()[0], 15.0);
    glm::dvec2 p = start.p + across * start.half_width_m * start.left();
    const double psi = *flow.psi(p);
    double worst = 0.0;
    int steps = 0;
    for (; steps < 20000 && p.x < 470.0; ++steps) {
      constexpr double dt = 0.2;
      const glm::dvec2 half = p + 0.5 * dt * flow.velocity(p);
      p += dt * flow.velocity(half);
      worst = std::max(worst, std::abs(*flow.psi(p) - psi));
      ASSERT_LT(network.water_near(p)->outside_m, 0.0) << p.x << " " << p.y;
    }
    EXPECT_LT(steps, 20000) << "a drifter from " << across << " stays at " << p.x << " " << p.y;
    EXPECT_LT(worst, 0.005 * all);
  }
}

TEST(RiverFlow, RefusesWhatIsNoRiver) {
  const auto message_of = [](std::vector<River> rivers) -> std::string {
    try {
      const RiverNetwork network(rivers, {});
      const RiverFlow flow(network);
    } catch (const RiverError& error) {
      return error.what();
    }
    return "";
  };
  River river = winding();
  river.surface_m[3] = 3.5;
  EXPECT_EQ(message_of({river}),
            "river[0].surface_m[3], got 3.5, allowed at most 3, where the water comes from");
  river = winding();
  river.path_m[4] = {-200, 40};
  EXPECT_NE(message_of({river}).find("crosses itself"), std::string::npos);
  river = winding();
  river.width_m = {10, 20};
  EXPECT_EQ(message_of({river}),
            "river[0].width_m, got 2 numbers, allowed one, or one each for 6 points");
  river = winding();
  river.width_m = {300};
  EXPECT_NE(message_of({river}).find("sharper than the river is wide"), std::string::npos);
  river = tributary(true);
  river.into = "maine";
  EXPECT_EQ(message_of({winding(), river}),
            "river[1].into, got \"maine\", allowed the name of another river or of a lake");
  river = tributary(true);
  river.path_m.back() = {-150, 100};
  EXPECT_NE(message_of({winding(), river}).find("m from the river's end"), std::string::npos);
  river = tributary(true);
  river.surface_m = {2, 2, 2};  // below the river that it joins
  EXPECT_NE(message_of({winding(), river}).find("river[1].surface_m[2]"), std::string::npos);
  River one = winding(), two = tributary(true);
  one.into = "tributary";
  EXPECT_NE(message_of({one, two}), "");
}

}  // namespace
}  // namespace swell::ocean
