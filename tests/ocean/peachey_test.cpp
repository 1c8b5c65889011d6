#include "ocean/coast/peachey.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <stdexcept>

#include "constants.h"
#include "math/random.h"
#include "ocean/simd_targets.h"
#include "ocean/train_sea.h"

namespace swell::ocean {
namespace {

terrain::HeightGrid flat_floor(double depth_m) {
  return terrain::make_sea_floor({{0.0, 0.0}, 5.0, 201, 21}, [=](glm::dvec2) { return depth_m; });
}

// 1:50, 60 m deep at x = 0, the coast at x = 3000.
terrain::HeightGrid west_beach(double width_m) {
  const terrain::Grid grid{{0.0, 0.0}, 5.0, 611, static_cast<int>(width_m / 5.0) + 1};
  return terrain::make_plane_beach(grid, {{{3000.0, 0.0}, {3000.0, 1.0}}, 0.02, 1000.0});
}

// Where f is largest in [low, high], within 1e-4 of the range.
template <class F>
double find_maximum(double low, double high, F f) {
  for (int round = 0; round < 4; ++round) {
    double best = low, best_value = -kInf;
    const double step = (high - low) / 40.0;
    for (int n = 0; n <= 40; ++n) {
      const double value = f(low + n * step);
      if (value > best_value) best_value = value, best = low + n * step;
    }
    low = best - step;
    high = best + step;
  }
  return 0.5 * (low + high);
}

TEST(TrainSea, IsAPlaneCosineInDeepWater) {
  const terrain::HeightGrid floor = flat_floor(3000.0);
  const WaveTrain train{1.5, 6.0, unit(33.0), 0.4};
  const TrainSea sea = make_sea(floor, {train});
  const double k = std::pow(kTurn / 6.0, 2) / kG;
  for (std::uint64_t n = 0; n < 500; ++n) {
    // Also beyond the floor, where waves run on.
    const glm::dvec2 p(-200.0 + 1400.0 * random_uniform(1, n),
                       -200.0 + 500.0 * random_uniform(2, n));
    const double t_s = 1000.0 * random_uniform(3, n);
    const double phase = k * glm::dot(unit(33.0), p) + kTurn * (0.4 - t_s / 6.0);
    EXPECT_NEAR(height_at(sea, t_s, p), 1.5 * std::cos(phase), 2e-4) << p.x << ", " << p.y;
  }
}

TEST(TrainSea, RunsAtThePhaseSpeedOfItsDepth) {
  struct Row {
    double depth_m, speed_mps;
  };  // T = 10 s
  for (const Row& row : {Row{100, 15.603176}, Row{50, 15.129833}, Row{20, 12.123691},
                         Row{10, 9.237387}, Row{5, 6.768045}, Row{2, 4.369954}}) {
    const TrainSea sea = make_sea(flat_floor(row.depth_m), {{0.01, 10.0, {1.0, 0.0}}});
    const auto crest = [&](double near, double t_s) {
      return find_maximum(near - 20.0, near + 20.0, [&](double x) {
        return height_at(sea, t_s, {x, 50.0});
      });
    };
    // Follow one crest for three seconds.
    const double t0 = find_maximum(0.0, 10.0, [&](double t) {
      return height_at(sea, t, {400.0, 50.0});
    });
    const double from = crest(400.0, t0);
    const double to = crest(from + 3.0 * row.speed_mps, t0 + 3.0);
    EXPECT_NEAR((to - from) / 3.0 / row.speed_mps, 1.0, 0.01) << row.depth_m;
  }
}

// PHY-10.
TEST(TrainSea, SwingsWithItsPeriodAtEveryDepth) {
  const TrainSea sea = make_sea(west_beach(60.0), {{0.01, 9.0, unit(20.0)}});
  for (const double x : {10.0, 1500.0, 2700.0, 2900.0, 2980.0}) {
    // Fourier coefficient of ten periods from t0; it turns with the wave.
    const auto coefficient = [&](double t0) {
      std::complex<double> sum = 0.0;
      for (int n = 0; n < 320; ++n) {
        const double z = height_at(sea, t0 + 9.0 / 32.0 * n, {x, 30.0});
        sum += z * std::polar(1.0, -kTurn * n / 32.0);
      }
      return sum;
    };
    const double turned = std::arg(coefficient(2.25) / coefficient(0.0));
    EXPECT_NEAR(turned / (kTurn / 4.0), 1.0, 1e-3) << x;
    EXPECT_NEAR(height_at(sea, 123.0, {x, 30.0}), height_at(sea, 123.0 + 9000.0, {x, 30.0}), 1e-6);
  }
}

// The angle between the crest that passes (x, 200) and the y axis, in degrees; `near_deg` tells
// where to look for it 20 m aside.
double crest_angle_deg(const TrainSea& sea, double period_s, double x, double near_deg) {
  const double t_s = find_maximum(0.0, period_s, [&](double t) {
    return height_at(sea, t, {x, 200.0});
  });
  const auto crest = [&](double y) {
    const double near = x - (y - 200.0) * std::tan(near_deg * kDegree);
    return find_maximum(near - 8.0, near + 8.0, [&](double at) {
      return height_at(sea, t_s, {at, y});
    });
  };
  return std::atan((crest(180.0) - crest(220.0)) / 40.0) / kDegree;
}

// PHY-10.
TEST(TrainSea, ShowsCrestsInTheDirectionOfTheTable) {
  const TrainSea sea = make_sea(west_beach(400.0), {{0.01, 10.0, unit(30.0)}});
  struct Row {
    double depth_m, angle_deg;
  };
  for (const Row& row : {Row{50, 28.98127}, Row{20, 22.84589}, Row{10, 17.20682}, Row{5, 12.51778},
                         Row{2, 8.04467}, Row{1, 5.71787}}) {
    const double angle = crest_angle_deg(sea, 10.0, 3000.0 - 50.0 * row.depth_m, row.angle_deg);
    EXPECT_NEAR(angle, row.angle_deg, 0.5) << row.depth_m;
  }
}

// PHY-10 for other waves: sin(angle) = sin(angle in deep water) k_inf / k.
TEST(TrainSea, ShowsCrestsInTheDirectionOfSnellsLaw) {
  struct Wave {
    double period_s, angle_deg;
  };
  for (const Wave& wave : {Wave{6.0, 60.0}, {8.0, -45.0}, {12.0, 10.0}}) {
    const TrainSea sea = make_sea(west_beach(400.0), {{0.01, wave.period_s, unit(wave.angle_deg)}});
    const double k_inf = std::pow(kTurn / wave.period_s, 2) / kG;
    for (const double depth_m : {20.0, 6.0, 2.0}) {
      double k = k_inf;  // k tanh(kh) = k_inf, by halved steps
      for (int n = 0; n < 200; ++n) k = 0.5 * (k + k_inf / std::tanh(k * depth_m));
      const double expected = std::asin(std::sin(wave.angle_deg * kDegree) * k_inf / k) / kDegree;
      const double got = crest_angle_deg(sea, wave.period_s, 3000.0 - 50.0 * depth_m, expected);
      EXPECT_NEAR(got, expected, 0.5) << wave.period_s << " s, " << depth_m << " m";
    }
  }
}

// PHY-12: H ~ h^(-1/4) where kh < 0.2, measured on the surface: from crest to trough.
TEST(TrainSea, GrowsByGreensLawTowardsTheShore) {
  const terrain::Grid grid{{0.0, 0.0}, 1.0, 3001, 2};
  const terrain::HeightGrid floor =
      terrain::make_plane_beach(grid, {{{3000.0, 0.0}, {3000.0, 1.0}}, 0.02, 1000.0});
  const TrainSea sea = make_sea(floor, {{1e-3, 12.0, {1.0, 0.0}}});
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (double depth_m = 0.1; depth_m < 1.4; depth_m += 0.1) {  // kh 0.05 to 0.2
    double low = 1.0, high = -1.0;
    for (int t = 0; t < 240; ++t) {
      const double z = height_at(sea, 0.05 * t, {3000.0 - 50.0 * depth_m, 0.5});
      low = std::min(low, z), high = std::max(high, z);
    }
    const double log_depth = std::log(depth_m), log_height = std::log(high - low);
    n += 1.0, x += log_depth, y += log_height;
    xx += log_depth * log_depth, xy += log_depth * log_height;
  }
  EXPECT_NEAR((n * xy - x * y) / (n * xx - x * x), -0.25, 0.005);
}

// PHY-13.
TEST(TrainSea, NeverStandsHigherThanTheDepthAllows) {
  const terrain::HeightGrid floor = west_beach(60.0);
  const TrainSea sea = make_sea(floor, {{1.0, 10.0, unit(10.0)}, {0.7, 7.0, unit(-20.0), 0.3}});
  float highest = 0.0f;
  for (int i = 0; i < 611; ++i) {
    const double depth_m = 0.02 * (3000.0 - 5.0 * i);
    for (int n = 0; n < 40; ++n) {
      const auto z = static_cast<float>(height_at(sea, 0.37 * n, {5.0 * i, 30.0}));
      highest = std::max(highest, std::abs(z));
      ASSERT_LE(std::abs(z), 0.39 * std::max(depth_m, 0.0) * (1.0 + 1e-5)) << i;
    }
  }
  EXPECT_LE(highest, sea.height_bound_m);
  EXPECT_GT(highest, 0.8f * sea.height_bound_m);
}

// A bumpy floor with an island and six trains.
terrain::HeightGrid bumpy_floor() {
  return terrain::make_sea_floor({{-100.0, 50.0}, 4.0, 90, 70}, [](glm::dvec2 p) {
    return 9.0 + 6.0 * std::sin(0.02 * p.x) * std::cos(0.017 * p.y) -
           15.0 * std::exp(-1e-3 * std::pow(glm::length(p - glm::dvec2(100.0, 200.0)), 2));
  });
}

std::vector<WaveTrain> six_trains() { return make_trains(make_wind_sea(7.0, 4.0, kG), 6, 11); }

// The bound holds at every place and time, and is not far from what there is.
TEST(TrainSea, IsNoSteeperThanItsBound) {
  for (const bool is_beach : {false, true}) {
    const terrain::HeightGrid floor = is_beach ? west_beach(60.0) : bumpy_floor();
    const TrainSea sea = make_sea(floor, six_trains());
    const terrain::Grid& grid = floor.grid;
    const glm::dvec2 size = grid.spacing_m * glm::dvec2(grid.samples_x - 1, grid.samples_y - 1);
    std::vector<glm::dvec2> p(20000);
    std::vector<float> z(p.size()), slope_x(p.size()), slope_y(p.size());
    float steepest = 0.0f;
    for (std::uint64_t n = 0; n < 20; ++n) {
      for (std::size_t i = 0; i < p.size(); ++i)
        p[i] = grid.min_world +
               size * glm::dvec2(random_uniform(n, 2 * i), random_uniform(n, 2 * i + 1));
      sample_trains(sea, 3.7 * static_cast<double>(n), p, z, slope_x, slope_y);
      for (std::size_t i = 0; i < p.size(); ++i)
        steepest = std::max(steepest, std::hypot(slope_x[i], slope_y[i]));
    }
    EXPECT_LE(steepest, sea.slope_bound) << is_beach;
    EXPECT_GT(steepest, 0.15f * sea.slope_bound) << is_beach;  // crests seldom meet
  }
}

// The sum of the trains as the header words it, in double, from the same phases.
class Reference {
 public:
  Reference(const terrain::HeightGrid& floor, const std::vector<WaveTrain>& trains)
      : floor_(floor), trains_(trains) {
    for (const WaveTrain& train : trains) {
      phases_.push_back(make_wave_phase(floor, train, PhaseMethod::kEikonal));
    }
  }

