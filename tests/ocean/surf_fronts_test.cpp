// Fronts of surf that lift the water: the front function of the paper's figure 7, and the waves
// that four of them make before a beach.
#include "ocean/coast/surf_fronts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "constants.h"
#include "frame_at.h"
#include "math/random.h"
#include "ocean/below/sea_below.h"
#include "ocean/open_sea/sea_state.h"
#include "ocean/water_surface.h"
#include "simd_targets.h"
#include "terrain/sea_floor.h"

namespace swell::ocean {
namespace {

// The front function where fronts 0 and 1 are as high as they get and 2 and 3 are 0.3 as high.
FrontSamples sample_at(float cycles, float part) {
  FrontSamples samples;
  samples.count = 1;
  samples.part[0] = part;
  FrontClock clock;
  clock.cycles = cycles;
  sample_front_function(clock, samples);
  return samples;
}

// Figure 7: 3 x^2 - 2 x^3 up the face, which is 0.11 turns wide far out and 0.05 at the shore, then
// (1 - y)^3 (1 + 3 y) down a back of the rest of a quarter.
TEST(FrontFunction, IsASteepFaceAndALongBack) {
  for (const float part : {0.2f, 1.6f}) {
    const float face = part < 1.0f ? 0.05f : 0.11f, back = 0.25f - face;
    EXPECT_NEAR(sample_at(0.0f, part).lift[0], 1.0f, 1e-6f);
    EXPECT_NEAR(sample_at(1.0f - 0.5f * face, part).lift[0], 0.5f, 1e-4f);
    EXPECT_NEAR(sample_at(1.0f - 0.25f * face, part).lift[0], 0.84375f, 1e-4f);
    EXPECT_NEAR(sample_at(0.5f * back, part).lift[0], 0.3125f, 1e-4f);
    EXPECT_NEAR(sample_at(0.25f * back, part).lift[0], 0.73828f, 1e-4f);
  }
}

TEST(FrontFunction, TheRateIsItsDerivative) {
  constexpr float kStep = 1e-3f;
  int wrong = 0;
  for (int n = 0; n < 400; ++n) {
    const auto cycles = static_cast<float>(random_uniform(8, 2 * n));
    const auto part = static_cast<float>(2.0 * random_uniform(8, 2 * n + 1));
    const float rise =
        sample_at(cycles + kStep, part).lift[0] - sample_at(cycles - kStep, part).lift[0];
    wrong += std::abs(sample_at(cycles, part).rate[0] - rise / (2.0f * kStep)) > 0.15f;
  }
  EXPECT_LE(wrong, 8);  // where one front gives way to the next there is an edge
}

TEST(FrontFunction, IsTheSameBitsOnEverySimdTarget) {
  FrontSamples samples;
  samples.count = kPointChunk - 3;
  for (std::size_t i = 0; i < samples.count; ++i) {
    samples.x[i] = static_cast<float>(900.0 * random_uniform(4, 3 * i));
    samples.y[i] = static_cast<float>(900.0 * random_uniform(4, 3 * i + 1));
    samples.part[i] = static_cast<float>(2.0 * random_uniform(4, 3 * i + 2));
  }
  const FrontClock clock = make_front_clock({.reach_m = 60.0, .reach_s = 9.0, .period_s = 4.0},
                                            SeaDescription{}, 12.3, {400.0, -77.0});
  std::vector<std::array<float, kPointChunk>> lifts;
  for_each_simd_target([&] {
    samples.lift = {};
    sample_front_function(clock, samples);
    lifts.push_back(samples.lift);
  });
  for (const auto& lift : lifts)
    EXPECT_TRUE(std::equal(lift.begin(), lift.begin() + samples.count, lifts[0].begin()));
}

// A beach of 3 in 100 with the sea in the north, from where the wind comes.
struct FrontBeach {
  static constexpr double kSlope = 0.03, kShore_m = -150.0;

