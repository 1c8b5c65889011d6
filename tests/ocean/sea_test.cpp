#include "ocean/open_sea/sea.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "allocation_count.h"
#include "constants.h"
#include "ocean/frame_at.h"
#include "ocean/simd_targets.h"

namespace swell::ocean {
namespace {

SeaDescription small_sea() {
  SeaDescription description;
  description.resolution = 32;
  return description;
}

// Compared with ==, so that NaN anywhere fails.
void expect_same_bits(const SeaFrame& a, const SeaFrame& b) {
  ASSERT_EQ(a.patches.size(), b.patches.size());
  for (std::size_t p = 0; p < a.patches.size(); ++p) {
    EXPECT_TRUE(a.patches[p].height_m == b.patches[p].height_m) << "patch " << p;
    EXPECT_TRUE(a.patches[p].slope_x == b.patches[p].slope_x) << "patch " << p;
    EXPECT_TRUE(a.patches[p].slope_y == b.patches[p].slope_y) << "patch " << p;
  }
}

TEST(Sea, IsFlatWithoutWind) {
  SeaDescription description = small_sea();
  description.wind_speed_mps = 0.0;
  const Sea sea(description);
  EXPECT_EQ(sea.significant_height_m(), 0.0);
  EXPECT_EQ(sea.height_bound_m(), 0.0);
  const SeaFrame frame = frame_at(sea, 3.0);
  EXPECT_TRUE(frame.patches.empty());
  float height = 1.0f;
  const glm::dvec2 p(12.0, 34.0);
  sample_heights(frame, {&p, 1}, {&height, 1});
  EXPECT_EQ(height, 0.0f);
}

TEST(Sea, GivesTheSameBitsOnEveryTargetAndThreadCount) {
  for (const int resolution : {16, 64, 128}) {
    SeaDescription description;
    description.resolution = resolution;
    const Sea sea(description);
    const SeaFrame want = frame_at(sea, 17.25);
    for_each_simd_target([&] {
      for (const int threads : {1, 2, 3, 7}) {
        expect_same_bits(frame_at(sea, 17.25, threads), want);
      }
    });
  }
}

TEST(Sea, DependsOnNothingButTime) {
  const Sea sea(small_sea());
  const SeaFrame want = frame_at(sea, 5.5);
  Workers workers(1);
  SeaFrame frame;
  for (const double t : {1000.0, -3.0, 5.5}) advance(sea, t, frame, workers);
  expect_same_bits(frame, want);
  EXPECT_EQ(frame.t_s, 5.5);
  // A frame that held another sea before.
  SeaDescription other = small_sea();
  other.resolution = 64;
  other.patch_lengths_m = {500.0, 100.0, 50.0, 10.0, 2.0};
  advance(Sea(other), 1.0, frame, workers);
  advance(sea, 5.5, frame, workers);
  expect_same_bits(frame, want);
  expect_same_bits(frame_at(Sea(small_sea()), 5.5), want);
}

TEST(Sea, MovesAndStaysFiniteAtAnyTime) {
  const Sea sea(small_sea());
  EXPECT_NE(frame_at(sea, 0.0).patches[0].height_m, frame_at(sea, 0.1).patches[0].height_m);
  EXPECT_NE(frame_at(sea, 1e9).patches[0].height_m, frame_at(sea, 1e9 + 0.1).patches[0].height_m);
  for (const double t : {-1e9, 1e9, 1e20, 1e300, std::numeric_limits<double>::max()}) {
    const SeaFrame frame = frame_at(sea, t);
    for (const float h : frame.patches[0].height_m) ASSERT_LE(std::abs(h), 20.0f) << t;
  }
}

TEST(Sea, AllocatesNothingOnceAFrameWasFilled) {
  const Sea sea(small_sea());
  Workers workers(1);
  SeaFrame frame;
  advance(sea, 0.0, frame, workers);
  const std::uint64_t before = allocation_count();
  for (int i = 1; i < 5; ++i) advance(sea, i, frame, workers);
  EXPECT_EQ(allocation_count() - before, 0u);
}

// The derivative of the trigonometric interpolant through n periodic samples, exactly.
// Source: Trefethen, Spectral Methods in MATLAB, 2000, chapter 3.
std::vector<double> derivative(const PatchFrame& patch, bool along_x) {
  const int n = patch.resolution;
  std::vector<double> weight(n, 0.0);
  for (int m = 1; m < n; ++m) {
    weight[m] = 0.5 * (m % 2 == 0 ? 1.0 : -1.0) / std::tan(kPiRef * m / n) * 2.0 * kPiRef /
                (along_x ? patch.length_m.x : patch.length_m.y);
  }
  std::vector<double> slope(patch.height_m.size(), 0.0);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      for (int m = 1; m < n; ++m) {
        const int from = along_x ? j * n + (i - m + n) % n : (j - m + n) % n * n + i;
        slope[j * n + i] += weight[m] * static_cast<double>(patch.height_m[from]);
      }
    }
  }
  return slope;
}

