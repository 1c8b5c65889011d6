// Many rays to the water at once: against closed forms, fine marching and single rays.
#include "ocean/water_rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "constants.h"
#include "math/random.h"
#include "ocean/frame_at.h"
#include "ocean/simd_targets.h"
#include "ocean/wakes/wakes.h"

namespace swell::ocean {
namespace {

constexpr SeaArea kOpenWater{{0.0, 0.0}, {20000.0, 20000.0}};

struct Rays {
  std::vector<glm::dvec3> origin, along;
  std::vector<double> farthest_m;

  void add(glm::dvec3 from, glm::dvec3 direction, double far_m) {
    origin.push_back(from);
    along.push_back(glm::normalize(direction));
    farthest_m.push_back(far_m);
  }
  std::vector<double> meet(const WaterParts& parts, const SeaFrame& frame) const {
    const WaterSurface water(parts, frame);
    std::vector<double> met_m(origin.size());
    meet_water(water, frame_bounds(parts, frame, {}), {origin, along, farthest_m}, met_m);
    return met_m;
  }
};

// From 1 to 9 m over the mean level, nearly level to straight down.
Rays scattered_rays(std::uint64_t count) {
  Rays rays;
  for (std::uint64_t n = 0; n < count; ++n) {
    const double azimuth = 6.2832 * random_uniform(1, 4 * n);
    const double fall = std::pow(10.0, 1.0 - 3.0 * random_uniform(1, 4 * n + 1));
    rays.add({100.0 * random_uniform(1, 4 * n + 2), 50.0, 1.0 + 8.0 * random_uniform(1, 4 * n + 3)},
             {std::cos(azimuth), std::sin(azimuth), -fall}, 150.0);
  }
  return rays;
}

SeaDescription flat() {
  SeaDescription sea;
  sea.spectrum = false;
  return sea;
}

TEST(WaterRays, MeetAFlatSeaWhereItIs) {
  const Sea sea(flat());
  const SeaFrame frame = frame_at(sea, 0.0);
  Rays rays;
  rays.add({0, 0, 5}, {0, 0, -1}, 100.0);
  rays.add({0, 0, 5}, {3, 0, -4}, 100.0);
  rays.add({0, 0, 5}, {1, 2, -0.125}, 1000.0);
  rays.add({0, 0, 5}, {1, 0, -0.125}, 40.0);  // too short
  rays.add({0, 0, 5}, {1, 0, 0}, 1000.0);
  rays.add({0, 0, 5}, {1, 0, 0.5}, 1000.0);
  rays.add({0, 0, -5}, {1, 0, 0.5}, 1000.0);  // begins under it
  const std::vector<double> met = rays.meet({&sea, kOpenWater}, frame);
  EXPECT_NEAR(met[0], 5.0, 2e-5);
  EXPECT_NEAR(met[1], 6.25, 2e-5);
  EXPECT_NEAR(met[2], 40.0 * std::sqrt(5.0 + 0.125 * 0.125), 2e-4);
  for (const std::size_t n : {3u, 4u, 5u}) EXPECT_EQ(met[n], HUGE_VAL) << n;
  EXPECT_EQ(met[6], 0.0);
}

TEST(WaterRays, MeetASineWhereItsFormulaSays) {
  SeaDescription description = flat();
  description.sines = {{0.5, 20.0, 0.5 * kPiRef, 0.0, 5.0}};  // to the east
  const Sea sea(description);
  const double t_s = 1.25;
  const SeaFrame frame = frame_at(sea, t_s);
  const Rays rays = scattered_rays(300);
  const std::vector<double> met = rays.meet({&sea, kOpenWater}, frame);
  const auto height = [&](double x) {
    return 0.5 * std::sin(2.0 * kPiRef * (x / 20.0 - t_s / 5.0));
  };
  for (std::size_t n = 0; n < met.size(); ++n) {
    const auto gap = [&](double s) {
      const glm::dvec3 p = rays.origin[n] + s * rays.along[n];
      return p.z - height(p.x);
    };
    double root = HUGE_VAL;
    for (double s = 0.0; s < rays.farthest_m[n]; s += 1e-3)
      if (gap(s) <= 0.0) {
        root = s;
        break;
      }
    if (root == HUGE_VAL) {
      EXPECT_EQ(met[n], HUGE_VAL) << n;
    } else {
      EXPECT_NEAR(met[n], root, 1.1e-3) << n;
    }
  }
}

// Whether a place of the ray before met_m lies under water: looked for in steps of 2 cm + s / 5000,
// which the rays are allowed to pass a tip by.
void expect_first(const WaterSurface& water, const Rays& rays, std::size_t n, double met_m) {
  std::vector<glm::dvec2> p;
  std::vector<double> z, at;
  const double end_m = std::min(met_m, rays.farthest_m[n]);
  for (double s = 0.0; s < end_m; s += 0.01) {
    const glm::dvec3 q = rays.origin[n] + s * rays.along[n];
    p.emplace_back(q);
    z.push_back(q.z);
    at.push_back(s);
  }
  std::vector<float> height(p.size());
  water.heights(p, height);
  double under_since = -1.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const bool is_under = z[i] <= static_cast<double>(height[i]);
    if (!is_under) under_since = -1.0;
    if (is_under && under_since < 0.0) under_since = at[i];
    EXPECT_TRUE(!is_under || at[i] - under_since <= 0.03 + 2e-4 * at[i]) << n << " at " << at[i];
  }
  if (met_m == HUGE_VAL) return;
  const glm::dvec3 q = rays.origin[n] + met_m * rays.along[n];
  EXPECT_NEAR(q.z, static_cast<double>(water.height(glm::dvec2(q))), 3e-5) << n;
}

TEST(WaterRays, JumpNoCrestOfAWindySea) {
  for (const double wind_mps : {3.0, 9.0, 18.0}) {
    SeaDescription description;
    description.wind_speed_mps = wind_mps;
    description.resolution = 64;
    const Sea sea(description);
    const SeaFrame frame = frame_at(sea, 4.0);
    const Rays rays = scattered_rays(150);
    const std::vector<double> met = rays.meet({&sea, kOpenWater}, frame);
    const WaterSurface water({&sea, kOpenWater}, frame);
    int hits = 0;
    for (std::size_t n = 0; n < met.size(); ++n) {
      if (met[n] == 0.0) continue;
      expect_first(water, rays, n, met[n]);
      hits += met[n] < HUGE_VAL;
    }
    EXPECT_GT(hits, 75) << wind_mps;
  }
}

TEST(WaterRays, AreTheSameBitsAloneAndAmongOthersAndOnEveryTarget) {
  SeaDescription description;
  description.resolution = 64;
  const Sea sea(description);
  const SeaFrame frame = frame_at(sea, 4.0);
  const Rays rays = scattered_rays(600);
  const std::vector<double> met = rays.meet({&sea, kOpenWater}, frame);
  for (std::size_t n = 0; n < rays.origin.size(); n += 37) {
    Rays one;
    one.add(rays.origin[n], rays.along[n], rays.farthest_m[n]);
    one.along[0] = rays.along[n];
    EXPECT_EQ(one.meet({&sea, kOpenWater}, frame)[0], met[n]) << n;
  }
  for_each_simd_target([&] { EXPECT_EQ(rays.meet({&sea, kOpenWater}, frame_at(sea, 4.0)), met); });
}

TEST(WaterRays, MeetAWakeWhereItStands) {
  const Sea sea(flat());
  SeaFrame frame = frame_at(sea, 1.0);
  Disturbance drop;
  drop.kind = DisturbanceKind::kDrop;
  drop.radius_m = 2.0;
  drop.height_m = 0.8;
  Workers workers(1);
  advance_wakes(std::span(&drop, 1), {}, 9.81, 1.0, frame.wakes, workers);
  ASSERT_EQ(frame.wakes.count, 1u);
  WaterParts parts{&sea, kOpenWater};
  parts.wakes = wake_bounds(std::span(&drop, 1), 9.81);
  const WaterSurface water(parts, frame);
  Rays rays;
  for (std::uint64_t n = 0; n < 100; ++n)
    rays.add({-15.0, -3.0 + 0.06 * static_cast<double>(n), 1.5},
             {1.0, 0.0, -0.05 - 0.1 * random_uniform(7, n)}, 60.0);
  const std::vector<double> met = rays.meet(parts, frame);
  int raised = 0;
  for (std::size_t n = 0; n < met.size(); ++n) {
    expect_first(water, rays, n, met[n]);
    raised += met[n] < HUGE_VAL && (rays.origin[n] + met[n] * rays.along[n]).z > 0.02;
  }
  EXPECT_GT(raised, 10);
}

}  // namespace
}  // namespace swell::ocean
