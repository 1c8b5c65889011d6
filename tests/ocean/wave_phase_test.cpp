#include "ocean/coast/wave_phase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "constants.h"
#include "ocean/coast/eikonal.h"
#include "ocean/train_sea.h"

namespace swell::ocean {
namespace {

double deep_wave_number(double period_s) { return kTurn * kTurn / (period_s * period_s * kG); }

// 1:50, deepening to the west of the coast at x = 3000: depth 60 m at x = 0.
terrain::HeightGrid west_beach(double spacing_m, double width_m) {
  const terrain::Grid grid{{0.0, 0.0},
                           spacing_m,
                           static_cast<int>(3000.0 / spacing_m) + 11,
                           static_cast<int>(width_m / spacing_m) + 1};
  return terrain::make_plane_beach(grid, {{{3000.0, 0.0}, {3000.0, 1.0}}, 0.02, 1000.0});
}

double angle_deg(glm::dvec2 v) { return std::atan2(v.y, v.x) / kDegree; }

// PHY-10, PHY-12: T = 10 s, 30 degrees in deep water, g = 9.81.
struct BeachRow {
  double depth_m, angle_deg, amplitude;
};
constexpr BeachRow kBeachTable[] = {{50, 28.98127, 0.950584}, {20, 22.84589, 0.889385},
                                    {10, 17.20682, 0.936490}, {5, 12.51778, 1.046234},
                                    {2, 8.04467, 1.266905},   {1, 5.71787, 1.487783}};

TEST(WavePhase, TurnsAndSteepensWavesAsTheTableOfThePlaneBeach) {
  const terrain::HeightGrid floor = west_beach(5.0, 600.0);
  const WaveTrain train{1.0, 10.0, unit(30.0)};
  const WavePhase phase = make_wave_phase(floor, train, PhaseMethod::kEikonal);
  for (const BeachRow& row : kBeachTable) {
    const double x = 3000.0 - 50.0 * row.depth_m;
    for (const double y : {20.0, 300.0, 580.0}) {
      const glm::dvec2 k = wave_vector_at(floor.grid, phase, {x, y});
      EXPECT_NEAR(angle_deg(k), row.angle_deg, 0.05) << "depth " << row.depth_m << ", y " << y;
      const std::size_t n = floor.grid.index(static_cast<int>(x / 5.0), static_cast<int>(y / 5.0));
      EXPECT_NEAR(phase.amplitude[n] / row.amplitude, 1.0, 0.005) << row.depth_m;
    }
  }
}

// PHY-10: k sin(alpha) is what it was in deep water.
TEST(WavePhase, ObeysSnellsLawForEveryPeriodAndAngle) {
  const terrain::HeightGrid floor = west_beach(7.5, 150.0);
  for (const double period_s : {4.0, 6.0, 8.0, 10.0, 12.0}) {
    for (const double angle : {10.0, 20.0, -30.0, 40.0, -50.0, 60.0}) {
      const WaveTrain train{1.0, period_s, unit(angle)};
      const WavePhase phase = make_wave_phase(floor, train, PhaseMethod::kEikonal);
      const double k_along = deep_wave_number(period_s) * std::sin(angle * kDegree);
      for (const double depth_m : {55.0, 30.0, 12.0, 6.0, 3.0, 1.5}) {
        const glm::dvec2 k = wave_vector_at(floor.grid, phase, {3000.0 - 50.0 * depth_m, 75.0});
        EXPECT_NEAR(k.y / k_along, 1.0, 0.01) << period_s << " s, " << angle << ", " << depth_m;
        EXPECT_NEAR(glm::length(k) / bisected_wave_number(period_s, depth_m), 1.0, 0.01);
      }
    }
  }
}

// Along straight lines of travel, what runs along the contours of a plane beach is Snell's, but
// what runs across them is k_x = (k - k_inf sin^2) / cos for sqrt(k^2 - k_inf^2 sin^2): the same to
// first order in k / k_inf - 1, too much by 1 / cos at the shore.
TEST(WavePhase, BendsAlongStraightLinesToFirstOrder) {
  const double period_s = 6.0, angle = 30.0, k_inf = deep_wave_number(period_s);
  const double sin = std::sin(angle * kDegree), cos = std::cos(angle * kDegree);
  // 1:50, 40 m deep in the west; lines that enter there cover y > 1150 at the shore.
  const terrain::HeightGrid floor = terrain::make_plane_beach(
      {{0.0, 0.0}, 10.0, 201, 141}, {{{2000.0, 0.0}, {2000.0, 1.0}}, 0.02, 1000.0});
  const WavePhase phase =
      make_wave_phase(floor, {1.0, period_s, unit(angle)}, PhaseMethod::kStraight);
  struct Found {
    double change, error;  // k / k_inf - 1, and of k_x, relative to k_inf
  };
  const auto found_at = [&](double depth_m) {
    const double k = bisected_wave_number(period_s, depth_m);
    const glm::dvec2 got = wave_vector_at(floor.grid, phase, {2000.0 - 50.0 * depth_m, 1300.0});
    EXPECT_NEAR(got.y / (k_inf * sin), 1.0, 0.002) << depth_m;
    EXPECT_NEAR(got.x / ((k - k_inf * sin * sin) / cos), 1.0, 0.002) << depth_m;
    EXPECT_LT(glm::length(got) / k, 1.0 / cos) << depth_m;
    const double exact = std::sqrt(k * k - k_inf * k_inf * sin * sin);
    return Found{k / k_inf - 1.0, (got.x - exact) / k_inf};
  };
  // The error grows with the square of the change: e^2 sin^2 / (2 cos^3) for little e.
  for (const double depth_m : {10.0, 7.0, 5.0, 3.0, 2.0}) {
    const Found found = found_at(depth_m);
    const double second_order = 0.5 * found.change * found.change * sin * sin / (cos * cos * cos);
    EXPECT_GT(found.error, 0.3 * second_order - 1e-3) << depth_m;
    EXPECT_LT(found.error, second_order + 1e-3) << depth_m;
  }
}

TEST(WavePhase, DoesNotCareHowTheBeachIsTurned) {
  // The beach slopes as above, with its coast at 37 degrees: contours cut every border at an angle.
  const glm::dvec2 uphill = unit(37.0), along(-uphill.y, uphill.x);
  const terrain::Grid grid{{-500.0, -500.0}, 5.0, 201, 201};
  const terrain::HeightGrid floor = terrain::make_sea_floor(
      grid, [&](glm::dvec2 p) { return 0.02 * (1000.0 - glm::dot(p, uphill)); });
  const WaveTrain train{1.0, 8.0, unit(37.0 + 25.0)};
  const WavePhase phase = make_wave_phase(floor, train, PhaseMethod::kEikonal);
  const double k_along = deep_wave_number(8.0) * std::sin(25.0 * kDegree);
  for (const glm::dvec2& p :
       {glm::dvec2(0.0, 0.0), {300.0, 100.0}, {-300.0, 400.0}, {400.0, -400.0}}) {
    const glm::dvec2 k = wave_vector_at(grid, phase, p);
    const double depth_m = 0.02 * (1000.0 - glm::dot(p, uphill));
    EXPECT_NEAR(glm::dot(k, along) / k_along, 1.0, 0.01) << p.x << ", " << p.y;
    EXPECT_NEAR(glm::length(k) / bisected_wave_number(8.0, depth_m), 1.0, 0.002);
  }
}

// PHY-13.
TEST(WavePhase, CarriesItsEnergyToTheShore) {
  // a^2 cg cos(angle) is constant on a plane beach.
  const terrain::HeightGrid floor = west_beach(5.0, 300.0);
  const double period_s = 9.0, omega = kTurn / period_s;
  const WavePhase phase =
      make_wave_phase(floor, {1.0, period_s, unit(40.0)}, PhaseMethod::kEikonal);
  const double k_deep = deep_wave_number(period_s);
  const double expected = 0.5 * omega / k_deep * std::cos(40.0 * kDegree);
  for (const double depth_m : {50.0, 25.0, 10.0, 4.0, 2.0, 1.0}) {
    const double k = bisected_wave_number(period_s, depth_m), kh = k * depth_m;
    const double group = 0.5 * omega / k * (1.0 + 2.0 * kh / std::sinh(2.0 * kh));
    const double cos_angle = std::sqrt(1.0 - std::pow(k_deep * std::sin(40.0 * kDegree) / k, 2));
    const int i = static_cast<int>((3000.0 - 50.0 * depth_m) / 5.0);
    const double a = static_cast<double>(phase.amplitude[floor.grid.index(i, 30)]);
    EXPECT_NEAR(a * a * group * cos_angle / expected, 1.0, 0.01) << depth_m;
  }
}

// The paper's integral in one dimension, by Simpson's rule over pieces of 0.5 m.
double integrated_cycles(double period_s, double from_x, double to_x) {
  const int pieces = static_cast<int>((to_x - from_x) / 0.5);
  const double step = (to_x - from_x) / pieces;
  const auto k = [&](double x) { return bisected_wave_number(period_s, 0.02 * (3000.0 - x)); };
  double sum = 0.0;
  for (int n = 0; n < pieces; ++n) {
    const double x = from_x + n * step;
    sum += k(x) + 4.0 * k(x + 0.5 * step) + k(x + step);
  }
  return sum * step / 6.0 / kTurn;
}

// PHY-13: 10 to 26 wavelengths. The eikonal solver's second-order differences need a finer grid for
// the same error: 6.5e-4 rad at 1 m, 1.5e-2 at 5 m.
TEST(WavePhase, IsTheIntegralOfTheWaveNumber) {
  struct Case {
    PhaseMethod method;
    double spacing_m, bound_rad;
  };
  const std::array<double, 4> places = {1500.0, 2500.0, 2900.0, 2950.0};
  std::array<double, 4> expected{};
  for (std::size_t i = 0; i < 4; ++i)
    expected[i] = i == 0 ? integrated_cycles(10.0, 0.0, places[0])
                         : expected[i - 1] + integrated_cycles(10.0, places[i - 1], places[i]);
  for (const Case& c : {Case{PhaseMethod::kStraight, 5.0, 1e-3},
                        {PhaseMethod::kEikonal, 1.0, 1e-3},
                        {PhaseMethod::kEikonal, 5.0, 2e-2}}) {
    const terrain::HeightGrid floor = west_beach(c.spacing_m, 2.0 * c.spacing_m);
    const WavePhase phase = make_wave_phase(floor, {1.0, 10.0, {1.0, 0.0}}, c.method);
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t n = floor.grid.index(static_cast<int>(places[i] / c.spacing_m), 1);
      EXPECT_LT(kTurn * std::abs(phase.cycles[n] - expected[i]), c.bound_rad)
          << c.spacing_m << " m, at " << places[i];
    }
  }
}

TEST(WavePhase, IsThePlaneWaveInDeepWater) {
  const terrain::Grid grid{{1000.0, -300.0}, 10.0, 60, 40};
  const terrain::HeightGrid floor =
      terrain::make_sea_floor(grid, [](glm::dvec2) { return 2000.0; });
  for (const PhaseMethod method : {PhaseMethod::kStraight, PhaseMethod::kEikonal}) {
    for (const double angle : {0.0, 20.0, 45.0, 90.0, 130.0, 180.0, 250.0, 359.0}) {
      const WaveTrain train{1.0, 7.0, unit(angle), 0.25};
      const WavePhase phase = make_wave_phase(floor, train, method);
      double worst = 0.0;
      for (int j = 0; j < grid.samples_y; ++j) {
        for (int i = 0; i < grid.samples_x; ++i) {
          const std::size_t n = grid.index(i, j);
          const double expected =
              deep_wave_number(7.0) * glm::dot(unit(angle), grid.point(i, j)) / kTurn + 0.25;
          worst = std::max(worst, std::abs(phase.cycles[n] - expected));
          ASSERT_NEAR(phase.amplitude[n], 1.0f, 1e-5f) << angle << " at " << i << ", " << j;
        }
      }
      EXPECT_LT(worst, 1e-9) << angle;
    }
  }
}

TEST(WavePhase, CastsAShadowBehindAnIsland) {
  const terrain::Grid grid{{0.0, 0.0}, 5.0, 201, 121};
  const terrain::HeightGrid floor = terrain::make_sea_floor(grid, [](glm::dvec2 p) {
    return glm::length(p - glm::dvec2(400.0, 300.0)) < 100.0 ? -1.0 : 30.0;
  });
  const WaveTrain train{1.0, 6.0, {1.0, 0.0}};
  const WavePhase phase = make_wave_phase(floor, train, PhaseMethod::kEikonal);
  const auto amplitude = [&](double x, double y) {
    return phase.amplitude[grid.index(static_cast<int>(x / 5.0), static_cast<int>(y / 5.0))];
  };
  EXPECT_EQ(amplitude(400.0, 300.0), 0.0f);           // land
  EXPECT_NEAR(amplitude(200.0, 300.0), 1.0f, 0.02f);  // in front
  EXPECT_NEAR(amplitude(700.0, 520.0), 1.0f, 0.05f);  // beside
  EXPECT_LT(amplitude(550.0, 300.0), 0.35f);          // behind
  // Over a flat floor no rays draw together. Where the waves from both sides meet, energy must not
  // pile up either.
  EXPECT_LT(*std::max_element(phase.amplitude.begin(), phase.amplitude.end()), 1.06f);
  for (double x = 550.0; x < 1000.0; x += 50.0) {
    EXPECT_LT(amplitude(x, 300.0), 1.3f * amplitude(x, 320.0)) << x;
  }
  // Waves creep round: they converge on the line behind the island.
  EXPECT_LT(wave_vector_at(grid, phase, {530.0, 360.0}).y, -0.2 * deep_wave_number(6.0));
  EXPECT_GT(wave_vector_at(grid, phase, {530.0, 240.0}).y, 0.2 * deep_wave_number(6.0));
  // Straight lines know no shadow.
  const WavePhase straight = make_wave_phase(floor, train, PhaseMethod::kStraight);
  EXPECT_GT(straight.amplitude[grid.index(110, 60)], 0.9f);
}

// PHY-13.
TEST(WavePhase, IsSmoothAcrossTheWater) {
  // No jump from cell to cell beyond what the local wave number explains.
  const terrain::HeightGrid floor = west_beach(5.0, 200.0);
  const WaveTrain train{1.0, 8.0, unit(35.0)};
  for (const PhaseMethod method : {PhaseMethod::kStraight, PhaseMethod::kEikonal}) {
    const WavePhase phase = make_wave_phase(floor, train, method);
    for (int j = 0; j < floor.grid.samples_y; ++j) {
      for (int i = 1; i < 596; ++i) {
        const double step =
            phase.cycles[floor.grid.index(i, j)] - phase.cycles[floor.grid.index(i - 1, j)];
        const double k = bisected_wave_number(8.0, 0.02 * (3000.0 - 5.0 * (i - 0.5)));
        ASSERT_GT(step, 0.0);
        ASSERT_LT(step, 1.3 * k * 5.0 / kTurn) << i << ", " << j;
      }
    }
  }
}

TEST(WavePhase, IsFiniteOnEveryFloor) {
  const auto check = [](const terrain::HeightGrid& floor, float expected_amplitude) {
    for (const PhaseMethod method : {PhaseMethod::kStraight, PhaseMethod::kEikonal}) {
      const WavePhase phase = make_wave_phase(floor, {1.0, 5.0, unit(200.0)}, method);
      ASSERT_EQ(phase.cycles.size(), floor.grid.size());
      ASSERT_EQ(phase.amplitude.size(), floor.grid.size());
      for (std::size_t n = 0; n < phase.cycles.size(); ++n) {
        ASSERT_TRUE(std::isfinite(phase.cycles[n]));
        ASSERT_NEAR(phase.amplitude[n], expected_amplitude, 1e-5f);
      }
    }
  };
  const auto flat = [](int nx, int ny, double depth_m) {
    return terrain::make_sea_floor({{0.0, 0.0}, 3.0, nx, ny}, [=](glm::dvec2) { return depth_m; });
  };
  check(flat(9, 7, -2.0), 0.0f);  // all land
  check(flat(9, 7, 0.0), 0.0f);
  check(flat(9, 7, 1e6), 1.0f);  // all deep
  check(flat(1, 1, 500.0), 1.0f);
  check(flat(1, 9, 500.0), 1.0f);
  check(flat(9, 1, 500.0), 1.0f);
}

TEST(WavePhase, RefusesBadTrains) {
  const terrain::HeightGrid floor =
      terrain::make_sea_floor({{0.0, 0.0}, 3.0, 2, 2}, [](glm::dvec2) { return 5.0; });
  const auto make = [&](const WaveTrain& train) {
    return make_wave_phase(floor, train, PhaseMethod::kEikonal);
  };
  EXPECT_NO_THROW(make({1.0, 5.0, {0.0, 1.0}}));
  EXPECT_THROW(make({-1.0, 5.0, {0.0, 1.0}}), std::invalid_argument);
  EXPECT_THROW(make({1.0, 0.0, {0.0, 1.0}}), std::invalid_argument);
  EXPECT_THROW(make({1.0, std::nan(""), {0.0, 1.0}}), std::invalid_argument);
  EXPECT_THROW(make({1.0, 5.0, {0.0, 2.0}}), std::invalid_argument);
  EXPECT_THROW(make({1.0, 5.0, {0.0, 1.0}, kInf}), std::invalid_argument);
  EXPECT_THROW(make({1.0, 5.0, {0.0, 1.0}, 0.0, -9.81}), std::invalid_argument);
  EXPECT_THROW(make_wave_phase({}, {1.0, 5.0, {0.0, 1.0}}, PhaseMethod::kStraight),
               std::invalid_argument);
}

// PHY-13.
TEST(Breaking, KeepsTheHeightBelowItsPartOfTheDepth) {
  EXPECT_EQ(breaking_factor(1.0, 10.0), 1.0);
  EXPECT_DOUBLE_EQ(2.0 * breaking_factor(3.0, 2.0) * 3.0, 0.78 * 2.0);
  EXPECT_EQ(breaking_factor(1.0, 0.0), 0.0);
  EXPECT_EQ(breaking_factor(1.0, -4.0), 0.0);
  EXPECT_EQ(breaking_factor(0.0, 1.0), 1.0);
}

// A wave from one point in still water of slowness 1, behind a wall with a gap at its upper end.
TEST(Eikonal, BendsRoundTheEndOfAWall) {
  const auto worst_error = [](int n) {
    const double h = 1.0 / n;
    EikonalProblem problem{{{0.0, 0.0}, h, 2 * n + 1, 2 * n + 1}, {}, {}, {}};
    problem.slowness.assign(problem.grid.size(), 1.0);
    problem.source.assign(problem.grid.size(), kInf);
    const glm::dvec2 end(1.0, 1.0);  // the wall: x = 1, y <= 1
    for (int j = 0; j <= n; ++j) problem.slowness[problem.grid.index(n, j)] = 0.0;
    // Exact distances around the source keep its own singularity out of the error.
    const glm::dvec2 source(0.5, 0.5);
    for (int j = 0; j <= 2 * n; ++j) {
      for (int i = 0; i <= 2 * n; ++i) {
        const double distance = glm::length(problem.grid.point(i, j) - source);
        if (distance < 0.2) problem.source[problem.grid.index(i, j)] = distance;
      }
    }
    std::vector<double> theta;
    solve_eikonal(problem, theta);
    double worst = 0.0;
    for (int j = 0; j <= 2 * n; ++j) {
      for (int i = 0; i <= 2 * n; ++i) {
        const glm::dvec2 p = problem.grid.point(i, j);
        const bool shadow = p.x > 1.0 && p.y < p.x;
        const double exact =
            shadow ? glm::length(end - source) + glm::length(p - end) : glm::length(p - source);
        const double got = theta[problem.grid.index(i, j)];
        if (problem.slowness[problem.grid.index(i, j)] == 0.0) {
          EXPECT_EQ(got, kInf);
        } else {
          worst = std::max(worst, std::abs(got - exact));
        }
      }
    }
    return worst;
  };
  const double coarse = worst_error(40), fine = worst_error(80);
  EXPECT_LT(coarse, 0.08);         // of paths up to 2.1 long
  EXPECT_LT(fine, 0.65 * coarse);  // the corner is a singular point: first order times log h
}

TEST(Eikonal, IsOfSecondOrderWhereItIsSmooth) {
  // theta = (1 + x)^2 / 2 + y has |grad| = sqrt((1 + x)^2 + 1).
  const auto worst_error = [](int n) {
    EikonalProblem problem{{{0.0, 0.0}, 1.0 / n, n + 1, n + 1}, {}, {}, {}};
    const auto exact = [&](glm::dvec2 p) { return 0.5 * (1.0 + p.x) * (1.0 + p.x) + p.y; };
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        const glm::dvec2 p = problem.grid.point(i, j);
        problem.slowness.push_back(std::sqrt((1.0 + p.x) * (1.0 + p.x) + 1.0));
        problem.source.push_back(i == 0 || j == 0 ? exact(p) : kInf);
      }
    }
    std::vector<double> theta;
    solve_eikonal(problem, theta);
    double worst = 0.0;
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        const double error = theta[problem.grid.index(i, j)] - exact(problem.grid.point(i, j));
        worst = std::max(worst, std::abs(error));
      }
    }
    return worst;
  };
  const double coarse = worst_error(25), fine = worst_error(50);
  EXPECT_LT(coarse, 2e-3);
  EXPECT_LT(fine, 0.3 * coarse);
}

}  // namespace
}  // namespace swell::ocean