TEST(Sea, SlopesAreTheDerivativesOfTheHeights) {
  SeaDescription description = small_sea();
  description.resolution = 64;
  description.wind_from_rad = 1.0;
  const SeaFrame frame = frame_at(Sea(description), 4.0);
  for (const PatchFrame& patch : frame.patches) {
    const double scale = std::sqrt(patch.slope_variance);
    const auto slope_x = derivative(patch, true), slope_y = derivative(patch, false);
    // Heights of two patches share a transform, so the smaller one carries the larger one's
    // rounding error.
    for (std::size_t i = 0; i < slope_x.size(); ++i) {
      ASSERT_NEAR(patch.slope_x[i], slope_x[i], 1e-4 * scale);
      ASSERT_NEAR(patch.slope_y[i], slope_y[i], 1e-4 * scale);
    }
  }
}

// Waves H(x - c t) have dH/dt grad H = -c (H')^2: minus its mean points to where they go.
glm::dvec2 mean_travel(const Sea& sea, double t_s) {
  const double dt = 0.01;
  const SeaFrame before = frame_at(sea, t_s - dt), now = frame_at(sea, t_s);
  const SeaFrame after = frame_at(sea, t_s + dt);
  glm::dvec2 sum(0.0);
  for (std::size_t p = 0; p < now.patches.size(); ++p) {
    for (std::size_t i = 0; i < now.patches[p].height_m.size(); ++i) {
      const double rate =
          (after.patches[p].height_m[i] - before.patches[p].height_m[i]) / (2.0 * dt);
      sum -= rate * glm::dvec2(now.patches[p].slope_x[i], now.patches[p].slope_y[i]);
    }
  }
  return sum;
}

// PHY-34: the phase of one wave of the synthesized heights, fitted over ten periods. It goes with
// the wind; the spectrum has none of its length right against it.
TEST(Sea, EachWaveAdvancesAtItsPhaseSpeed) {
  SeaDescription description;
  description.resolution = 64;
  description.patch_lengths_m = {640.0};
  description.wind_from_rad = kPiRef;  // from the south
  const Sea sea(description);
  const int counts = 4;  // wavelengths of 160 m, near the peak
  const double k = 2.0 * kPiRef * counts / 640.0, period_s = 2.0 * kPiRef / std::sqrt(9.81 * k);
  double t = 0.0, p = 0.0, tt = 0.0, tp = 0.0, before = 0.0, turns = 0.0;
  const int steps = 200;
  for (int n = 0; n <= steps; ++n) {
    const double t_s = 10.0 * period_s * n / steps;
    const SeaFrame frame = frame_at(sea, t_s);
    std::complex<double> sum = 0.0;
    for (int j = 0; j < 64; ++j) {
      double row = 0.0;
      for (int i = 0; i < 64; ++i)
        row += static_cast<double>(frame.patches[0].height_m[64 * j + i]);
      sum += row * std::polar(1.0, -2.0 * kPiRef * counts * j / 64.0);
    }
    const double phase = std::arg(sum);
    if (n > 0 && phase > before) turns += 2.0 * kPiRef;  // it falls
    before = phase;
    const double unwrapped = phase - turns;
    t += t_s, p += unwrapped, tt += t_s * t_s, tp += t_s * unwrapped;
  }
  const double count = steps + 1;
  const double omega = -(count * tp - t * p) / (count * tt - t * t);
  EXPECT_NEAR(omega / k / std::sqrt(9.81 / k), 1.0, 1e-4);
}

