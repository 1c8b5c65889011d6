// Properties on random camera walks; each failure prints the seed and the step.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "lod/camera_walk.h"
#include "lod/diamond_oracle.h"
#include "lod/mesh_checks.h"
#include "lod/roam.h"
#include "lod/tree.h"
#include "trials.h"

namespace swell::lod {
namespace {

Domain small_domain(int bits) { return {{-300.0, 2000.0}, 700.0, bits}; }

int full_triangles(int bits) { return 2 << (2 * bits); }

std::set<oracle::Point> split_set(const Mesh& mesh) {
  std::set<oracle::Point> points;
  for (std::size_t v = 4; v < mesh.lattice.size(); ++v)
    points.insert({mesh.lattice[v].x, mesh.lattice[v].y});
  return points;
}

int difference(const std::set<oracle::Point>& a, const std::set<oracle::Point>& b) {
  std::vector<oracle::Point> out;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
  return static_cast<int>(out.size());
}

void expect_same_mesh(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.lattice, b.lattice);
  EXPECT_EQ(a.indices, b.indices);
  EXPECT_EQ(a.level, b.level);
}

class RoamWalk : public testing::TestWithParam<int> {};

// LOD-01..04, 10, 11, 12, 13.
TEST_P(RoamWalk, EveryStepReachesTheSetThatTheDefinitionNames) {
  const int bits = GetParam();
  const Domain domain = small_domain(bits);
  std::vector<oracle::OracleDiamond> diamonds = oracle::all_diamonds(bits);
  const int steps = bits >= 6 ? 15 : 40, walks = trials(bits <= 3 ? 80 : 10);
  Mesh mesh;
  for (int seed = 0; seed < walks; ++seed) {
    Roam roam(domain, full_triangles(bits));
    const auto random = static_cast<std::uint64_t>(seed);
    const std::vector<float> height_m = make_heights(bits, random);
    const ReliefBounds relief(height_m, (1 << bits) + 1, 1.0);
    oracle::bound_relief(diamonds, bits, 1.0, height_m);
    CameraWalk walk(random, domain, full_triangles(bits), &relief);
    std::set<oracle::Point> before;
    for (int step = 0; step < steps; ++step) {
      SCOPED_TRACE(fmt::format("bits {} seed {} step {}", bits, seed, step));
      const AdaptRequest request = walk.next();
      const AdaptStatistics done = roam.adapt(request);
      roam.extract_mesh(mesh);

      const std::set<oracle::Point> expected = oracle::target(request, domain, diamonds);
      ASSERT_EQ(split_set(mesh), expected);
      if (bits <= 3 || step % 4 == 3) {  // slow
        ASSERT_EQ(oracle::leaves_of(mesh), oracle::leaves_of(expected, bits));
        ASSERT_EQ(find_mesh_fault(mesh, bits), "");
      }
      ASSERT_EQ(find_fault(roam.tree()), "");
      ASSERT_LE(done.triangles, request.triangle_budget);
      ASSERT_EQ(done.triangles, static_cast<int>(mesh.level.size()));
      ASSERT_FALSE(done.operation_cap_hit);
      if (done.anew)
        ASSERT_EQ(done.splits - done.merges, static_cast<int>(expected.size()));
      else
        ASSERT_EQ(done.splits + done.merges, difference(before, expected));
      before = expected;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(LatticeBits, RoamWalk, testing::Values(1, 2, 3, 4, 5, 6));

// LOD-14, at the size of a real terrain and of a real sea.
TEST(RoamHistory, AdaptMakesTheMeshOfRebuildWhateverCameBefore) {
  for (const int bits : {10, 17, 20, 24}) {
    const Domain domain{{-32768.0, -32768.0}, 65536.0, bits};
    Roam roam(domain, 8000), fresh(domain, 8000);
    const ReliefBounds relief(make_heights(8, 4), 257, 256.0);
    CameraWalk walk(100u + static_cast<unsigned>(bits), domain, 8000, &relief);
    Mesh mesh, fresh_mesh;
    for (int step = 0; step < 30; ++step) {
      SCOPED_TRACE(fmt::format("bits {} step {}", bits, step));
      const AdaptRequest request = walk.next();
      const AdaptStatistics done = roam.adapt(request);
      const AdaptStatistics from_roots = fresh.rebuild(request);
      roam.extract_mesh(mesh);
      fresh.extract_mesh(fresh_mesh);
      expect_same_mesh(mesh, fresh_mesh);
      ASSERT_EQ(done.triangles, from_roots.triangles);
      ASSERT_EQ(from_roots.merges, 0);
      ASSERT_FALSE(done.operation_cap_hit || from_roots.operation_cap_hit);
      ASSERT_EQ(find_fault(roam.tree()), "");
    }
    ASSERT_EQ(find_mesh_fault(mesh, bits), "");
  }
}

TEST(RoamHistory, AMillionTrianglesAreKeptLikeAFew) {
  const int most = trials(1000000);
  const Domain domain{{-32768.0, -32768.0}, 65536.0, 20};
  Roam roam(domain, most);
  AdaptRequest request;
  request.max_height_m = 2.0f;
  Mesh mesh, fresh_mesh;
  for (const auto& [north_m, up_m, budget] :
       {std::tuple{0.0, 20.0, most}, {9.0, 40000.0, 2}, {9.0, -3.0, most}, {9.5, -3.0, most}}) {
    request.view = make_view({0.0, north_m, up_m}, 0.2, -0.3, 1.0, 0.1f, 640, 480);
    request.triangle_budget = budget;
    const AdaptStatistics done = roam.adapt(request);
    EXPECT_LE(done.triangles, budget);
    EXPECT_GE(done.triangles, budget - 1);
    EXPECT_FALSE(done.operation_cap_hit);
  }
  roam.extract_mesh(mesh);
  roam.rebuild(request);
  roam.extract_mesh(fresh_mesh);
  EXPECT_TRUE(mesh.indices == fresh_mesh.indices && mesh.lattice == fresh_mesh.lattice);
}

TEST(RoamHistory, ManyPathsToOnePoseEndInOneMesh) {
  const Domain domain = small_domain(9);
  AdaptRequest end;
  end.view = make_view({10.0, 2300.0, 12.0}, 0.7, -0.2, 1.0, 0.1f, 640, 480);
  end.triangle_budget = 1500;
  end.max_height_m = 2.0f;
  Roam roam(domain, 4000);
  Mesh first, mesh;
  roam.rebuild(end);
  roam.extract_mesh(first);
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    CameraWalk walk(seed, domain, 4000, nullptr);
    for (int step = 0; step < 5; ++step) roam.adapt(walk.next());
    roam.adapt(end);
    roam.extract_mesh(mesh);
    SCOPED_TRACE(seed);
    expect_same_mesh(mesh, first);
  }
}

TEST(RoamHistory, MovingTheOriginIsForgottenToo) {
  Domain domain = small_domain(9);
  Roam roam(domain, 3000);
  CameraWalk walk(5, domain, 3000, nullptr);
  Mesh mesh, fresh_mesh;
  for (int step = 0; step < 20; ++step) {
    domain.min_world += glm::dvec2(step % 3 == 0 ? 350.0 : 0.0, step % 5 == 0 ? -87.5 : 0.0);
    roam.set_origin(domain.min_world);
    const AdaptRequest request = walk.next();
    roam.adapt(request);
    Roam fresh(domain, 3000);
    fresh.rebuild(request);
    roam.extract_mesh(mesh);
    fresh.extract_mesh(fresh_mesh);
    SCOPED_TRACE(step);
    expect_same_mesh(mesh, fresh_mesh);
  }
}

}  // namespace
}  // namespace swell::lod