  static SeaDescription windy() {
    SeaDescription sea;
    sea.wind_speed_mps = 8.0;
    sea.resolution = 64;
    sea.patch_lengths_m = {180.0, 27.0};
    return sea;
  }
  FrontBeach() : sea(windy()) {
    const terrain::Grid grid{{-400.0, -400.0}, 4.0, 201, 201};
    land = terrain::make_plane_beach(grid, {{{-1.0, kShore_m}, {0.0, kShore_m}}, kSlope, 40.0});
    Workers workers(2);
    const terrain::ShoreMap shore(land, workers);
    shelter = make_shelter(shore, make_beams(sea.description()), workers);
    fronts = make_surf_fronts(shore, land.grid, sea, shelter, 1.0, workers);
  }
  WaterParts parts() const {
    return {.sea = &sea, .land = &land, .shelter = &shelter, .fronts = &fronts};
  }
  double reach_m() const { return fronts.zone.reach_m; }
  double depth_m(glm::dvec2 p) const { return kSlope * (p.y - kShore_m); }
  // Heights of the water at p over time.
  std::vector<double> heights(glm::dvec2 p, double from_s, double step_s, int count) const {
    std::vector<double> z;
    const WaterBody water(parts());
    SeaFrame frame;  // calm but for the fronts: nothing else is at places that are all theirs
    for (int n = 0; n < count; ++n) {
      frame.t_s = from_s + step_s * n;
      float height_m = 0.0f;
      water.heights(frame, {&p, 1}, {&height_m, 1});
      z.push_back(static_cast<double>(height_m));
    }
    return z;
  }
  // Somewhere where the fronts are all waves.
  glm::dvec2 place(int n) const {
    const auto dice = [&](int i) { return random_uniform(6, 2 * n + i); };
    return {400.0 * (dice(0) - 0.5), kShore_m + reach_m() * (0.05 + 0.9 * dice(1))};
  }

