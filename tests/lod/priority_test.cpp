#include "lod/priority.h"

#include <gtest/gtest.h>

#include <bit>

#include "lod/camera_walk.h"
#include "lod/diamond.h"
#include "lod/diamond_oracle.h"
#include "math/simd_target.h"

namespace swell::lod {
namespace {

TEST(Diamond, LevelsParentsAndChildrenFollowTheCoordinates) {
  const int bits = 4;
  for (const oracle::OracleDiamond& d : oracle::all_diamonds(bits)) {
    EXPECT_EQ(half_size(bits, d.level), d.half);
    for (const oracle::Point& p : d.parents) {
      const int parent_level = oracle::make_diamond(bits, p.first, p.second).level;
      ASSERT_EQ(parent_level, d.level - 1);
      int found = 0;
      for (int slot = 0; slot < 4; ++slot) {
        const glm::ivec2 child =
            glm::ivec2(p.first, p.second) + child_offset(bits, parent_level, slot);
        found += child == glm::ivec2(d.centre.first, d.centre.second);
      }
      EXPECT_EQ(found, 1);
    }
    const std::size_t expected = d.level == 0                                         ? 0u
                                 : on_border(bits, {d.centre.first, d.centre.second}) ? 1u
                                                                                      : 2u;
    EXPECT_EQ(d.parents.size(), expected);
  }
}

TEST(Diamond, OppositeSlotsAreOpposite) {
  for (int level = 0; level < 6; ++level)
    for (int slot = 0; slot < 4; ++slot)
      EXPECT_EQ(child_offset(5, level, slot), -child_offset(5, level, slot ^ 2));
}

// LOD-05: without any tolerance, for every pair on the lattice.
TEST(Priority, AChildNeverComesBeforeItsParents) {
  const int bits = 5;
  const Domain domain{{-300.0, 2000.0}, 700.0, bits};
  const std::vector<oracle::OracleDiamond> diamonds = oracle::all_diamonds(bits);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    CameraWalk walk(seed, domain, 100);
    for (int step = 0; step < 40; ++step) {
      const PriorityFrame frame = make_priority_frame(walk.next(), domain);
      for (const oracle::OracleDiamond& d : diamonds) {
        const PriorityKey key = priority_key(frame, d.centre.first, d.centre.second, d.level);
        ASSERT_LE(key, kCulledKey);
        for (const oracle::Point& p : d.parents)
          ASSERT_LE(priority_key(frame, p.first, p.second, d.level - 1), key);
      }
    }
  }
}

TEST(Priority, KeysAreTheSquaredDistanceInUnitsOfTheSize) {
  const Domain domain{{0.0, 0.0}, 16.0, 4};  // one step a metre
  AdaptRequest request;
  request.view = make_view({8.0, 40.0, 11.0}, 3.14159265, 0.0, 1.5, 0.1f, 64, 64);
  request.max_height_m = 1.0f;
  const auto key = [&](int x, int y, int level) {
    return std::bit_cast<float>(priority_key(make_priority_frame(request, domain), x, y, level));
  };
  EXPECT_EQ(key(8, 8, 0), 24.0f * 24.0f + 100.0f);             // clipped to the domain
  EXPECT_EQ(key(9, 9, 6), 64.0f * (28.0f * 28.0f + 100.0f));   // reaches 3 up to y = 12
  EXPECT_EQ(key(8, 9, 7), 128.0f * (29.0f * 29.0f + 100.0f));  // reaches 2 up to y = 11
  request.priority = Priority::kInverseDistance;
  EXPECT_EQ(key(9, 9, 6), 28.0f * 28.0f + 100.0f);
}

TEST(Priority, AFocusCountsAsNearerDownToAQuarterOfItsRadius) {
  const Domain domain{{0.0, 0.0}, 16.0, 4};  // one step a metre
  AdaptRequest request;
  request.view = make_view({8.0, 40.0, 0.0}, 3.14159265, 0.0, 1.5, 0.1f, 64, 64);
  const std::array<Focus, 1> focus{Focus{{8.0, 7.0}, 4.0}};
  request.focuses = focus;
  request.factors.focus_nearer = 4.0f;
  const auto key = [&](int x, int y, int level) {
    return std::bit_cast<float>(priority_key(make_priority_frame(request, domain), x, y, level));
  };
  EXPECT_EQ(key(8, 8, 0), 24.0f * 24.0f / 16.0f);
  EXPECT_EQ(key(9, 9, 6), 64.0f * 28.0f * 28.0f / 16.0f);   // 2 m wide
  EXPECT_EQ(key(9, 8, 7), 128.0f * 30.0f * 30.0f / 16.0f);  // 1.4 m wide
  EXPECT_EQ(key(9, 15, 6), 64.0f * 24.0f * 24.0f);          // begins 5 m from the centre
  request.focuses = {};
  EXPECT_EQ(key(9, 9, 6), 64.0f * 28.0f * 28.0f);
}

TEST(Priority, WhatLiesBehindTheEyeIsCulledAndAMarginWidensTheView) {
  const Domain domain{{0.0, 0.0}, 1024.0, 10};
  AdaptRequest request;
  request.view = make_view({512.0, 512.0, 5.0}, 0.0, 0.0, 1.0, 0.1f, 64, 64);
  const auto culled = [&](int x, int y) {
    return priority_key(make_priority_frame(request, domain), x, y, 19) == kCulledKey;
  };
  EXPECT_FALSE(culled(512, 701));
  EXPECT_TRUE(culled(512, 301));
  EXPECT_TRUE(culled(712, 701));  // 45 degrees off the axis; the view ends at 28.6
  request.frustum_margin = 0.5f;
  EXPECT_FALSE(culled(712, 701));
}

TEST(Priority, EverySimdTargetGivesTheBitsOfTheScalarFormula) {
  const int bits = 6;
  const Domain domain{{-300.0, 2000.0}, 700.0, bits};
  const std::vector<oracle::OracleDiamond> diamonds = oracle::all_diamonds(bits);
  std::vector<std::int32_t> x, y, level;
  for (const oracle::OracleDiamond& d : diamonds) {
    x.push_back(d.centre.first);
    y.push_back(d.centre.second);
    level.push_back(d.level);
  }
  std::vector<PriorityKey> keys(x.size());
  const SimdTarget best = current_simd_target();
  for (const SimdTarget target : {SimdTarget::kAvx2, SimdTarget::kAvx512}) {
    if (!simd_target_available(target)) continue;
    select_simd_target(target);
    CameraWalk walk(7, domain, 100);
    for (int step = 0; step < 30; ++step) {
      const AdaptRequest request = walk.next();
      compute_priority_keys(make_priority_frame(request, domain), x, y, level, keys);
      for (std::size_t i = 0; i < keys.size(); ++i)
        ASSERT_EQ(keys[i],
                  std::bit_cast<PriorityKey>(oracle::badness(request, domain, diamonds[i])))
            << simd_target_name(target) << " step " << step << " diamond " << i;
    }
  }
  select_simd_target(best);
}

}  // namespace
}  // namespace swell::lod
