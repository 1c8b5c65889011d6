#include "lod/roam.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lod/mesh_checks.h"
#include "lod/tree.h"

namespace swell::lod {
namespace {

constexpr double kHalfPi = 1.57079632679489662;

// Straight down from so far above that all distances round to one number.
AdaptRequest from_far_above(int budget) {
  AdaptRequest request;
  request.view = make_view({0.0, 0.0, 1e9}, 0.0, -kHalfPi, 1.0, 0.1f, 64, 64);
  request.triangle_budget = budget;
  return request;
}

// Over the water, looking north and a little down.
AdaptRequest over_the_sea(glm::dvec3 eye, int budget) {
  AdaptRequest request;
  request.view = make_view(eye, 0.0, -0.1, 1.0, 0.1f, 1280, 720);
  request.triangle_budget = budget;
  request.min_height_m = -1.0f;
  request.max_height_m = 1.0f;
  request.frustum_margin = 0.1f;
  return request;
}

Domain sea() { return {{-32768.0, -32768.0}, 65536.0, 17}; }

TEST(Roam, TheSmallestBudgetGivesTheTwoRootTriangles) {
  Roam roam({{0.0, 0.0}, 1.0, 3}, 100);
  const AdaptStatistics done = roam.adapt(from_far_above(2));
  Mesh mesh;
  roam.extract_mesh(mesh);
  EXPECT_EQ(done.triangles, 2);
  EXPECT_EQ(mesh.lattice, (std::vector<glm::ivec2>{{0, 0}, {8, 0}, {8, 8}, {0, 8}}));
  EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 2, 3, 0}));
  EXPECT_EQ(mesh.level, (std::vector<std::uint8_t>{0, 0}));
}

TEST(Roam, OneSplitMakesFourTrianglesAroundTheMiddle) {
  Roam roam({{0.0, 0.0}, 1.0, 3}, 100);
  EXPECT_EQ(roam.adapt(from_far_above(4)).splits, 1);
  Mesh mesh;
  roam.extract_mesh(mesh);
  ASSERT_EQ(mesh.level, (std::vector<std::uint8_t>{1, 1, 1, 1}));
  EXPECT_EQ(mesh.lattice[4], glm::ivec2(4, 4));
  EXPECT_EQ(find_mesh_fault(mesh, 3), "");
}

TEST(Roam, EqualDistancesGiveUniformLevelsOfTwoToTheLevelPlusOneTriangles) {
  Roam roam({{-0.5, -0.5}, 1.0, 5}, 2048);
  Mesh mesh;
  for (int level = 0; level <= 10; ++level) {
    EXPECT_EQ(roam.adapt(from_far_above(2 << level)).triangles, 2 << level);
    roam.extract_mesh(mesh);
    EXPECT_EQ(std::ranges::count(mesh.level, level), 2 << level);
    EXPECT_EQ(find_mesh_fault(mesh, 5), "");
  }
}

// The paper's figure: 9 x 9 vertices and the middles of the 64 squares.
TEST(Roam, TheUniformNineByNineGridHas256Triangles) {
  Roam roam({{-0.5, -0.5}, 1.0, 4}, 512);
  EXPECT_EQ(roam.adapt(from_far_above(256)).triangles, 256);
  Mesh mesh;
  roam.extract_mesh(mesh);
  EXPECT_EQ(mesh.lattice.size(), 9u * 9u + 64u);
}

TEST(Roam, TheLatticeEndsRefinement) {
  Roam roam({{-0.5, -0.5}, 1.0, 1}, 1000);
  EXPECT_EQ(roam.adapt(from_far_above(1000)).triangles, 8);
}

TEST(Roam, ABudgetIsUsedUpToOneTriangle) {
  Roam roam(sea(), 40000);
  for (const int budget : {10, 101, 1500, 9999, 30000, 30001}) {
    const int triangles = roam.adapt(over_the_sea({3.0, 4.0, 20.0}, budget)).triangles;
    EXPECT_LE(triangles, budget);
    EXPECT_GE(triangles, budget - 1);
  }
}

