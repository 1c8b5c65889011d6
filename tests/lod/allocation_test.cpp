// What the triangulation allocates.
#include <gtest/gtest.h>

#include <array>

#include "allocation_count.h"
#include "lod/roam.h"

namespace swell::lod {
namespace {

constexpr std::array<Focus, 2> kFocuses = {Focus{{3.0, 40.0}, 2.0}, Focus{{-50.0, 70.0}, 5.0}};

AdaptRequest flight(int frame, int budget) {
  AdaptRequest request;
  request.view = make_view({0.1 * frame, 0.5 * frame, 15.0}, 0.01 * frame, -0.1, 1.0, 0.1f, 64, 48);
  request.triangle_budget = budget;
  request.frustum_margin = 0.1f;
  if (frame % 2 == 0) return request;
  // All that costs more, every other frame.
  request.factors = {.back_facing = 2.0f, .flat = 2.0f, .off_silhouette = 2.0f};
  request.factors.haze_distance_m = 5000.0f;
  request.focuses = kFocuses;
  request.limits.priority_groups = 1 + frame % 5;
  request.limits.max_operations = 5000;
  return request;
}

TEST(RoamAllocation, AFrameAllocatesNothing) {
  Roam roam({{-32768.0, -32768.0}, 65536.0, 17}, 8000);
  Mesh mesh;
  roam.adapt(flight(0, 8000));
  roam.extract_mesh(mesh);
  mesh.lattice.reserve(8004);
  const std::uint64_t before = allocation_count();
  for (int frame = 1; frame < 100; ++frame) {
    // Smooth flight, a half turn every 20 frames, budgets that jump.
    const int turned = frame + (frame / 20) * 314;
    roam.adapt(flight(turned, frame % 7 == 0 ? 500 : 8000));
    roam.extract_mesh(mesh);
  }
  EXPECT_EQ(allocation_count() - before, 0u);
}

TEST(RoamAllocation, TwoHundredThousandLeavesFitInto64Megabytes) {
  const std::uint64_t before = allocated_bytes();
  const Roam roam({{-32768.0, -32768.0}, 65536.0, 17}, 200000);
  EXPECT_LT(allocated_bytes() - before, 64'000'000u);
  EXPECT_GT(allocated_bytes() - before, 1'000'000u);
}

}  // namespace
}  // namespace swell::lod