TEST(Sea, TravelsDownwind) {
  for (const double from_deg : {0.0, 60.0, 90.0, 180.0, 270.0, 315.0}) {
    SeaDescription description = small_sea();
    description.resolution = 64;
    description.wind_from_rad = from_deg * kPiRef / 180.0;
    const glm::dvec2 travel = mean_travel(Sea(description), 20.0);
    const double to_deg = std::atan2(travel.x, travel.y) * 180.0 / kPiRef;
    const double off_deg = std::remainder(to_deg - (from_deg + 180.0), 360.0);
    EXPECT_LE(std::abs(off_deg), 15.0) << "wind from " << from_deg << ", waves to " << to_deg;
  }
}

TEST(Sea, StatesTheVarianceAndBoundOfWhatItDraws) {
  SeaDescription description = small_sea();
  description.resolution = 64;
  const Sea sea(description);
  const int frames = 60;
  double variance = 0.0;
  std::vector<double> slope_variance(3, 0.0);
  for (int f = 0; f < frames; ++f) {
    const SeaFrame frame = frame_at(sea, 7.3 * f);
    double extreme = 0.0;
    glm::dvec2 steepest(0.0);
    for (std::size_t p = 0; p < frame.patches.size(); ++p) {
      const PatchFrame& patch = frame.patches[p];
      const double part = 1.0 / (frames * static_cast<double>(patch.height_m.size()));
      float highest = 0.0f;
      glm::vec2 steep(0.0f);
      for (std::size_t i = 0; i < patch.height_m.size(); ++i) {
        const double h = patch.height_m[i], sx = patch.slope_x[i], sy = patch.slope_y[i];
        variance += part * h * h;
        slope_variance[p] += part * (sx * sx + sy * sy);
        highest = std::max(highest, std::abs(patch.height_m[i]));
        steep = glm::max(steep, glm::abs(glm::vec2(patch.slope_x[i], patch.slope_y[i])));
      }
      extreme += highest;
      steepest += glm::dvec2(steep);
    }
    EXPECT_LE(extreme, sea.height_bound_m());
    EXPECT_LE(std::max(steepest.x, steepest.y), sea.slope_bound());
    EXPECT_GE(std::max(steepest.x, steepest.y), 0.3 * sea.slope_bound()) << "the bound is not idle";
  }
  EXPECT_NEAR(4.0 * std::sqrt(variance) / sea.significant_height_m(), 1.0, 0.02);
  const SeaFrame frame = frame_at(sea, 0.0);
  for (std::size_t p = 0; p < 3; ++p) {
    EXPECT_NEAR(slope_variance[p] / frame.patches[p].slope_variance, 1.0, 0.02) << p;
  }
}

TEST(Sea, ScalesAllHeightsByTheAmplitudeScale) {
  SeaDescription description = small_sea();
  const SeaFrame once = frame_at(Sea(description), 2.0);
  description.amplitude_scale = 2.0;
  const SeaFrame twice = frame_at(Sea(description), 2.0);
  for (std::size_t p = 0; p < once.patches.size(); ++p) {
    for (std::size_t i = 0; i < once.patches[p].height_m.size(); ++i) {
      ASSERT_EQ(twice.patches[p].height_m[i], 2.0f * once.patches[p].height_m[i]);
    }
  }
  description.amplitude_scale = 0.0;
  const SeaFrame flat = frame_at(Sea(description), 2.0);
  for (const float h : flat.patches[0].height_m) ASSERT_EQ(h, 0.0f);
}

TEST(Sea, AddsSinesToItsBoundsAndSignificantHeight) {
  SeaDescription description = small_sea();
  description.spectrum = false;
  description.sines = {{.amplitude_m = 0.5, .wavelength_m = 20.0},
                       {.amplitude_m = -0.25, .wavelength_m = 7.0}};
  const Sea sea(description);
  EXPECT_DOUBLE_EQ(sea.height_bound_m(), 0.75);
  EXPECT_DOUBLE_EQ(sea.slope_bound(), 2.0 * kPiRef * (0.5 / 20.0 + 0.25 / 7.0));
  EXPECT_DOUBLE_EQ(sea.significant_height_m(), 4.0 * std::sqrt(0.125 + 0.03125));
}