// From above the middle of the domain, from where all distances are the same but for 6 %.
TEST(Roam, NoTriangleIsSplitThatLooksNarrowerThanTheLeastSize) {
  const Domain domain{{-32.0, -32.0}, 64.0, 6};
  Roam roam(domain, 20000);
  AdaptRequest request = from_far_above(20000);
  request.view = make_view({0.0, 0.0, 128.0}, 0.0, -kHalfPi, 1.0, 0.1f, 640, 640);
  const double focal_px = 320.0 / std::tan(0.5);
  for (int level = 0; level < 12; ++level) {
    const double width_px = focal_px * 64.0 * std::pow(2.0, -0.5 * level) / 128.0;
    request.least_size_px = static_cast<float>(1.001 * width_px);
    Mesh mesh;
    roam.adapt(request);
    roam.extract_mesh(mesh);
    EXPECT_LE(*std::ranges::max_element(mesh.level), level);
    EXPECT_GE(*std::ranges::min_element(mesh.level), level - 1);
  }
}

TEST(Roam, ALeastSizeGivesTheBestTriangulationOfAsManyTriangles) {
  Roam roam(sea(), 40000), other(sea(), 40000);
  int most = 40001;
  for (const float least_size_px : {8.0f, 24.0f, 40.0f, 100.0f, 1000.0f}) {
    AdaptRequest request = over_the_sea({3.0, 4.0, 20.0}, 40000);
    request.least_size_px = least_size_px;
    const int triangles = roam.adapt(request).triangles;
    EXPECT_LT(triangles, most);
    most = triangles == 40000 ? 40001 : triangles;
    other.rebuild(over_the_sea({3.0, 4.0, 20.0}, triangles));
    Mesh mesh, expected;
    roam.extract_mesh(mesh);
    other.extract_mesh(expected);
    EXPECT_EQ(mesh.lattice, expected.lattice);
    EXPECT_EQ(mesh.indices, expected.indices);
  }
  EXPECT_EQ(roam.adapt(over_the_sea({3.0, 4.0, 20.0}, 40000)).triangles, 40000);
}

TEST(Roam, BeginsAnewWhereACameraTurnsAroundAndGoesOnWhereItMoves) {
  Roam roam(sea(), 30000), fresh(sea(), 30000);
  AdaptRequest request = over_the_sea({3.0, 4.0, 20.0}, 30000);
  EXPECT_FALSE(roam.adapt(request).anew) << "it begins there";
  request.view.eye_world.y += 1.0;
  EXPECT_FALSE(roam.adapt(request).anew);
  request.view = make_view(request.view.eye_world, kHalfPi, -0.1, 1.0, 0.1f, 1280, 720);
  const AdaptStatistics turned = roam.adapt(request);
  EXPECT_TRUE(turned.anew);
  const AdaptStatistics from_roots = fresh.rebuild(request);
  EXPECT_LE(turned.splits + turned.merges, from_roots.splits + from_roots.splits / 20);
  Mesh mesh, expected;
  roam.extract_mesh(mesh);
  fresh.extract_mesh(expected);
  EXPECT_EQ(mesh.lattice, expected.lattice);
  EXPECT_EQ(mesh.indices, expected.indices);
  EXPECT_EQ(find_fault(roam.tree()), "");
}

TEST(Roam, NothingChangesForACameraThatStandsStill) {
  Roam roam(sea(), 10000);
  const AdaptRequest request = over_the_sea({0.0, 0.0, 10.0}, 10000);
  roam.adapt(request);
  const AdaptStatistics again = roam.adapt(request);
  EXPECT_EQ(again.splits + again.merges, 0);
  EXPECT_GE(again.triangles, 9999);
}

TEST(Roam, AMeshIsWrittenAnewOnlyIfTheTriangulationChanged) {
  Roam roam(sea(), 5000);
  Mesh mesh;
  std::uint64_t revision = 0;
  // Whether an update writes the mesh, and what it then is.
  const auto writes = [&] {
    mesh = {};
    roam.update_mesh(mesh, revision);
    if (mesh.level.empty()) return false;
    Mesh extracted;
    roam.extract_mesh(extracted);
    EXPECT_EQ(mesh.indices, extracted.indices);
    EXPECT_EQ(mesh.lattice, extracted.lattice);
    return true;
  };
  EXPECT_TRUE(writes()) << "two triangles";
  EXPECT_FALSE(writes());
  roam.adapt(over_the_sea({0.0, 0.0, 10.0}, 5000));
  EXPECT_TRUE(writes()) << "splits";
  roam.adapt(over_the_sea({0.0, 0.0, 10.0}, 5000));
  roam.set_origin({-100.0, 0.0});
  EXPECT_FALSE(writes()) << "a still camera, a domain elsewhere";
  const AdaptStatistics fewer = roam.adapt(over_the_sea({32668.0, 32768.0, 10.0}, 4000));
  EXPECT_GT(fewer.merges, 0);
  EXPECT_TRUE(writes()) << "merges";
  roam.set_domain({{-100.0, -50.0}, 4096.0, 11});
  EXPECT_TRUE(writes()) << "two triangles, on another lattice";
  revision = 0;
  EXPECT_TRUE(writes()) << "asked for";
}

