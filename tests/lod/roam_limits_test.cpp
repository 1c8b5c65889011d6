// Work bounded by operations, by the clock and by groups of priorities.
#include <gtest/gtest.h>

#include <chrono>
#include <set>

#include "lod/camera_walk.h"
#include "lod/diamond_oracle.h"
#include "lod/mesh_checks.h"
#include "lod/roam.h"
#include "lod/tree.h"
#include "trials.h"

namespace swell::lod {
namespace {

using Clock = std::chrono::steady_clock;

const Domain kSea{{-32768.0, -32768.0}, 65536.0, 17};

AdaptRequest over_still_water(glm::dvec3 eye, int budget) {
  AdaptRequest request;
  request.view = make_view(eye, 0.0, -0.1, 1.0, 0.1f, 1280, 720);
  request.triangle_budget = budget;
  request.frustum_margin = 0.1f;
  return request;
}

Mesh mesh_of(const Roam& roam) {
  Mesh mesh;
  roam.extract_mesh(mesh);
  return mesh;
}

Mesh rebuilt(const AdaptRequest& request, const Domain& domain) {
  Roam roam(domain, 10000);
  roam.rebuild(request);
  return mesh_of(roam);
}

// From the roots, the first n operations split the first n diamonds of the order.
TEST(RoamLimits, OperationsAreDoneInTheOrderOfImportance) {
  const Domain domain{{-300.0, 2000.0}, 700.0, 5};
  const std::vector<oracle::OracleDiamond> diamonds = oracle::all_diamonds(5);
  AdaptRequest request = over_still_water({50.0, 2100.0, 30.0}, 400);
  Roam roam(domain, 2048);
  for (const int limit : {0, 1, 2, 5, 17, 60, 100}) {
    request.limits.max_operations = limit;
    const AdaptStatistics done = roam.rebuild(request);
    EXPECT_EQ(done.splits, limit);
    EXPECT_TRUE(done.stopped);
    std::set<oracle::Point> split;
    const Mesh mesh = mesh_of(roam);
    for (std::size_t v = 4; v < mesh.lattice.size(); ++v)
      split.insert({mesh.lattice[v].x, mesh.lattice[v].y});
    AdaptRequest unlimited = request;
    unlimited.triangle_budget = done.triangles;
    EXPECT_EQ(split, oracle::target(unlimited, domain, diamonds));
  }
}

TEST(RoamLimits, ManyShortStepsDoTheWorkOfOneLongStep) {
  Roam limited(kSea, 10000), free(kSea, 10000);
  limited.adapt(over_still_water({0.0, 0.0, 20.0}, 10000));
  free.adapt(over_still_water({0.0, 0.0, 20.0}, 10000));
  AdaptRequest there = over_still_water({3000.0, 500.0, 35.0}, 10000);
  there.limits.max_operations = 1'000'000;
  const AdaptStatistics all = free.adapt(there);
  there.limits.max_operations = 300;
  int operations = 0, steps = 0;
  for (bool stopped = true; stopped; ++steps) {
    const AdaptStatistics done = limited.adapt(there);
    EXPECT_LE(done.splits + done.merges, 300);
    EXPECT_LE(done.triangles, 10000);
    operations += done.splits + done.merges;
    stopped = done.stopped;
    ASSERT_LT(steps, 1000);
  }
  EXPECT_EQ(operations, all.splits + all.merges);
  EXPECT_GT(steps, 10);
  EXPECT_EQ(mesh_of(limited).indices, mesh_of(free).indices);
}

TEST(RoamLimits, TheBudgetHoldsWhateverTheLimitIs) {
  Roam roam(kSea, 10000);
  AdaptRequest request = over_still_water({0.0, 0.0, 20.0}, 10000);
  roam.adapt(request);
  request.triangle_budget = 500;
  request.limits.max_operations = 10;
  const AdaptStatistics done = roam.adapt(request);
  EXPECT_LE(done.triangles, 500);
  EXPECT_EQ(find_mesh_fault(mesh_of(roam), 17), "");
}

TEST(RoamLimits, APassedDeadlineAllowsAFewStepsAndAFarOneChangesNothing) {
  Roam roam(kSea, 10000);
  AdaptRequest request = over_still_water({0.0, 0.0, 20.0}, 10000);
  roam.adapt(request);
  const Mesh before = mesh_of(roam);
  AdaptRequest there = over_still_water({200.0, 500.0, 35.0}, 10000);
  there.limits.deadline = Clock::now();
  for (int call = 0; call < 5; ++call) {
    const AdaptStatistics late = roam.adapt(there);
    EXPECT_TRUE(late.stopped);
    EXPECT_GT(late.splits + late.merges, 0) << "even without time it gets on";
    EXPECT_LE(late.splits + late.merges, 50);
  }
  EXPECT_NE(mesh_of(roam).indices, before.indices);
  there.limits.deadline = Clock::now() + std::chrono::hours(1);
  EXPECT_FALSE(roam.adapt(there).stopped);
  EXPECT_EQ(mesh_of(roam).indices, rebuilt(there, kSea).indices);
}

TEST(RoamLimits, ADeadlineEndsABuildEarly) {
  Roam roam({{-32768.0, -32768.0}, 65536.0, 20}, 1000000);
  AdaptRequest request = over_still_water({0.0, 0.0, 20.0}, 1000000);
  request.limits.deadline = Clock::now() + std::chrono::milliseconds(5);
  const AdaptStatistics done = roam.adapt(request);
  EXPECT_TRUE(done.stopped);
  EXPECT_GT(done.triangles, 2);
  EXPECT_LT(done.triangles, 900000);
}

// Each call renews about a quarter of the keys; a few members that move miss turns.
TEST(RoamLimits, GroupsOfPrioritiesEndInTheMeshOfAllForACameraThatStandsStill) {
  Roam roam(kSea, 10000);
  AdaptRequest request = over_still_water({0.0, 0.0, 20.0}, 10000);
  request.limits.priority_groups = 4;
  for (int frame = 0; frame <= 30; ++frame) {
    request.view = over_still_water({0.0, 0.5 * frame, 20.0}, 2).view;
    EXPECT_LE(roam.adapt(request).triangles, 10000);
    ASSERT_EQ(find_fault(roam.tree(), true), "");
  }
  for (int frame = 0; frame < 12; ++frame) roam.adapt(request);
  EXPECT_EQ(find_fault(roam.tree()), "");  // no old keys
  EXPECT_EQ(mesh_of(roam).indices, rebuilt(request, kSea).indices);
}

TEST(RoamLimits, OneGroupAfterManyRenewsEveryKey) {
  Roam roam(kSea, 10000);
  AdaptRequest request = over_still_water({0.0, 0.0, 20.0}, 10000);
  for (int frame = 1; frame <= 12; ++frame) {
    request.view = over_still_water({0.0, 2.0 * frame, 20.0}, 2).view;
    request.limits.priority_groups = frame % 3 == 0 ? 1 : 3 + frame;
    roam.adapt(request);
    ASSERT_EQ(find_fault(roam.tree(), frame % 3 != 0), "") << frame;
  }
  EXPECT_EQ(mesh_of(roam).indices, rebuilt(request, kSea).indices);
}

// Random limits on random walks; then one step without them.
TEST(RoamLimits, WhateverIsLeftUndoneTheMeshIsValidAndTheNextFullStepMendsIt) {
  const int bits = 6;
  const Domain domain{{-300.0, 2000.0}, 700.0, bits};
  for (int seed = 0; seed < trials(20); ++seed) {
    const auto random = static_cast<std::uint64_t>(seed);
    const ReliefBounds relief(make_heights(bits, random), (1 << bits) + 1, 1.0);
    Roam roam(domain, 8192);
    CameraWalk walk(random, domain, 8192, &relief);
    for (int step = 0; step < 40; ++step) {
      SCOPED_TRACE(fmt::format("seed {} step {}", seed, step));
      AdaptRequest request = walk.next();
      const double u = random_uniform(random + 1000, static_cast<std::uint64_t>(step));
      const bool full = step % 8 == 7;
      if (!full && u < 0.7) request.limits.max_operations = static_cast<int>(100.0 * u);
      if (!full && u > 0.4) request.limits.priority_groups = 1 + static_cast<int>(8.0 * u);
      const AdaptStatistics done = roam.adapt(request);
      ASSERT_LE(done.triangles, request.triangle_budget);
      ASSERT_FALSE(done.operation_cap_hit);
      ASSERT_EQ(find_fault(roam.tree(), !full), "");
      if (step % 8 < 6) continue;
      ASSERT_EQ(find_mesh_fault(mesh_of(roam), bits), "");
      if (!full) continue;
      ASSERT_EQ(mesh_of(roam).indices, rebuilt(request, domain).indices);
    }
  }
}

TEST(RoamLimitsDeathTest, RefusesLimitsThatAreNone) {
  Roam roam(kSea, 100);
  AdaptRequest request = over_still_water({0.0, 0.0, 20.0}, 100);
  request.limits.max_operations = -1;
  EXPECT_DEATH(roam.adapt(request), "max_operations=-1");
  request.limits = {.priority_groups = 0};
  EXPECT_DEATH(roam.adapt(request), "priority_groups=0");
}

}  // namespace
}  // namespace swell::lod