TEST(Sea, WeighsItsWaveNumbersByTheirVariances) {
  SeaDescription description = small_sea();
  description.spectrum = false;
  EXPECT_EQ(Sea(description).mean_wavelength_m(), 0.0) << "no waves";
  description.sines = {{.amplitude_m = 2.0, .wavelength_m = 30.0},
                       {.amplitude_m = -1.0, .wavelength_m = 10.0}};
  EXPECT_DOUBLE_EQ(Sea(description).mean_wavelength_m(), 5.0 / (4.0 / 30.0 + 1.0 / 10.0));

  // Pierson-Moskowitz in wave numbers, k^-3 exp(-5/4 (k_m / k)^2), has mean sqrt(5/4 pi) k_m.
  description = {};
  description.wind_speed_mps = 10.0;
  description.resolution = 256;
  description.patch_lengths_m = {1500.0, 97.0};
  const double peak_rad_s = 2.0 * kPiRef * 0.13 * 9.81 / 10.0;
  const double mean_k = std::sqrt(1.25 * kPiRef) * peak_rad_s * peak_rad_s / 9.81;
  EXPECT_NEAR(Sea(description).mean_wavelength_m() * mean_k / (2.0 * kPiRef), 1.0, 0.05);
}

TEST(Sea, NamesTheValueAndRangeOfABadDescription) {
  struct Case {
    std::function<void(SeaDescription&)> spoil;
    std::string name, value, range;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Case cases[] = {
      {[](auto& d) { d.wind_speed_mps = 61; }, "wind_speed_mps", "61", "[0, 60]"},
      {[](auto& d) { d.wind_speed_mps = -1; }, "wind_speed_mps", "-1", "[0, 60]"},
      {[&](auto& d) { d.wind_from_rad = nan; }, "wind_from_rad", "nan", "["},
      {[](auto& d) { d.amplitude_scale = 4.5; }, "amplitude_scale", "4.5", "[0, 4]"},
      {[](auto& d) { d.gravity_mps2 = 0; }, "gravity_mps2", "0", "[0.1, 100]"},
      {[](auto& d) { d.loop_s = 0.5; }, "loop_s", "0.5", "[1, 100000]"},
      {[](auto& d) { d.whitecaps = 10.5; }, "whitecaps", "10.5", "[0, 10]"},
      {[](auto& d) { d.choppiness = 1.5; }, "choppiness", "1.5", "[0, 1]"},
      {[&](auto& d) { d.loop_s = nan; }, "loop_s", "nan", "[1, 100000]"},
      {[](auto& d) { d.resolution = 100; }, "resolution", "100", "[16, 512]"},
      {[](auto& d) { d.resolution = 1024; }, "resolution", "1024", "[16, 512]"},
      {[](auto& d) { d.resolution = -16; }, "resolution", "-16", "[16, 512]"},
      {[](auto& d) { d.patch_lengths_m = {}; }, "patch_lengths_m", "0", "[1, 8]"},
      {[](auto& d) {
         d.patch_lengths_m = {10, 20};
       },
       "patch_lengths_m", "20", "[0.01, 10]"},
      {[](auto& d) { d.patch_lengths_m = {0}; }, "patch_lengths_m", "0", "[0.01, "},
      {[](auto& d) { d.sines = {{.wavelength_m = 0}}; }, "sines.wavelength_m", "0", "[0.001, "},
      {[&](auto& d) { d.sines = {{.amplitude_m = nan}}; }, "sines.amplitude_m", "nan", "["},
      {[](auto& d) { d.sines = {{.period_s = -2}}; }, "sines.period_s", "-2", "[0.001, "},
  };
  for (const Case& bad : cases) {
    SeaDescription description = small_sea();
    bad.spoil(description);
    try {
      const Sea sea(description);
      ADD_FAILURE() << "accepted " << bad.name << " = " << bad.value;
    } catch (const std::invalid_argument& error) {
      const std::string what = error.what();
      EXPECT_EQ(what.find(bad.name), 0u) << what;
      EXPECT_NE(what.find("got " + bad.value), std::string::npos) << what;
      EXPECT_NE(what.find(bad.range), std::string::npos) << what;
    }
  }
}

}  // namespace
}  // namespace swell::ocean