// LOD-16: 30 m/s at 60 frames a second.
TEST(Roam, AFlightChangesAFewPerCentOfTheMeshAFrame) {
  Roam roam(sea(), 10000);
  roam.adapt(over_the_sea({0.0, 0.0, 20.0}, 10000));
  for (int frame = 1; frame <= 20; ++frame) {
    const AdaptStatistics done = roam.adapt(over_the_sea({0.0, 0.5 * frame, 20.0}, 10000));
    EXPECT_LE(done.splits + done.merges, 500) << frame;
    EXPECT_GT(done.splits, 0) << frame;
  }
}

TEST(Roam, NothingIsRefinedForACameraThatLooksAway) {
  Roam roam(sea(), 10000);
  AdaptRequest request = over_the_sea({0.0, 0.0, 10.0}, 10000);
  roam.adapt(request);
  request.view = make_view({0.0, 0.0, 10.0}, 0.0, kHalfPi, 1.0, 0.1f, 64, 64);
  request.frustum_margin = 0.0f;
  EXPECT_EQ(roam.adapt(request).triangles, 2);
}

TEST(Roam, TrianglesInSightShrinkInProportionToTheirDistance) {
  Roam roam(sea(), 30000);
  roam.adapt(over_the_sea({0.0, 0.0, 20.0}, 30000));
  Mesh mesh;
  roam.extract_mesh(mesh);
  double smallest = 1e9, largest = 0.0;  // leg over distance, straight ahead
  for (std::size_t t = 0; t < mesh.level.size(); ++t) {
    const glm::dvec2 p = glm::dvec2(mesh.lattice[mesh.indices[3 * t + 1]]) * 0.5 - 32768.0;
    if (std::abs(p.x) > 0.2 * p.y || p.y < 100.0 || p.y > 30000.0) continue;
    const double ratio = 65536.0 * std::pow(0.5, 0.5 * mesh.level[t]) / p.y;
    smallest = std::min(smallest, ratio);
    largest = std::max(largest, ratio);
  }
  EXPECT_GT(smallest, 0.01);
  EXPECT_LT(largest / smallest, 3.0);
}

TEST(Roam, InverseDistanceRefinesTheNearestPartToTheEndFirst) {
  Roam roam({{-128.0, -128.0}, 256.0, 8}, 3000);
  AdaptRequest request = over_the_sea({0.0, 0.0, 5.0}, 3000);
  request.priority = Priority::kInverseDistance;
  roam.adapt(request);
  Mesh mesh;
  roam.extract_mesh(mesh);
  EXPECT_GT(std::ranges::count(mesh.level, 16), 2000);
  EXPECT_EQ(find_mesh_fault(mesh, 8), "");
}

// The level of the triangle around a point in lattice steps.
int level_at(const Mesh& mesh, glm::dvec2 p) {
  for (std::size_t t = 0; t < mesh.level.size(); ++t) {
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec2 a(mesh.lattice[mesh.indices[3 * t + k]]);
      const glm::dvec2 b(mesh.lattice[mesh.indices[3 * t + (k + 1) % 3]]);
      inside = inside && (b.x - a.x) * (p.y - a.y) >= (b.y - a.y) * (p.x - a.x);
    }
    if (inside) return mesh.level[t];
  }
  return -1;
}

TEST(Roam, InAnotherDomainItMakesWhatAFreshOneMakes) {
  const AdaptRequest request = over_the_sea({3.0, 4.0, 8.0}, 3000);
  Mesh moved_mesh, fresh_mesh;
  Roam moved(sea(), 5000), fresh({{-100.0, -50.0}, 4096.0, 12}, 3000);
  moved.adapt(request);
  moved.set_domain(fresh.domain());
  moved.adapt(request);
  fresh.adapt(request);
  moved.extract_mesh(moved_mesh);
  fresh.extract_mesh(fresh_mesh);
  EXPECT_EQ(find_fault(moved.tree()), "");
  EXPECT_EQ(moved_mesh.lattice, fresh_mesh.lattice);
  EXPECT_EQ(moved_mesh.indices, fresh_mesh.indices);
}

