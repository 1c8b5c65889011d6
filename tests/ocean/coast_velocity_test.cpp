// The water under wave trains: linear theory in closed form, the rate of the heights, and the
// conservation of water.
#include "ocean/coast/coast_velocity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>
#include <vector>

#include "constants.h"
#include "math/random.h"
#include "ocean/train_sea.h"

namespace swell::ocean {
namespace {

TrainSea flat_sea(double depth_m, const WaveTrain& train) {
  return make_sea(
      terrain::make_sea_floor({{0.0, 0.0}, 5.0, 101, 61}, [=](glm::dvec2) { return depth_m; }),
      {train});
}

glm::dvec3 velocity_at(const TrainSea& sea, double t_s, glm::dvec2 p) {
  glm::vec3 v;
  sample_train_velocities(sea, t_s, {&p, 1}, {&v, 1});
  return v;
}

std::vector<glm::dvec2> random_points_in(int count, glm::dvec2 corner, glm::dvec2 size) {
  std::vector<glm::dvec2> points;
  for (int n = 0; n < count; ++n) {
    const auto c = static_cast<std::uint64_t>(2 * n);
    points.push_back(corner + size * glm::dvec2(random_uniform(8, c), random_uniform(8, c + 1)));
  }
  return points;
}

// 14 m is deep enough for the cosine profile of a 6 s wave and shallow enough for ellipses:
// coth(kh) is 1.07.
TEST(TrainVelocity, OneWaveMovesTheWaterOnEllipses) {
  const double depth_m = 14.0, omega = kTurn / 6.0, k = bisected_wave_number(6.0, depth_m);
  const double coth = 1.0 / std::tanh(k * depth_m);
  ASSERT_GT(coth, 1.05);
  const glm::dvec2 to(0.8, 0.6);
  const TrainSea sea = flat_sea(depth_m, {0.5, 6.0, to, 0.0});
  const double a = height_at(sea, 0.0, {0.0, 0.0});  // the wave at its crest: 0.5 m by its Ks
  for (const double t_s : {-77.0, 0.0, 2.5, 3600.0}) {
    for (const glm::dvec2& p : random_points_in(100, {0.0, 0.0}, {500.0, 300.0})) {
      const glm::dvec3 v = velocity_at(sea, t_s, p);
      const double phase = k * glm::dot(to, p) - omega * t_s;
      EXPECT_NEAR(v.x, a * omega * coth * to.x * std::cos(phase), 2e-4);
      EXPECT_NEAR(v.y, a * omega * coth * to.y * std::cos(phase), 2e-4);
      EXPECT_NEAR(v.z, a * omega * std::sin(phase), 2e-4);
    }
  }
}

// Shallow water: u = eta sqrt(g / h), with eta over the mean of the sharp-crested profile, -a / 3.
TEST(TrainVelocity, ShallowWaterMovesAlikeAtAllDepths) {
  const TrainSea sea = flat_sea(0.5, {0.02, 10.0, {1.0, 0.0}});
  double a = 0.0;  // the trough's depth
  for (int n = 0; n < 100; ++n) a = std::max(a, -height_at(sea, 0.1 * n, {250.0, 150.0}));
  for (int n = 0; n < 100; ++n) {
    const double t_s = 0.1 * n;
    const double eta = height_at(sea, t_s, {250.0, 150.0}) + a / 3.0;
    EXPECT_NEAR(velocity_at(sea, t_s, {250.0, 150.0}).x, eta * std::sqrt(kG / 0.5),
                0.01 * a * std::sqrt(kG / 0.5));
  }
}

// A bumpy floor with an island and six trains.
TrainSea bumpy_sea() {
  const terrain::HeightGrid floor =
      terrain::make_sea_floor({{-100.0, 50.0}, 4.0, 90, 70}, [](glm::dvec2 p) {
        return 9.0 + 6.0 * std::sin(0.02 * p.x) * std::cos(0.017 * p.y) -
               15.0 * std::exp(-1e-3 * std::pow(glm::length(p - glm::dvec2(100.0, 200.0)), 2));
      });
  return make_sea(floor, make_trains(make_wind_sea(7.0, 4.0, kG), 6, 11));
}

TEST(TrainVelocity, TheUpwardPartIsTheRateOfTheHeights) {
  const TrainSea sea = bumpy_sea();
  int wrong = 0, moving = 0;
  for (const glm::dvec2& p : random_points_in(2000, {-150.0, 0.0}, {450.0, 350.0})) {
    const double dt_s = 2e-3;
    const double rate = (height_at(sea, 40.0 + dt_s, p) - height_at(sea, 40.0 - dt_s, p)) / 0.004;
    const double up = velocity_at(sea, 40.0, p).z;
    wrong += std::abs(up - rate) > 2e-3;
    moving += std::abs(up) > 0.05;
  }
  EXPECT_GT(moving, 1000);
  EXPECT_LE(wrong, 20);  // a difference may straddle a sharp crest
}

// What rises has come from the sides: d eta / dt = -d q / dx with the flow q = integral of u over
// the depth = u(0) tanh(kh) / k. On a slope linear theory is right to first order: to the
// slope over kh (measured: 0.3 % at 25 m, 4.3 % at 2 m).
TEST(TrainVelocity, NoWaterIsLostOnABeach) {
  const terrain::Grid grid{{0.0, 0.0}, 5.0, 311, 5};
  const terrain::HeightGrid floor =
      terrain::make_plane_beach(grid, {{{1500.0, 0.0}, {1500.0, 1.0}}, 0.02, 100.0});
  const TrainSea sea = make_sea(floor, {{0.01, 8.0, {1.0, 0.0}}});
  const auto flow = [&](double t_s, double x) {
    const double depth_m = 0.02 * (1500.0 - x), k = bisected_wave_number(8.0, depth_m);
    return velocity_at(sea, t_s, {x, 10.0}).x * std::tanh(k * depth_m) / k;
  };
  for (const double depth_m : {25.0, 10.0, 5.0, 2.0}) {
    const double x0 = 1500.0 - 50.0 * depth_m,
                 length_m = kTurn / bisected_wave_number(8.0, depth_m);
    double lost = 0.0, rising = 0.0;
    for (int n = 0; n < 64; ++n) {  // one period
      const double t_s = 8.0 / 64.0 * n, x = x0;
      // Over the grid's step: its phases are linear in between.
      const double step = std::max(0.05 * length_m, 5.0);
      const double out = (flow(t_s, x + step) - flow(t_s, x - step)) / (2.0 * step);
      double up = 0.0;
      for (int i = -10; i <= 10; ++i)
        up += velocity_at(sea, t_s, {x + 0.1 * i * step, 10.0}).z * (std::abs(i) == 10 ? 0.5 : 1.0);
      up /= 20.0;
      lost += (up + out) * (up + out);
      rising += up * up;
    }
    EXPECT_LT(std::sqrt(lost / rising), 0.02 / (kTurn / length_m * depth_m)) << depth_m;
  }
}

TEST(TrainVelocity, IsFiniteOnLandAndFarAway) {
  const TrainSea sea = bumpy_sea();
  for (const glm::dvec2& p : {glm::dvec2(100.0, 200.0), {1e7, -1e7}, {-1e9, 3.0}}) {
    const glm::dvec3 v = velocity_at(sea, 1e9, p);
    EXPECT_LT(glm::length(v), 20.0) << p.x;  // false for NaN
  }
  EXPECT_EQ(velocity_at(sea, 3.0, {100.0, 200.0}), glm::dvec3(0.0));  // the island
}

TEST(TrainVelocity, AnyBatchAndAnyThreadGivesTheSameBits) {
  const TrainSea sea = bumpy_sea();
  const auto points = random_points_in(600, {-150.0, 0.0}, {450.0, 350.0});
  std::vector<glm::vec3> all(points.size());
  sample_train_velocities(sea, 3.5, points, all);
  std::vector<std::vector<glm::vec3>> got(4, std::vector<glm::vec3>(points.size()));
  {
    std::vector<std::jthread> threads;
    for (auto& velocities : got)
      threads.emplace_back([&] { sample_train_velocities(sea, 3.5, points, velocities); });
  }
  for (const auto& velocities : got) EXPECT_EQ(velocities, all);
  for (std::size_t n = 0; n < points.size(); n += 7)
    EXPECT_EQ(glm::vec3(velocity_at(sea, 3.5, points[n])), all[n]);
}

TEST(CoastVelocity, IsTheTrainsVelocityTimesTheirShare) {
  Workers workers(2);
  const terrain::Grid grid{{-600.0, -300.0}, 10.0, 121, 121};
  const terrain::HeightGrid floor =
      terrain::make_plane_beach(grid, {{{-600.0, 0.0}, {600.0, 0.0}}, 0.025, 60.0});
  const CoastSea coast = make_coast_sea(floor, make_wind_sea(9.0, 0.3, kG), 4, 1,
                                        PhaseMethod::kEikonal, true, workers);
  const auto points = random_points_in(1000, {-800.0, -500.0}, {1600.0, 1600.0});
  std::vector<glm::vec3> got(points.size()), trains(points.size());
  std::vector<float> share(points.size());
  sample_coast_velocities(coast, 6.5, points, got);
  sample_train_velocities(coast.trains, 6.5, points, trains);
  sample_coast_share(coast, points, share);
  int some = 0;
  for (std::size_t n = 0; n < points.size(); ++n) {
    ASSERT_EQ(got[n], share[n] == 0.0f ? glm::vec3(0.0f) : share[n] * trains[n]);
    some += share[n] > 0.0f;
  }
  EXPECT_GT(some, 100);
}

}  // namespace
}  // namespace swell::ocean
