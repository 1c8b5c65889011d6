#include "ocean/wakes/wakes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "allocation_count.h"
#include "math/elementary.h"

namespace swell::ocean {
namespace {

constexpr double kGravity = 9.81;

Disturbance drop(glm::dvec2 position_m, double t_s, double radius_m, double height_m) {
  Disturbance d;
  d.position_m = position_m;
  d.t_s = t_s;
  d.radius_m = radius_m;
  d.height_m = height_m;
  return d;
}

// A hull of this Froude number that goes east and is at the origin at arrival_s().
Disturbance hull(double froude) {
  Disturbance d;
  d.kind = DisturbanceKind::kHull;
  d.path_m = {{-2000.0, 0.0}, {2000.0, 0.0}};
  d.path_closed = false;
  d.hull_m = {2.9, 9.2, 0.5};
  d.speed_mps = froude * std::sqrt(kGravity * d.hull_m.y);
  return d;
}
double arrival_s(const Disturbance& d) { return 2000.0 / d.speed_mps; }
double transverse_m(const Disturbance& d) {
  return 2.0 * kPi * d.speed_mps * d.speed_mps / kGravity;
}

WakeFrame frame_at(std::span<const Disturbance> list, double t_s, int threads = 1) {
  Workers workers(threads);
  WakeFrame frame;
  advance_wakes(list, {}, kGravity, t_s, frame, workers);
  return frame;
}

float height(const WakeFrame& frame, glm::dvec2 p) {
  float z = 0.0f;
  add_wake_heights(frame, {&p, 1}, {&z, 1});
  return z;
}

bool same_bits(const WakeFrame& a, const WakeFrame& b) {
  return std::ranges::equal(a.shown(), b.shown(), [](const WakeWindow& v, const WakeWindow& w) {
    return v.corner_m == w.corner_m && v.height_m == w.height_m && v.slope_x == w.slope_x &&
           v.slope_y == w.slope_y && v.foam == w.foam;
  });
}

// A list of everything.
std::vector<Disturbance> mixture() {
  Disturbance step = drop({3.0, 4.0}, 1.5, 0.15, 0.05), rotor = drop({-60.0, 9.0}, 0.0, 3.0, 0.1);
  step.kind = DisturbanceKind::kFootstep;
  rotor.kind = DisturbanceKind::kRotor;
  Disturbance round = hull(0.3);
  round.path_m = {{0.0, 0.0}, {30.0, 5.0}, {20.0, 40.0}};
  round.path_closed = true;
  return {drop({1.0, 2.0}, 1.0, 0.3, 0.1),  step, hull(0.25), rotor, round,
          drop({2.0, 1.0}, 1.0, 0.25, -0.1)};
}

// Rows of radius / b, t / sqrt(b / g) and the height over that of the drop:
// 1/2 integral of k e^(-k^2/4) J0(k r) cos(sqrt(k) t) dk, worked out apart.
TEST(Wakes, DropRunsApartAsTheIntegralSays) {
  struct Row {
    double r, t, height;
  };
  const glm::dvec2 middle(3.0, -2.5);
  for (const Row row :
       {Row{0, 0, 1}, Row{1, 0, .367879}, Row{0, 1, .266434}, Row{0, 2, -.647363},
        Row{0, 4, .156316}, Row{2, 2, .118925}, Row{5, 5, .019991}, Row{10, 10, -.012792},
        Row{10, 20, -.042339}, Row{20, 20, .002062}, Row{20, 40, .009796}}) {
    const Disturbance d = drop(middle, 7.0, 1.0, 0.5);
    const WakeFrame frame = frame_at({&d, 1}, 7.0 + row.t / std::sqrt(kGravity));
    const double z = static_cast<double>(height(frame, middle + glm::dvec2(0.6, 0.8) * row.r));
    const bool is_far = row.t > 4.0;
    EXPECT_NEAR(z / 0.5, row.height, is_far ? 0.001 + 0.1 * std::abs(row.height) : 0.03)
        << row.r << " " << row.t;
  }
}

TEST(Wakes, RingsLieWhereTheirGroupVelocityTakesThem) {
  // At r after t are the waves with omega / 2 k = r / t, whose phase there is g t^2 / 4 r.
  const Disturbance d = drop({0.0, 0.0}, 0.0, 0.3, 0.3);
  const double t_s = 6.0;
  const WakeFrame frame = frame_at({&d, 1}, t_s);
  std::vector<double> phase;  // where the surface passes its level
  for (double r = 4.0; r < 10.0; r += 0.005)
    if ((height(frame, {r, 0.0}) < 0.0f) != (height(frame, {r + 0.005, 0.0}) < 0.0f))
      phase.push_back(kGravity * t_s * t_s / (4.0 * (r + 0.0025)));
  ASSERT_GE(phase.size(), 4u);
  for (std::size_t i = 1; i < phase.size(); ++i)
    EXPECT_NEAR((phase[i - 1] - phase[i]) / kPi, 1.0, 0.06) << phase[i];
}

TEST(Wakes, NothingIsThereBeforeItHappens) {
  const Disturbance d = drop({0.0, 0.0}, 5.0, 0.5, 0.3);
  EXPECT_EQ(frame_at({&d, 1}, 4.999).count, 0u);
  EXPECT_EQ(frame_at({&d, 1}, 5.0).count, 1u);
  Disturbance starting = hull(0.3);
  EXPECT_EQ(frame_at({&starting, 1}, -1.0).count, 0u);
}

// The outermost crest's place across the track, `behind_m` behind the hull: the first maximum from
// outside of how far the surface goes up and down along a ray.
double crest_beside_m(const WakeFrame& frame, double behind_m, double wave_m) {
  std::vector<double> beside, range;
  for (double y = 0.5 * behind_m; y > 0.25 * behind_m; y -= 0.01 * wave_m) {
    float low = 1.0f, high = -1.0f;
    for (double x = behind_m - 0.41 * wave_m; x <= behind_m + 0.41 * wave_m; x += wave_m / 60.0) {
      const float z = height(frame, {-x, y * x / behind_m});
      low = std::min(low, z), high = std::max(high, z);
    }
    beside.push_back(y);
    range.push_back(static_cast<double>(high - low));
  }
  const double most = *std::ranges::max_element(range);
  std::size_t i = 1;
  while (i + 1 < range.size() && (range[i] < 0.6 * most || range[i] < range[i + 1])) ++i;
  return beside[i];
}

// Source: Lord Kelvin, On Ship Waves, 1887: asin(1/3) = 19.47 degrees to either side.
TEST(Wakes, CrestsOfAHullSpreadByKelvinsAngle) {
  for (const double froude : {0.25, 0.30, 0.38}) {
    const Disturbance d = hull(froude);
    const WakeFrame frame = frame_at({&d, 1}, arrival_s(d));
    const double wave_m = transverse_m(d);
    double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (double behind = 2.0 * wave_m; behind < 0.5 * frame.windows[0].length_m;
         behind += 0.1 * wave_m) {
      const double beside = crest_beside_m(frame, behind, wave_m);
      n += 1.0, x += behind, y += beside, xx += behind * behind, xy += behind * beside;
    }
    const double slope = (n * xy - x * y) / (n * xx - x * x);
    EXPECT_NEAR(std::atan(slope) * 180.0 / kPi, 19.47, 1.0) << froude;
  }
}

TEST(Wakes, TransverseWavesKeepUpWithTheHull) {
  for (const double froude : {0.25, 0.30, 0.40}) {
    const Disturbance d = hull(froude);
    const WakeFrame frame = frame_at({&d, 1}, arrival_s(d));
    const double wave_m = transverse_m(d);
    double first = 0.0, last = 0.0;
    int waves = -1;
    for (double x = 2.0 * wave_m; x < 0.45 * frame.windows[0].length_m; x += 0.005 * wave_m) {
      if (height(frame, {-x, 0.0}) >= 0.0f || height(frame, {-x - 0.005 * wave_m, 0.0}) < 0.0f)
        continue;
      last = x;
      if (++waves == 0) first = x;
    }
    ASSERT_GE(waves, 1) << froude;
    EXPECT_NEAR((last - first) / waves / wave_m, 1.0, 0.03) << froude;
  }
}

TEST(Wakes, ShallowWaterMakesTransverseWavesLonger) {
  Disturbance d = hull(0.30);
  d.depth_m = 1.5;
  const WakeFrame frame = frame_at({&d, 1}, arrival_s(d));
  // U^2 = g / k tanh(k d).
  double k = kGravity / (d.speed_mps * d.speed_mps);
  for (int i = 0; i < 200; ++i)
    k = kGravity / (d.speed_mps * d.speed_mps) * std::tanh(k * d.depth_m);
  const double wave_m = 2.0 * kPi / k;
  ASSERT_GT(wave_m, 1.05 * transverse_m(d));
  double first = 0.0, last = 0.0;
  int waves = -1;
  for (double x = 2.0 * wave_m; x < 0.45 * frame.windows[0].length_m; x += 0.01) {
    if (height(frame, {-x, 0.0}) >= 0.0f || height(frame, {-x - 0.01, 0.0}) < 0.0f) continue;
    last = x;
    if (++waves == 0) first = x;
  }
  ASSERT_GE(waves, 1);
  EXPECT_NEAR((last - first) / waves / wave_m, 1.0, 0.03);
}

TEST(Wakes, NothingRunsAheadOfAHull) {
  const Disturbance d = hull(0.35);
  const WakeFrame frame = frame_at({&d, 1}, arrival_s(d));
  float behind = 0.0f, ahead = 0.0f;
  for (double x = 0.0; x < 20.0; x += 0.1) {
    behind = std::max(behind, std::abs(height(frame, {-10.0 - x, 0.0})));
    ahead = std::max(ahead, std::abs(height(frame, {10.0 + x, 0.0})));
  }
  EXPECT_LT(ahead, 0.15f * behind);
}

TEST(Wakes, SlopesAreThoseOfTheHeights) {
  const Disturbance d = hull(0.30);
  const WakeFrame frame = frame_at({&d, 1}, arrival_s(d));
  double squares = 0.0, off = 0.0;
  for (double x = -30.0; x < -8.0; x += 0.37) {
    const glm::dvec2 p(x, 0.3 * x);
    glm::vec2 slope(0.0f);
    add_wake_slopes(frame, {&p, 1}, {&slope, 1});
    const double step = 0.35;
    const auto z = [&](double dx, double dy) {
      return static_cast<double>(height(frame, p + glm::dvec2(dx, dy)));
    };
    const double by_x = (z(step, 0.0) - z(-step, 0.0)) / (2.0 * step);
    const double by_y = (z(0.0, step) - z(0.0, -step)) / (2.0 * step);
    squares += by_x * by_x + by_y * by_y;
    off += std::pow(by_x - static_cast<double>(slope.x), 2.0) +
           std::pow(by_y - static_cast<double>(slope.y), 2.0);
  }
  EXPECT_LT(std::sqrt(off / squares), 0.15);
}

TEST(Wakes, VelocityIsTheRateOfTheHeight) {
  const Disturbance list[] = {hull(0.30),
                              drop({-18.0, 9.0}, arrival_s(hull(0.30)) - 2.0, 0.5, 0.2)};
  const double t_s = arrival_s(list[0]), step_s = 0.01;
  Workers workers(1);
  const WakeFrame before = frame_at(list, t_s - step_s), now = frame_at(list, t_s),
                  after = frame_at(list, t_s + step_s);
  WakeFrame rise;
  advance_wake_velocity(now, WakeField::kRise, rise, workers);
  double squares = 0.0, off = 0.0;
  for (double x = -30.0; x < -8.0; x += 0.5)
    for (double y = 2.0; y < 12.0; y += 0.5) {
      const double by_height =
          static_cast<double>(height(after, {x, y}) - height(before, {x, y})) / (2.0 * step_s);
      const double velocity = static_cast<double>(height(rise, {x, y}));
      squares += by_height * by_height;
      off += (velocity - by_height) * (velocity - by_height);
    }
  EXPECT_LT(std::sqrt(off / squares), 0.05);
}

// Not where the window moves on, nor where waves from before a turn leave it.
TEST(Wakes, NothingJumpsAsAHullGoesOn) {
  Disturbance d = hull(0.30);
  d.path_m = {{60.0, -110.0}, {160.0, 20.0}, {60.0, 30.0}, {40.0, -60.0}};
  d.path_closed = true;
  constexpr int kFrames = 60;
  std::vector<glm::dvec2> points;
  for (double x = 100.0; x < 160.0; x += 3.0)
    for (double y = -60.0; y < 20.0; y += 3.0) points.push_back({x, y});
  std::vector<std::vector<float>> z(kFrames, std::vector<float>(points.size()));
  Workers workers(2);
  WakeFrame frame;
  for (int n = 0; n < kFrames; ++n) {
    advance_wakes({&d, 1}, {}, kGravity, 45.0 + n / 60.0, frame, workers);
    add_wake_heights(frame, points, z[n]);
  }
  float most = 0.0f, jump = 0.0f;
  for (std::size_t n = 3; n < kFrames; ++n)
    for (std::size_t i = 0; i < points.size(); ++i) {
      most = std::max(most, std::abs(z[n][i]));
      jump = std::max(jump, std::abs(z[n][i] - 3.0f * (z[n - 1][i] - z[n - 2][i]) - z[n - 3][i]));
    }
  EXPECT_GT(most, 0.1f);
  EXPECT_LT(jump, 0.008f * most);
}

// A wall of land, 8 m thick, from (-102, 2) to (102, 10).
terrain::ShoreMap wall_of_land(Workers& workers) {
  constexpr int kSide = 257;
  terrain::HeightGrid land{{{-128.0, -128.0}, 1.0, kSide, kSide}, {}};
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) {
      const glm::dvec2 p = land.grid.point(i, j);
      const bool is_wall = std::abs(p.x) < 101.9 && std::abs(p.y - 6.0) < 3.9;
      land.height_m.push_back(is_wall ? 3.0f : -3.0f);
    }
  return terrain::ShoreMap(land, workers);
}

TEST(Wakes, DoNotRunOverLand) {
  Workers workers(2);
  const terrain::ShoreMap shore = wall_of_land(workers);
  const double t_s = arrival_s(hull(0.30));
  const std::vector<Disturbance> now = {hull(0.30), drop({-30.0, -8.0}, t_s - 9.0, 0.5, 0.3)};
  WakeFrame walled;
  advance_wakes(now, {}, kGravity, t_s, walled, workers, &shore);
  const WakeFrame open = frame_at(now, t_s);
  float stopped = 0.0f, kept = 0.0f;
  for (double x = -45.0; x < -5.0; x += 1.0) {
    for (double y = 13.0; y < 20.0; y += 1.0) {
      EXPECT_EQ(height(walled, {x, y}), 0.0f) << x << " " << y;
      stopped = std::max(stopped, std::abs(height(open, {x, y})));
    }
    for (double y = -30.0; y < -1.0; y += 1.0) {
      EXPECT_EQ(height(walled, {x, y}), height(open, {x, y})) << x << " " << y;
      kept = std::max(kept, std::abs(height(open, {x, y})));
    }
  }
  EXPECT_GT(stopped, 0.005f);
  EXPECT_GT(kept, 0.05f);
}

// On inland water, which lies above the sea, land says nothing.
TEST(Wakes, OfInlandWaterAreAsWithoutLand) {
  Workers workers(1);
  const terrain::ShoreMap shore = wall_of_land(workers);
  const std::vector<Disturbance> list = {drop({0.0, 6.0}, 0.0, 0.5, 0.3)};
  WakeFrame inland;
  advance_wakes(list, {}, kGravity, 4.0, inland, workers, &shore);
  EXPECT_TRUE(same_bits(inland, frame_at(list, 4.0)));
}

TEST(Wakes, OrderOfTheListDoesNotMatter) {
  std::vector<Disturbance> list = mixture();
  const WakeFrame frame = frame_at(list, 9.0);
  ASSERT_GE(frame.count, 4u);
  std::ranges::reverse(list);
  EXPECT_TRUE(same_bits(frame, frame_at(list, 9.0)));
  Workers workers(1);
  WakeFrame split;
  advance_wakes(std::span(list).first(2), std::span(list).subspan(2), kGravity, 9.0, split,
                workers);
  EXPECT_TRUE(same_bits(frame, split));
}

TEST(Wakes, AFrameAloneIsTheFrameInASequenceWithAnyThreads) {
  const std::vector<Disturbance> list = mixture();
  Workers workers(3);
  WakeFrame sequence;
  for (int frame = 250; frame <= 300; ++frame)
    advance_wakes(list, {}, kGravity, 0.03 * frame, sequence, workers);
  EXPECT_TRUE(same_bits(sequence, frame_at(list, 0.03 * 300)));
}

TEST(Wakes, FramesAllocateNothing) {
  const std::vector<Disturbance> list = mixture();
  Workers workers(1);
  WakeFrame frame;
  advance_wakes(list, {}, kGravity, 9.0, frame, workers);
  advance_wakes(list, {}, kGravity, 9.5, frame, workers);
  const auto before = allocation_count();
  advance_wakes(list, {}, kGravity, 9.0, frame, workers);
  EXPECT_EQ(allocation_count(), before);
}

TEST(Wakes, TooManyAreLeftOutAndNoneCrash) {
  std::vector<Disturbance> many;
  for (int i = 0; i < 100; ++i) {
    Disturbance d = hull(0.2 + 0.001 * i);
    d.path_m[0].y = d.path_m[1].y = 100.0 * i;
    many.push_back(d);
    many.push_back(drop({50.0 * i, 0.0}, 0.0, 0.3, 0.1));
  }
  EXPECT_EQ(frame_at(many, 1.0).count, kMostWakeWindows);
}

TEST(Wakes, FoamLiesBehindTheHullAndThins) {
  const Disturbance d = hull(0.35);
  const WakeFrame frame = frame_at({&d, 1}, arrival_s(d));
  const auto foam = [&](glm::dvec2 p) {
    float f = 0.0f;
    add_wake_foam(frame, {&p, 1}, {&f, 1});
    return f;
  };
  EXPECT_GT(foam({-6.0, 0.0}), 0.3f);
  EXPECT_LT(foam({-30.0, 0.0}), foam({-10.0, 0.0}));
  EXPECT_EQ(foam({-10.0, 12.0}), 0.0f);
  EXPECT_EQ(foam({12.0, 0.0}), 0.0f);
}

}  // namespace
}  // namespace swell::ocean