  double height(double t_s, glm::dvec2 p) const {
    const terrain::Grid& grid = floor_.grid;
    const glm::dvec2 u = (p - grid.min_world) / grid.spacing_m;
    const int i = static_cast<int>(u.x), j = static_cast<int>(u.y);
    const double fx = u.x - i, fy = u.y - j;
    const auto bilinear = [&](auto value) {
      return (1 - fx) * (1 - fy) * value(grid.index(i, j)) +
             fx * (1 - fy) * value(grid.index(i + 1, j)) +
             (1 - fx) * fy * value(grid.index(i, j + 1)) +
             fx * fy * value(grid.index(i + 1, j + 1));
    };
    const double h = bilinear([&](std::size_t n) { return depth_of_sample(floor_, n); });
    double z = 0.0;
    for (std::size_t t = 0; t < trains_.size(); ++t) {
      const double theta = bilinear([&](std::size_t n) { return phases_[t].cycles[n]; });
      const double a = bilinear([&](std::size_t n) { return amplitude(t, n); });
      z += a * profile(theta - t_s / trains_[t].period_s, h, trains_[t].period_s);
    }
    return z;
  }

 private:
  double amplitude(std::size_t t, std::size_t n) const {
    double sum = 0.0;
    for (std::size_t s = 0; s < trains_.size(); ++s) {
      sum += trains_[s].amplitude_m * double{phases_[s].amplitude[n]};
    }
    const double most = std::max(0.39 * depth_of_sample(floor_, n), 0.0);
    const double a = trains_[t].amplitude_m * double{phases_[t].amplitude[n]};
    return sum > most ? a * most / sum : a;
  }