TEST(Roam, TheSeaUnderADistantObjectIsFinerThanBesideIt) {
  Roam roam(sea(), 30000);
  AdaptRequest request = over_the_sea({0.0, 0.0, 20.0}, 30000);
  const auto level_beside = [&](double x_m) {
    Mesh mesh;
    EXPECT_GE(roam.adapt(request).triangles, 29999);
    roam.extract_mesh(mesh);
    return level_at(mesh, 2.0 * (glm::dvec2(x_m, 800.7) + 32768.0));
  };
  const int without = level_beside(1.3), beside = level_beside(101.3);
  const std::array<Focus, 1> focus{Focus{{0.0, 800.0}, 2.0}};
  request.focuses = focus;
  EXPECT_EQ(level_beside(1.3), without + 6);  // 8 times nearer: 2 log2(8) levels
  EXPECT_EQ(level_beside(101.3), beside);
}

TEST(Roam, ASimplifiedGridKeepsItsFineTrianglesNearTheCamera) {
  Roam roam({{0.0, 0.0}, 8.0, 4}, 512);
  AdaptRequest request;
  request.view = make_view({1.0, 1.0, 1.0}, 0.785398, -0.2, 1.2, 0.1f, 64, 64);
  request.triangle_budget = 100;
  request.frustum_margin = 10.0f;
  EXPECT_GE(roam.adapt(request).triangles, 99);
  Mesh mesh;
  roam.extract_mesh(mesh);
  int near_level = 0, far_level = 99;
  for (std::size_t t = 0; t < mesh.level.size(); ++t) {
    const glm::ivec2 p = mesh.lattice[mesh.indices[3 * t + 1]];
    if (p.x <= 3 && p.y <= 3) near_level = std::max<int>(near_level, mesh.level[t]);
    if (p.x >= 12 && p.y >= 12) far_level = std::min<int>(far_level, mesh.level[t]);
  }
  EXPECT_GE(near_level, far_level + 3);
}

TEST(Roam, EachTriangleSharesAnEdgeWithTheOneBefore) {
  Roam roam(sea(), 5000);
  roam.adapt(over_the_sea({0.0, 0.0, 20.0}, 5000));
  Mesh mesh;
  roam.extract_mesh(mesh);
  for (std::size_t t = 1; t < mesh.level.size(); ++t) {
    int shared = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        shared += mesh.indices[3 * t + i] == mesh.indices[3 * t - 3 + j];
    ASSERT_EQ(shared, 2) << t;
  }
}

TEST(RoamDeathTest, RefusesWhatItCannotDo) {
  EXPECT_DEATH(Roam({{0.0, 0.0}, 1.0, 25}, 100), "lattice_bits=25");
  EXPECT_DEATH(Roam({{0.0, 0.0}, 0.0, 5}, 100), "size_m=0");
  EXPECT_DEATH(Roam({{0.0, 0.0}, 1.0, 5}, 1), "max_triangles=1");
  Roam roam({{0.0, 0.0}, 1.0, 3}, 100);
  EXPECT_DEATH(roam.adapt(from_far_above(101)), "triangle_budget=101");
  EXPECT_DEATH(roam.adapt(from_far_above(1)), "triangle_budget=1");
  AdaptRequest request = from_far_above(10);
  request.view.eye_world.x = NAN;
  EXPECT_DEATH(roam.adapt(request), "eye=\\(nan");
  request = from_far_above(10);
  request.min_height_m = 1.0f;
  EXPECT_DEATH(roam.adapt(request), "min_height_m=1");
  request = from_far_above(10);
  const std::array<Focus, 1> point{Focus{{0.0, 0.0}, 0.0}};
  request.focuses = point;
  EXPECT_DEATH(roam.adapt(request), "radius_m=0");
  request.focuses = {};
  request.factors.focus_nearer = 0.5f;
  EXPECT_DEATH(roam.adapt(request), "focus_nearer=0.5");
  request = from_far_above(10);
  request.view.forward.y = NAN;
  EXPECT_DEATH(roam.adapt(request), "normal=\\(nan");
}

}  // namespace
}  // namespace swell::lod
