#include "lod/priority.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>

#include "lod/camera_walk.h"
#include "lod/diamond.h"
#include "lod/diamond_oracle.h"
#include "lod/relief_bounds.h"
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
  for (std::uint64_t seed = 0; seed < 15; ++seed) {
    const ReliefBounds relief(make_heights(bits, seed), (1 << bits) + 1, 1.0);
    CameraWalk walk(seed, domain, 100, &relief);
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
  request.largest_size_m = 2.0;
  EXPECT_EQ(key(8, 8, 0), 64.0f * (24.0f * 24.0f + 100.0f)) << "no worse than one of 2 m";
  EXPECT_EQ(key(9, 9, 6), 64.0f * (28.0f * 28.0f + 100.0f)) << "2 m wide";
  EXPECT_EQ(key(8, 9, 7), 128.0f * (29.0f * 29.0f + 100.0f)) << "1.4 m wide";
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

// From 10 m above the middle of the south border of a lattice of one metre, looking north.
AdaptRequest from_the_south() {
  AdaptRequest request;
  request.view = make_view({16.0, 0.0, 10.0}, 0.0, -0.5, 2.5, 0.1f, 64, 64);
  return request;
}

float key_at(const AdaptRequest& request, int x, int y, int level) {
  const Domain domain{{0.0, 0.0}, 32.0, 5};
  return std::bit_cast<float>(priority_key(make_priority_frame(request, domain), x, y, level));
}

// How many times further away than without factors the diamond counts.
float times_further(AdaptRequest request, int x, int y, int level) {
  const float with = key_at(request, x, y, level);
  request.factors = {};
  return std::sqrt(with / key_at(request, x, y, level));
}

// A plane through (0, 0, foot_m) with slope s northwards.
ReliefBounds plane(float foot_m, float s) {
  std::vector<float> height_m;
  for (int y = 0; y <= 32; ++y)
    height_m.insert(height_m.end(), 33, foot_m + s * static_cast<float>(y));
  return {height_m, 33, 1.0};
}

TEST(Priority, WhatTurnsItsBackCountsAsFurtherAway) {
  const ReliefBounds below_the_eye = plane(8.0f, -1.0f), above_the_eye = plane(40.0f, -1.0f);
  const ReliefBounds rising = plane(0.0f, 1.0f);
  AdaptRequest request = from_the_south();
  request.factors.back_facing = 3.0f;
  request.relief = &above_the_eye;
  EXPECT_FLOAT_EQ(times_further(request, 17, 25, 8), 3.0f);
  EXPECT_FLOAT_EQ(times_further(request, 9, 19, 8), 3.0f);
  request.relief = &below_the_eye;
  EXPECT_FLOAT_EQ(times_further(request, 17, 25, 8), 1.0f);
  request.relief = &rising;
  EXPECT_FLOAT_EQ(times_further(request, 17, 25, 8), 1.0f);
}

// Seen from 10 m above it, a surface with slopes up to s can have a silhouette at a point (x, y)
// if s (|x| + |y|) >= 10 m.
TEST(Priority, WhatHasNoSilhouetteCountsAsFurtherAway) {
  AdaptRequest request = from_the_south();
  request.factors.off_silhouette = 2.5f;
  request.max_slope = 0.5f;
  EXPECT_FLOAT_EQ(times_further(request, 17, 9, 8), 2.5f);   // 12 m north, 4 m east at most
  EXPECT_FLOAT_EQ(times_further(request, 17, 13, 8), 1.0f);  // 16 m and 4 m
  request.max_slope = 0.0f;
  EXPECT_FLOAT_EQ(times_further(request, 17, 13, 8), 2.5f);
}

TEST(Priority, FlatPartsCountAsFurtherAwayThanRoughOnes) {
  std::vector<float> height_m;  // a gentle ridge from south to north; flat from x = 16 on
  for (int y = 0; y <= 32; ++y)
    for (int x = 0; x <= 32; ++x)
      height_m.push_back(x < 16 ? 0.125f * static_cast<float>(8 - std::abs(x - 8)) : 0.0f);
  const ReliefBounds ridge(height_m, 33, 1.0);
  AdaptRequest request = from_the_south();
  request.max_height_m = 1.0f;
  request.factors.flat = 5.0f;
  request.relief = &ridge;
  EXPECT_NEAR(times_further(request, 27, 21, 8), 5.0f, 1e-6f);
  EXPECT_NEAR(times_further(request, 9, 21, 8), 3.0f, 0.05f);  // slopes +-1/8: half of 0.5 wide
}

TEST(Priority, HazeLowersPrioritiesByTheContrastThatIsLeft) {
  AdaptRequest request = from_the_south();
  request.factors.haze_distance_m = 20.0f;
  for (const int y : {5, 9, 13, 17, 21, 25, 29}) {
    const double distance = std::sqrt(key_at(from_the_south(), 17, y, 8) / 256.0f);
    const float further = times_further(request, 17, y, 8);
    EXPECT_NEAR(further, std::pow(1.0 + distance / 160.0, 8.0), 1e-5 * further) << y;
    if (distance < 20.0) {
      EXPECT_NEAR(further / std::exp(distance / 20.0), 1.0, 0.06) << y;
    }
  }
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
  std::vector<oracle::OracleDiamond> diamonds = oracle::all_diamonds(bits);
  std::vector<std::int32_t> x, y, level;
  for (const oracle::OracleDiamond& d : diamonds) {
    x.push_back(d.centre.first);
    y.push_back(d.centre.second);
    level.push_back(d.level);
  }
  std::vector<PriorityKey> keys(x.size());
  const SimdTarget best = current_simd_target();
  for (const SimdTarget target : simd_targets()) {
    if (!simd_target_available(target)) continue;
    select_simd_target(target);
    const std::vector<float> height_m = make_heights(bits, 9);  // hills
    const ReliefBounds relief(height_m, (1 << bits) + 1, 1.0);
    oracle::bound_relief(diamonds, bits, 1.0, height_m);
    CameraWalk walk(7, domain, 100, &relief);
    for (int step = 0; step < 100; ++step) {
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