  static double profile(double cycles, double depth_m, double period_s) {
    const double u = cycles - std::floor(cycles);
    const double length = kG * period_s * period_s / kTurn;
    const double deep = 0.25 * std::tanh(0.5 * kPiRef) * length;
    const double shallow = 0.05 * std::tanh(0.1 * kPiRef) * length;
    const double x = std::clamp((deep - depth_m) / (deep - shallow), 0.0, 1.0);
    const double b = x * x * (3 - 2 * x);
    return (1 - b) * std::cos(kTurn * u) + b * (8 * (u - 0.5) * (u - 0.5) - 1);
  }

  const terrain::HeightGrid& floor_;
  const std::vector<WaveTrain>& trains_;
  std::vector<WavePhase> phases_;
};

std::vector<glm::dvec2> random_points(int count) {
  std::vector<glm::dvec2> points;
  for (int n = 0; n < count; ++n) {
    const auto c = static_cast<std::uint64_t>(n);
    points.emplace_back(-100.0 + 355.0 * random_uniform(5, c), 50.0 + 275.0 * random_uniform(6, c));
  }
  return points;
}

struct Samples {
  std::vector<float> z, dx, dy;
  bool operator==(const Samples&) const = default;
};

Samples sample(const TrainSea& sea, double t_s, const std::vector<glm::dvec2>& points) {
  Samples s{std::vector<float>(points.size()), std::vector<float>(points.size()),
            std::vector<float>(points.size())};
  sample_trains(sea, t_s, points, s.z, s.dx, s.dy);
  return s;
}

TEST(TrainSea, IsTheSumOfItsTrains) {
  const terrain::HeightGrid floor = bumpy_floor();
  const std::vector<WaveTrain> trains = six_trains();
  const Reference reference(floor, trains);
  const TrainSea sea = make_sea(floor, trains);
  const std::vector<glm::dvec2> points = random_points(2000);
  for_each_simd_target([&] {
    const Samples s = sample(sea, 77.7, points);
    for (std::size_t n = 0; n < points.size(); ++n) {
      ASSERT_NEAR(s.z[n], reference.height(77.7, points[n]), 2e-5)
          << points[n].x << ", " << points[n].y;
    }
  });
}

TEST(TrainSea, HasTheSlopesOfItsHeights) {
  const terrain::HeightGrid floor = bumpy_floor();
  const std::vector<WaveTrain> trains = six_trains();
  const Reference reference(floor, trains);
  std::vector<glm::dvec2> points;
  for (const glm::dvec2& p : random_points(2000)) {  // not at a cell's border
    const glm::dvec2 u = glm::fract((p - floor.grid.min_world) / floor.grid.spacing_m);
    if (std::min(u.x, u.y) > 0.01 && std::max(u.x, u.y) < 0.99) points.push_back(p);
  }
  const Samples s = sample(make_sea(floor, trains), 5.0, points);
  int wrong = 0;
  for (std::size_t n = 0; n < points.size(); ++n) {
    const glm::dvec2 x(1e-5, 0.0), y(0.0, 1e-5);
    const auto height = [&](glm::dvec2 p) { return reference.height(5.0, p); };
    const double dx = (height(points[n] + x) - height(points[n] - x)) / 2e-5;
    const double dy = (height(points[n] + y) - height(points[n] - y)) / 2e-5;
    wrong += std::abs(s.dx[n] - dx) > 2e-4 || std::abs(s.dy[n] - dy) > 2e-4;
  }
  EXPECT_LE(wrong, 1);  // a difference may straddle a sharp crest
}

TEST(TrainSea, HasTheSameBitsOnEveryTargetAndForAnyBatch) {
  const TrainSea sea = make_sea(bumpy_floor(), six_trains());
  std::vector<glm::dvec2> points = random_points(301);
  points.emplace_back(-1000.0, 3000.0);  // beyond the floor
  points.emplace_back(1e7, -1e7);
  const Samples all = sample(sea, 3.25, points);
  for_each_simd_target([&] {
    EXPECT_EQ(sample(sea, 3.25, points), all);
    std::vector<float> heights(points.size());
    sample_trains(sea, 3.25, points, heights);
    EXPECT_EQ(heights, all.z);
    for (std::size_t n = 0; n < points.size(); n += 17) {
      EXPECT_EQ(static_cast<float>(height_at(sea, 3.25, points[n])), all.z[n]);
    }
  });
}

TEST(TrainSea, IsTheSameForAnyThreadCount) {
  Workers one(1), four(4);
  const TrainSea a = make_train_sea(bumpy_floor(), six_trains(), PhaseMethod::kEikonal, one);
  const TrainSea b = make_train_sea(bumpy_floor(), six_trains(), PhaseMethod::kEikonal, four);
  EXPECT_EQ(a.waves, b.waves);
  EXPECT_EQ(a.depth, b.depth);
}

// PHY-13.
TEST(TrainSea, HasNoStepsBetweenCells) {
  const TrainSea sea = make_sea(bumpy_floor(), six_trains());
  for (int i = 1; i < 89; ++i) {
    for (int j = 1; j < 69; ++j) {
      const glm::dvec2 border(-100.0 + 4.0 * i, 50.0 + 4.0 * j);
      const double a = height_at(sea, 9.0, border - glm::dvec2(1e-6, 1.3));
      const double b = height_at(sea, 9.0, border + glm::dvec2(1e-6, -1.3));
      ASSERT_NEAR(a, b, 2e-5) << i << ", " << j;
    }
  }
}

TEST(TrainSea, IsFlatWithoutWavesOrWater) {
  const auto expect_flat = [](const TrainSea& sea) {
    const Samples s = sample(sea, 4.0, random_points(40));
    for (std::size_t n = 0; n < s.z.size(); ++n) {
      EXPECT_EQ(s.z[n], 0.0f);
      EXPECT_EQ(s.dx[n], 0.0f);
      EXPECT_EQ(s.dy[n], 0.0f);
    }
    EXPECT_EQ(sea.height_bound_m, 0.0f);
  };
  expect_flat(make_sea(bumpy_floor(), {}));
  expect_flat(make_sea(flat_floor(-3.0), six_trains()));
  expect_flat(make_sea(bumpy_floor(), make_trains(make_wind_sea(0.0, 0.0, kG), 4, 1)));
}

TEST(TrainSea, WorksOnAFloorOfOneSample) {
  const terrain::HeightGrid floor =
      terrain::make_sea_floor({{0.0, 0.0}, 5.0, 1, 1}, [](glm::dvec2) { return 900.0; });
  const TrainSea sea = make_sea(floor, {{1.0, 5.0, {1.0, 0.0}}});
  EXPECT_NEAR(height_at(sea, 0.0, {0.0, 0.0}), 1.0, 1e-5);
  EXPECT_NEAR(height_at(sea, 2.5, {70.0, -30.0}), -1.0, 1e-5);
}

TEST(TrainSea, RefusesWhatItCannotHold) {
  EXPECT_THROW(make_sea(bumpy_floor(), std::vector<WaveTrain>(17)), std::invalid_argument);
  EXPECT_THROW(make_sea(bumpy_floor(), {{1.0, -5.0, {1.0, 0.0}}}), std::invalid_argument);
  EXPECT_THROW(make_sea({}, {}), std::invalid_argument);
}

TEST(ProfileBlend, GoesFromAQuarterToATwentiethOfTheWavelength) {
  // T = 10 s: L = 4 h where k h = pi / 2, L = 20 h where k h = pi / 10.
  const double length = kG * 100.0 / kTurn;
  const double deep = length * 0.25 * std::tanh(0.5 * kPiRef);
  const double shallow = length * 0.05 * std::tanh(0.1 * kPiRef);
  const ProfileDepths depths = profile_depths(length);
  EXPECT_NEAR(depths.deep_m, deep, 1e-12 * deep);
  EXPECT_NEAR(depths.shallow_m, shallow, 1e-12 * shallow);
  EXPECT_EQ(shore_part(1.001 * deep, deep, shallow), 0.0);
  EXPECT_EQ(shore_part(0.999 * shallow, deep, shallow), 1.0);
  EXPECT_NEAR(shore_part(0.5 * (deep + shallow), deep, shallow), 0.5, 1e-12);
  EXPECT_NEAR(shore_part(0.75 * deep + 0.25 * shallow, deep, shallow), 5.0 / 32.0, 1e-12);
}

}  // namespace
}  // namespace swell::ocean