  Sea sea;
  terrain::HeightGrid land;
  Shelter shelter;
  SurfFronts fronts;
};

const FrontBeach& front_beach() {
  static const FrontBeach made;
  return made;
}

// Four fronts, each every fourth wave: all is as before after 4 T, and not after T.
TEST(SurfFronts, FourOfThemComeInFourPeriods) {
  const double period_s = front_beach().fronts.zone.period_s;
  double most = 0.0, most_after_one = 0.0;
  for (int n = 0; n < 20; ++n) {
    const std::vector<double> z =
        front_beach().heights(front_beach().place(n), 3.0, period_s / 40.0, 200);
    int crests = 0;
    for (std::size_t i = 0; i < 160; ++i) {
      EXPECT_NEAR(z[i % 40 + 160], z[i % 40], 2e-3);
      most = std::max(most, std::abs(z[i]));
      most_after_one = std::max(most_after_one, std::abs(z[i + 40] - z[i]));
      crests += z[i + 1] > z[i] && z[i + 1] >= z[i + 2];
    }
    EXPECT_GE(crests, 2) << n;  // one may be low, or melt into the one before
    EXPECT_LE(crests, 4) << n;
  }
  EXPECT_GT(most_after_one, 0.3 * most);
}

// From trough to crest 0.78 of the depth at most, and near the shore not much less.
TEST(SurfFronts, BreakAt078OfTheDepth) {
  const double period_s = front_beach().fronts.zone.period_s;
  double most = 0.0;
  for (int n = 0; n < 60; ++n) {
    const glm::dvec2 p = front_beach().place(n);
    const std::vector<double> z = front_beach().heights(p, 0.0, period_s / 50.0, 200);
    const auto [low, high] = std::ranges::minmax(z);
    EXPECT_LE(high - low, 0.78 * front_beach().depth_m(p) + 1e-4);
    most = std::max(most, (high - low) / front_beach().depth_m(p));
  }
  EXPECT_GT(most, 0.7);
}

// Out of the deep they grow from nothing.
TEST(SurfFronts, GrowOnTheirWayIn) {
  const auto height_at = [&](double reaches) {
    const glm::dvec2 p(7.0, FrontBeach::kShore_m + reaches * front_beach().reach_m());
    const FrontPlace place = place_in_fronts(front_beach().fronts, p);
    return static_cast<double>(
        front_height_m(place.at, static_cast<float>(front_beach().depth_m(p))));
  };
  EXPECT_EQ(height_at(2.1), 0.0);
  double before = 0.0;
  for (const double reaches : {1.8, 1.6, 1.4, 1.2, 1.0}) {
    EXPECT_GT(height_at(reaches), before) << reaches;
    before = height_at(reaches);
  }
  EXPECT_NEAR(before, front_beach().sea.significant_height_m(),
              0.05 * front_beach().sea.significant_height_m());
}

// By how much later heights at two places fit best, in steps.
int best_delay(const std::vector<double>& first, const std::vector<double>& later, int most) {
  int best = 0;
  double highest = -1e9;
  for (int delay = 0; delay < most; ++delay) {
    double sum = 0.0;
    for (std::size_t i = 0; i < first.size(); ++i)
      sum += first[i] * later[i + static_cast<std::size_t>(delay)];
    if (sum > highest) highest = sum, best = delay;
  }
  return best;
}

// Crests run in at sqrt(g d), in the mean over their lags.
TEST(SurfFronts, RunToTheShoreAsFastAsShallowWatersWaves) {
  constexpr double kStep_s = 0.04;
  constexpr int kPlaces = 24;
  const double period_s = front_beach().fronts.zone.period_s;
  const int count = static_cast<int>(4.0 * period_s / kStep_s);
  for (const double reaches : {0.4, 0.6, 0.75}) {
    const double far_m = reaches * front_beach().reach_m(), near_m = far_m - 4.0;
    double mean_s = 0.0;
    for (int n = 0; n < kPlaces; ++n) {
      const double x_m = 16.0 * n - 200.0, shore_m = FrontBeach::kShore_m;
      mean_s += kStep_s / kPlaces *
                best_delay(front_beach().heights({x_m, shore_m + far_m}, 5.0, kStep_s, count),
                           front_beach().heights({x_m, shore_m + near_m}, 5.0, kStep_s, 2 * count),
                           static_cast<int>(0.7 * period_s / kStep_s));
    }
    const double way_s =
        2.0 / std::sqrt(kG * FrontBeach::kSlope) * (std::sqrt(far_m) - std::sqrt(near_m));
    EXPECT_NEAR(mean_s, way_s, 0.05 * way_s) << reaches;
  }
}

// The mean direction in which heights change, by their squared slopes.
TEST(SurfFronts, LieAlongTheShoreWithin10Degrees) {
  SeaFrame frame;
  frame.t_s = 11.0;
  const WaterBody water(front_beach().parts());
  double across = 0.0, twist = 0.0, all = 0.0;
  for (int n = 0; n < 2000; ++n) {
    const glm::dvec2 p = front_beach().place(n);
    glm::vec2 slope;
    water.slopes(frame, {&p, 1}, {&slope, 1});
    const glm::dvec2 g(slope);
    across += g.y * g.y - g.x * g.x;
    twist += 2.0 * g.x * g.y;
    all += glm::dot(g, g);
  }
  EXPECT_LT(std::abs(0.5 * std::atan2(twist, across)), 10.0 * kDegree);
  EXPECT_GT(std::hypot(across, twist), 0.7 * all);
}

TEST(SurfFronts, TakeAndGiveNoWater) {
  double sum = 0.0, deepest = 0.0;
  for (int n = 0; n < 200; ++n) {
    const glm::dvec2 p = front_beach().place(n);
    for (const double z : front_beach().heights(p, 0.0, 0.37, 40))
      sum += z /
             std::min(front_beach().sea.significant_height_m(), 0.78 * front_beach().depth_m(p)) /
             8000.0;
    deepest = std::max(deepest, front_beach().depth_m(p));
  }
  EXPECT_NEAR(sum, 0.0, 0.03);
  EXPECT_GT(deepest, 0.0);
}

TEST(SurfFronts, SlopesAreThoseOfTheHeightsAndWithinTheBounds) {
  const WaterBody water(front_beach().parts());
  SeaFrame frame;
  constexpr double kStep_m = 0.01;
  int wrong = 0;
  float steepest = 0.0f, highest = 0.0f;
  for (int n = 0; n < 600; ++n) {
    frame.t_s = 0.7 * n;
    const glm::dvec2 p = front_beach().place(n), dx(kStep_m, 0.0), dy(0.0, kStep_m);
    const std::vector<glm::dvec2> at = {p + dx, p - dx, p + dy, p - dy};
    std::vector<float> z(4);
    water.heights(frame, at, z);
    glm::vec2 slope;
    water.slopes(frame, {&p, 1}, {&slope, 1});
    const glm::vec2 rise = glm::vec2(z[0] - z[1], z[2] - z[3]) / static_cast<float>(2.0 * kStep_m);
    wrong += glm::length(rise - slope) > 0.01f;
    steepest = std::max(steepest, glm::length(slope));
    highest = std::max(highest, std::abs(z[0]));
  }
  EXPECT_LE(wrong, 12);  // a difference may straddle an edge
  EXPECT_LE(steepest, front_beach().fronts.slope_bound);
  EXPECT_GT(steepest, 0.2f * front_beach().fronts.slope_bound);
  EXPECT_LE(highest, front_beach().fronts.height_bound_m);
  EXPECT_LE(front_beach().fronts.height_bound_m, water.bounds().height_m);
}

// Up it is the heights' rate; along, towards the shore under crests and back in the troughs.
TEST(SurfFronts, VelocitiesAreThoseOfLongWaves) {
  const WaterBody water(front_beach().parts());
  VelocityFrame velocity;
  int wrong = 0;
  for (int n = 0; n < 300; ++n) {
    const glm::dvec2 p = front_beach().place(n);
    velocity.z.t_s = 0.9 * n;
    glm::vec3 v;
    water.velocities(velocity, {&p, 1}, {&v, 1});
    const std::vector<double> z = front_beach().heights(p, velocity.z.t_s - 2e-3, 2e-3, 3);
    wrong += std::abs(static_cast<double>(v.z) - (z[2] - z[0]) / 4e-3) > 0.02;
    const double along = z[1] * std::sqrt(kG / front_beach().depth_m(p));
    EXPECT_NEAR(static_cast<double>(v.y), -along, 0.02 + 0.02 * std::abs(along));
    EXPECT_NEAR(v.x, 0.0f, 0.02f);
  }
  EXPECT_LE(wrong, 6);
}

// Along the same on the whole depth, up less and less down to the ground; the head is the height.
TEST(SurfFronts, BelowTheSurfaceTheWaterMovesAsUnderLongWaves) {
  SeaBelow now(front_beach().parts(), 7.0);
  int lifted = 0;
  for (int n = 0; n < 100; ++n) {
    const glm::dvec2 p = front_beach().place(n);
    const double surface = now.surface().height(p), ground = -front_beach().depth_m(p);
    const WaterMotion top = now.motion({p, surface}),
                      middle = now.motion({p, 0.5 * (surface + ground)}),
                      floor = now.motion({p, ground + 1e-4});
    glm::vec3 v;
    now.surface().velocities({&p, 1}, now.velocity, {&v, 1});
    EXPECT_EQ(top.velocity_mps, v);
    EXPECT_NEAR(top.pressure_pa, kSeaDensity_kg_m3 * kG * surface, 1.0);
    const float off = 0.02f;  // of what waves of the sea are left
    EXPECT_NEAR(floor.velocity_mps.y, v.y, off);
    EXPECT_NEAR(middle.velocity_mps.z, 0.5f * v.z, off);
    EXPECT_NEAR(floor.velocity_mps.z, 0.0f, off);
    EXPECT_NEAR(floor.pressure_pa, top.pressure_pa, 100.0f);
    lifted += std::abs(v.y) > 0.3f;
  }
  EXPECT_GT(lifted, 30);
}

// Offshore the sea is as it is without them, bit for bit; from one reach on they are all waves.
TEST(SurfFronts, TakeTheRoomOfTheSeasWaves) {
  WaterParts parts = front_beach().parts();
  const WaterBody with(parts);
  parts.fronts = nullptr;
  const WaterBody without(parts);
  SeaFrame frame = frame_at(front_beach().sea, 5.0);
  const double reach_m = front_beach().reach_m();
  const auto height = [&](const WaterBody& water, double reaches) {
    const glm::dvec2 p(3.0, FrontBeach::kShore_m + reaches * reach_m);
    float z = 0.0f;
    water.heights(frame, {&p, 1}, {&z, 1});
    return z;
  };
  EXPECT_EQ(height(with, 2.1), height(without, 2.1));
  EXPECT_NE(height(with, 0.8), height(without, 0.8));
  SeaFrame calm;
  calm.t_s = 5.0;
  const glm::dvec2 p(3.0, FrontBeach::kShore_m + 0.8 * reach_m);
  float z = 0.0f;
  with.heights(calm, {&p, 1}, {&z, 1});
  EXPECT_EQ(height(with, 0.8), z);
  frame.has_fronts = false;
  EXPECT_EQ(height(with, 0.8), height(without, 0.8));
}

TEST(SurfFronts, AreTheSameBitsWithAnyWorkers) {
  Workers one(1), three(3);
  const terrain::ShoreMap shore(front_beach().land, one);
  const auto make = [&](Workers& workers) {
    return make_surf_fronts(shore, front_beach().land.grid, front_beach().sea,
                            front_beach().shelter, 1.0, workers);
  };
  const SurfFronts a = make(one), b = make(three);
  for (std::size_t k = 0; k < a.points.size(); ++k) {
    ASSERT_EQ(a.points[k].part, b.points[k].part);
    ASSERT_EQ(a.points[k].height_m, b.points[k].height_m);
  }
}

}  // namespace
}  // namespace swell::ocean
